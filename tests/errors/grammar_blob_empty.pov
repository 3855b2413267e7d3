// 2:22 need at least one component
blob { threshold 0.5 }

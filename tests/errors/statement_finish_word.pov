// 2:24 found instead
sphere { 0, 1 finish { gloss 3 } }

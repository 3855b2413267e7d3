// 2:31 same point
camera { location y look_at y }

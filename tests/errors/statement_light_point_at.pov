// 2:22 needs spotlight, cylinder or parallel
light_source { 0, 1  point_at y }

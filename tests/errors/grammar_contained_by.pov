// 2:44 contained_by
isosurface { function { x } contained_by { cylinder { 0, 1, 1 } } }

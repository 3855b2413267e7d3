// 2:33 No triangles in triangle mesh
mesh { triangle { 0, x, 2 * x } }

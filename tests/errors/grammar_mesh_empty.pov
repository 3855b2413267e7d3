// 2:8 no triangles in triangle mesh
mesh { }

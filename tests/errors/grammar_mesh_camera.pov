// 2:24 Rays per pixel must be at most the number of meshes
camera { mesh_camera { 2 0 mesh { triangle { 0, x, y } } } }

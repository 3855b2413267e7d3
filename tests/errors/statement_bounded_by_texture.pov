// 2:28 with a texture
sphere { 0, 1 clipped_by { sphere { 0, 1 texture {} } } }

// 2:37 needs a texture
sphere { 0, 1 interior_texture { }  }

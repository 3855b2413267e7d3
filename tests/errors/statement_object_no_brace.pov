// 4:1 End of File
sphere { 0, 1
  pigment { rgb 1 }

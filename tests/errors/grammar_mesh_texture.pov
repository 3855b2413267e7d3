// 2:37 expected 'texture identifier'
mesh { triangle { 0, x, y texture { pigment { rgb 1 } } } }

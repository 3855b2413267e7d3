// 3:15 patterned texture
sphere { 0, 1 texture { checker }
              texture { } }

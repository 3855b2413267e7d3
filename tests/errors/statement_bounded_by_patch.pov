// 2:28 without an inside
sphere { 0, 1 bounded_by { triangle { 0, x, y } } }

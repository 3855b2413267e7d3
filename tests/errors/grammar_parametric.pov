// 2:44 expected 'function' in 'parametric'
parametric { function { u } function { v } <0,0>, <1,1> }

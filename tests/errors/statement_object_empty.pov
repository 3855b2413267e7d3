// 2:10 an object
object { pigment { rgb 1 } }

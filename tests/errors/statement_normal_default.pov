// 4:21 no normal type given
#default { normal { bump_size 1.5 } }
#declare Fine = sphere { 0, 1 normal { bump_size 2 } } // as long as nothing shows it
#default { normal { bump_size 1 } }
sphere { 0, 1 pigment { rgb 1 } }

// 2:33 no matching } in 'light_group'
light_group { sphere { 0, 1 }   no_shadow }

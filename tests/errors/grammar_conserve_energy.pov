// 2:50 no matching } in 'finish'
sphere { 0, 1 finish { ambient 1 conserve_energy on } }

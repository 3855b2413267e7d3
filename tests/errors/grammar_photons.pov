// 2:35 no matching } in 'photons'
sphere { 0, 1 photons { target on foo } }

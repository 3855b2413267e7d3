// 2:27 photons gather 20 to 4
global_settings { photons { gather 20, 4 } }

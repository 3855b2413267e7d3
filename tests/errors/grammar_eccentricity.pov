// 2:68 eccentricity cannot be used with this scattering type
sphere { 0, 1 hollow interior { media { scattering { 1, rgb 1      eccentricity 0.2 } } } }

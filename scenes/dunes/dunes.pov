// 10,000 patches: dunes under a low sun, one smooth surface. CC0.
// Each patch is the bicubic Hermite piece of a height function over a square, so that neighbours
// share their edges and tangents.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#declare N = 100;   // patches along each side
#declare S = 0.2;   // side of a patch

#declare H = function(x, z) {
    0.55*sin(0.9*x + 0.5*sin(0.35*z)) + 0.25*sin(1.7*z + 0.6*x) + 0.08*sin(3.1*x - 2.3*z)
}
#declare D = 1e-4;
#macro Point(X, Z, I, J)
    // Control point (I, J) of the patch from (X, Z): a third of the tangents from the corner.
    #local A = (I < 2 ? 0 : 1);
    #local B = (J < 2 ? 0 : 1);
    #local U = X + S*A;
    #local V = Z + S*B;
    #local P = (I = 1 ? 1 : (I = 2 ? -1 : 0))*S/3;
    #local Q = (J = 1 ? 1 : (J = 2 ? -1 : 0))*S/3;
    #local Y = H(U, V);
    #local Fx = (H(U + D, V) - H(U - D, V))/(2*D);
    #local Fz = (H(U, V + D) - H(U, V - D))/(2*D);
    <U + P, Y + P*Fx + Q*Fz, V + Q>
#end
union {
    #local K = 0;
    #while (K < N)
        #local L = 0;
        #while (L < N)
            bicubic_patch {
                type 1 flatness 0 u_steps 3 v_steps 3
                #local I = 0;
                #while (I < 4)
                    #local J = 0;
                    #while (J < 4)
                        Point(S*(K - N/2), S*L, I, J)
                        #local J = J + 1;
                    #end
                    #local I = I + 1;
                #end
            }
            #local L = L + 1;
        #end
        #local K = K + 1;
    #end
    pigment {
        gradient y
        color_map { [0 rgb <0.62, 0.36, 0.16>] [1 rgb <0.93, 0.72, 0.42>] }
        scale 1.8 translate -0.9*y
    }
    finish { ambient 0.05 diffuse 0.85 specular 0.05 roughness 0.08 }
}
sky_sphere {
    pigment {
        gradient y
        color_map { [0.45 rgb <0.98, 0.78, 0.55>] [0.75 rgb <0.25, 0.45, 0.8>] }
        scale 2 translate -y
    }
}
light_source { <-40, 14, 10>, rgb <1.0, 0.92, 0.78> }
camera { location <0, 2.6, -2.2> look_at <0, 0, 6.5> angle 55 right x*image_width/image_height }

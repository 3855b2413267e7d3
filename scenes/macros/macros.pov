// SPDX-License-Identifier: CC0-1.0
// A lotus on a pond, grown by macros: every petal is one patch whose points a macro computes from
// length, width and opening; a loop turns each by the golden angle. The leaves are fans of patches that
// share one collapsed edge. No patch is written down.
//
// Must meet: with --method facets, at most 3 pixels in 10,000 differ from POV-Ray's by more than one step
// of 8 bits (tests/test_pictures.c): where all petals meet, POV-Ray's shadows depend on its cache. With --method qi only POV-Ray's triangles make a difference.
//
//   povray +Iscenes/macros/macros.pov +W640 +H400 +A0.3
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 4 }

camera {
    perspective
    location <-0.6, 3.7, -8.6>
    right x*image_width/image_height
    angle 41
    look_at <0.1, 0.85, 0>
}

light_source { <-7, 11, -5> rgb <1.5, 1.35, 1.15> }
light_source { <9, 7, 3> rgb <0.45, 0.4, 0.5> shadowless }

sky_sphere {
    pigment {
        gradient y
        color_map {
            [0.00 rgb <0.95, 0.75, 0.55>]
            [0.15 rgb <0.75, 0.60, 0.58>]
            [0.50 rgb <0.30, 0.38, 0.52>]
            [1.00 rgb <0.08, 0.14, 0.28>]
        }
    }
}

plane {
    y, 0
    pigment { rgb <0.01, 0.035, 0.04> }
    finish { ambient 0 diffuse 0.4 specular 0.4 roughness 0.01 reflection { 0.12, 0.9 falloff 4 } }
}

// A row of four points across the petal, at distance Along on its way: half as wide as Half, its sides
// lifted by Cup.
#macro Row(Along, Height, Half, Cup)
    <Along, Height + Cup, -Half>, <Along, Height - Cup/2, -0.6*Half>,
    <Along, Height - Cup/2, 0.6*Half>, <Along, Height + Cup, Half>
#end

// The petal leaves the origin along x and bends up by Bend at its tip.
#macro Petal(Length, Width, Cup, Bend)
    bicubic_patch {
        type 1 flatness 0 u_steps 4 v_steps 3
        Row(0, 0, 0.12*Width, 0)
        Row(0.35*Length, -0.10*Length, 0.75*Width, Cup)
        Row(0.75*Length, 0.05*Length + 0.3*Bend, 0.95*Width, 0.8*Cup)
        Row(Length, Bend, 0, 0)
    }
#end

#macro Flower(Count, Size, Pale, Deep)
    union {
        #for (I, 0, Count - 1)
            #local S = I/(Count - 1); // 0 in the heart, 1 outside
            object {
                Petal(0.75 + 0.55*sqrt(S), 0.20 + 0.20*S, 0.10 + 0.03*S, 0.18 + 0.10*S)
                pigment {
                    gradient x
                    color_map {
                        [0.0 rgb Pale]
                        [0.3 rgb Pale]
                        [1.0 rgb Deep*(1 - 0.3*S) + Pale*0.3*S]
                    }
                    scale 1.35
                }
                finish { ambient 0.12 diffuse 0.7 brilliance 0.8 specular 0.1 roughness 0.05 }
                double_illuminate
                rotate (78 - 72*pow(S, 0.8))*z
                translate <0.10 + 0.14*S, 0.16*(1 - S), 0>
                rotate 137.50776*I*y
            }
        #end
        // The seed box with its pollen.
        cone {
            <0, 0, 0>, 0.05, <0, 0.34, 0>, 0.17
            pigment { rgb <0.80, 0.62, 0.10> }
            finish { ambient 0.15 diffuse 0.7 }
        }
        #for (I, 0, 29)
            sphere {
                <0.155*sqrt((I + 0.5)/30), 0.35, 0>, 0.022
                rotate 137.50776*I*y
                pigment { rgb <0.95, 0.80, 0.25> }
                finish { ambient 0.15 diffuse 0.7 }
            }
        #end
        scale Size
    }
#end

// A leaf that floats: Count fans from the stem to the wavy rim, with a slit left open.
#macro Leaf(Count, Size, Colour)
    union {
        #local Step = 340/Count;
        #macro Rim(Angle, Far)
            #local A = radians(10 + Angle);
            #local H = 0.015 + 0.05*Far*Far*(1 + sin(3*A));
            <Far*cos(A), H, Far*sin(A)>
        #end
        #for (I, 0, Count - 1)
            bicubic_patch {
                type 1 flatness 0 u_steps 3 v_steps 3
                #for (J, 0, 3)
                    #for (K, 0, 3)
                        // Inner points lie a little further out, so that the rim is round.
                        #local Bulge = (K = 1 | K = 2 ? 1/cos(radians(Step/6)) : 1);
                        Rim(Step*(I + K/3), J/3*Bulge)
                    #end
                #end
            }
        #end
        pigment { rgb Colour }
        finish { ambient 0.08 diffuse 0.7 specular 0.15 roughness 0.04 }
        double_illuminate
        scale Size
    }
#end

#declare Pale = <0.98, 0.90, 0.88>;
#declare Pink = <0.80, 0.10, 0.32>;

object { Flower(64, 1.55, Pale, Pink) translate 0.12*y }
object { Flower(34, 0.8, <0.95, 0.92, 0.80>, <0.92, 0.70, 0.45>) translate <3.0, 0.08, -0.9> }

object { Leaf(9, 1.9, <0.10, 0.32, 0.10>) rotate 200*y translate <-2.5, 0, 1.2> }
object { Leaf(9, 1.4, <0.14, 0.38, 0.12>) rotate 80*y translate <2.4, 0.01, -1.4> }
object { Leaf(9, 1.1, <0.20, 0.40, 0.10>) rotate 320*y translate <-2.2, 0.01, -2.2> }
object { Leaf(9, 1.7, <0.08, 0.28, 0.12>) rotate 140*y translate <2.6, 0, 3.2> }
object { Leaf(9, 0.9, <0.16, 0.36, 0.08>) rotate 30*y translate <0.2, 0.01, -3.4> }
object { Leaf(9, 1.5, <0.10, 0.30, 0.12>) rotate 260*y translate <-4.6, 0, 4.4> }

// SPDX-License-Identifier: CC0-1.0
// Sea shells on the beach. One shell is a union of 432 patches with literal points, as modellers export
// them (shell_patches.inc); it lies here five times, turned, scaled and coloured, outside and inside
// with textures of their own. The sand's ripples are patches too.
//
// Must meet: with --method facets, at most 1 pixel in 10,000 differs from POV-Ray's by more than one step
// of 8 bits (tests/test_pictures.c). With --method qi only POV-Ray's triangles make a difference.
//
//   povray +Iscenes/shells/shells.pov +Lscenes/shells +W640 +H400 +A0.3
#version 3.7;
global_settings { assumed_gamma 1.0 }

#include "shell_patches.inc"

camera {
    perspective
    location <0.4, 3.9, -7.4>
    right x*image_width/image_height
    angle 45
    look_at <0.05, 0.62, 0>
}

light_source { <-9, 8, -3.5> rgb <1.7, 1.42, 1.1> }
light_source { <6, 8, -9> rgb <0.16, 0.22, 0.33> shadowless }

sky_sphere {
    pigment {
        gradient y
        color_map {
            [0.0 rgb <0.90, 0.82, 0.70>]
            [0.3 rgb <0.55, 0.70, 0.80>]
            [1.0 rgb <0.20, 0.38, 0.62>]
        }
    }
}

// One ripple a patch; each goes on where the last one ended, with the same slope.
union {
    #for (I, 0, 39)
        bicubic_patch {
            type 1 flatness 0 u_steps 3 v_steps 2
            #for (Row, 0, 3)
                #local Y = (Row = 1 ? 0.06 : (Row = 2 ? -0.06 : 0));
                #local Z = -8 + 0.5*(I + Row/3);
                #local Bend = 1.2*sin(0.6*Z);
                <-14, Y, Z>, <-5, Y, Z + Bend>, <5, Y, Z - Bend>, <14, Y, Z>
            #end
        }
    #end
    pigment { rgb <0.72, 0.56, 0.38> }
    finish { ambient 0.1 diffuse 0.72 }
}

#declare Gloss = finish { ambient 0.08 diffuse 0.68 specular 0.25 roughness 0.03 }
#declare Pearl = finish { ambient 0.08 diffuse 0.62 specular 0.6 roughness 0.01 reflection { 0.02, 0.25 } }

// Bands around the axis, as the shell grew.
#macro Banded(Light, Dark, Width)
    pigment {
        gradient y
        color_map {
            [0.0 rgb Light]
            [0.4 rgb Light]
            [0.5 rgb Dark]
            [0.7 rgb Dark]
            [0.8 rgb Light]
            [1.0 rgb Light]
        }
        scale Width
    }
#end

// Mouth up, the tip pointing to -x; the last turn rests on the sand.
#macro Lay(Outside, Inside, Size, Roll, Turn, Place)
    object {
        Shell
        texture { Outside finish { Gloss } }
        interior_texture { pigment { rgb Inside } finish { Pearl } }
        translate <-0.2, 1.6, 0>
        rotate Roll*y
        rotate 90*z
        scale Size
        rotate Turn*y
        translate Place
    }
#end

#declare Cream = texture { Banded(<0.88, 0.78, 0.62>, <0.62, 0.34, 0.18>, 0.38) }
#declare Rose = texture { Banded(<0.86, 0.56, 0.46>, <0.92, 0.84, 0.74>, 0.5) }
#declare Slate = texture { Banded(<0.40, 0.42, 0.46>, <0.82, 0.80, 0.74>, 0.3) }
#declare Ochre = texture { pigment { rgb <0.80, 0.55, 0.22> } }

Lay(Cream, <0.95, 0.55, 0.42>, 1.25, 132, 24, <-0.45, 1.18, 0.2>)
Lay(Rose, <0.95, 0.78, 0.66>, 0.62, 300, -70, <2.35, 0.42, -0.6>)
Lay(Slate, <0.70, 0.62, 0.75>, 0.5, 120, 200, <-2.45, 0.38, -1.5>)
Lay(Ochre, <0.98, 0.85, 0.60>, 0.34, 330, 140, <0.9, 0.24, -2.1>)
Lay(Rose, <0.95, 0.70, 0.60>, 0.3, 100, 60, <-0.75, 0.22, -2.35>)

// SPDX-License-Identifier: CC0-1.0
// Newell's teapot as one block of pale green glass on a striped cloth, lit from behind: rays are
// refracted, split by Fresnel's law and darkened on their way, up to eight levels deep, and each
// passes from patch to patch. A hole at a shared edge would let a ray out where no surface is.
//
// Must meet: with --method facets, at most 1 pixel in 10,000 differs from POV-Ray's by more than one step
// of 8 bits (tests/test_pictures.c). With --method qi only POV-Ray's triangles make a difference.
//
//   povray +Iscenes/teapot-glass/teapot-glass.pov +Lscenes/teapot +W640 +H400 +A0.3
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 8 adc_bailout 0.01 }

#include "teapot_patches.inc"

camera {
    perspective
    location <0.8, 4.4, -11.5>
    right x*image_width/image_height
    angle 40
    look_at <0, 1.2, 0>
}

light_source { <7, 12, 9> rgb <1.5, 1.4, 1.25> }
light_source { <-9, 9, -8> rgb <0.45, 0.5, 0.6> }

sky_sphere {
    pigment {
        gradient y
        color_map {
            [0.0 rgb <0.85, 0.88, 0.90>]
            [0.4 rgb <0.45, 0.60, 0.78>]
            [1.0 rgb <0.15, 0.28, 0.52>]
        }
    }
}

// The cloth: stripes of a gradient with sharp steps, on a dark table.
disc {
    <0, 0, 0>, y, 7
    pigment {
        gradient x
        color_map {
            [0.00 rgb <0.86, 0.84, 0.78>]
            [0.55 rgb <0.86, 0.84, 0.78>]
            [0.55 rgb <0.72, 0.16, 0.12>]
            [0.70 rgb <0.72, 0.16, 0.12>]
            [0.70 rgb <0.86, 0.84, 0.78>]
            [0.76 rgb <0.86, 0.84, 0.78>]
            [0.76 rgb <0.12, 0.22, 0.42>]
            [0.80 rgb <0.12, 0.22, 0.42>]
            [0.80 rgb <0.86, 0.84, 0.78>]
            [1.00 rgb <0.86, 0.84, 0.78>]
        }
        scale 1.3
        rotate -25*y
    }
    finish { ambient 0.1 diffuse 0.7 }
}
plane {
    y, -0.02
    pigment {
        gradient z
        color_map {
            [0 rgb <0.16, 0.09, 0.06>]
            [1 rgb <0.22, 0.13, 0.08>]
        }
        triangle_wave
        scale 3
        rotate -25*y
    }
    finish { ambient 0.1 diffuse 0.7 }
}

#declare Glass_Finish = finish {
    ambient 0 diffuse 0
    specular 0.8 roughness 0.002
    reflection { 0.0, 1.0 fresnel on }
    conserve_energy
}

object {
    Teapot
    rotate 205*y
    pigment { rgbf <0.97, 1.0, 0.98, 0.96> }
    finish { Glass_Finish }
    interior { ior 1.45 fade_distance 2.5 fade_power 1 fade_color <0.35, 0.75, 0.5> }
}

// Three drops of other glass.
#macro Drop(Place, Size, Colour, Bend)
    sphere {
        Place + Size*y, Size
        pigment { rgbf <Colour.x, Colour.y, Colour.z, 0.95> }
        finish { Glass_Finish }
        interior { ior Bend }
    }
#end
Drop(<-2.6, 0, -2.4>, 0.50, <1.0, 0.75, 0.25>, 1.5)
Drop(<2.9, 0, -2.1>, 0.42, <0.55, 0.75, 1.0>, 1.33)
Drop(<1.9, 0, -2.9>, 0.28, <1.0, 0.45, 0.45>, 1.7)

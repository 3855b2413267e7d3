// SPDX-License-Identifier: CC0-1.0
// Newell's teapot in chrome between coloured balls, under an evening sky. Every error of the surface
// normal bends a line of the checked floor: reflections show what a matte surface hides.
//
// Must meet: with --method facets, at most 1 pixel in 10,000 differs from POV-Ray's by more than one step
// of 8 bits (tests/test_pictures.c). With --method qi only POV-Ray's triangles make a difference.
//
//   povray +Iscenes/teapot-chrome/teapot-chrome.pov +Lscenes/teapot +W640 +H400 +A0.3
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 8 }

#include "teapot_patches.inc"

camera {
    perspective
    location <-1.2, 2.9, -12.5>
    right x*image_width/image_height
    angle 43
    look_at <0, 1.45, 0>
}

light_source { <-14, 16, -6> rgb <1.3, 1.05, 0.8> }
light_source { <10, 9, -14> rgb <0.25, 0.32, 0.5> }

sky_sphere {
    pigment {
        gradient y
        color_map {
            [0.00 rgb <0.95, 0.55, 0.28>]
            [0.12 rgb <0.80, 0.50, 0.42>]
            [0.35 rgb <0.30, 0.32, 0.50>]
            [1.00 rgb <0.04, 0.06, 0.16>]
        }
    }
}

// A round checked floor in a dark, still lake.
disc {
    <0, 0, 0>, y, 6.8
    pigment {
        checker rgb <0.72, 0.68, 0.60>, rgb <0.07, 0.09, 0.13>
        scale 0.9
        rotate 20*y
    }
    finish { ambient 0.05 diffuse 0.65 reflection 0.08 }
}
cylinder {
    <0, -0.6, 0>, <0, -0.001, 0>, 7
    pigment { rgb <0.30, 0.24, 0.20> }
    finish { ambient 0.05 diffuse 0.6 }
}
plane {
    y, -0.5
    pigment { rgb <0.02, 0.03, 0.05> }
    finish { ambient 0 diffuse 0.3 reflection { 0.25, 0.9 falloff 4 } }
}

object {
    Teapot
    rotate -32*y
    pigment { rgb <0.9, 0.92, 0.95> }
    finish {
        ambient 0 diffuse 0.08
        specular 0.7 roughness 0.004
        reflection { rgb <0.74, 0.76, 0.80>, rgb <0.96, 0.97, 1.0> falloff 3 }
    }
}

#macro Ball(Place, Size, Colour)
    sphere {
        Place + Size*y, Size
        pigment { rgb Colour }
        finish { ambient 0.04 diffuse 0.7 phong 0.6 phong_size 60 reflection 0.06 }
    }
#end
Ball(<-3.3, 0, -2.2>, 0.62, <0.75, 0.06, 0.05>)
Ball(<-1.9, 0, -3.3>, 0.34, <0.90, 0.55, 0.06>)
Ball(<3.2, 0, -2.4>, 0.52, <0.05, 0.28, 0.55>)
Ball(<2.0, 0, -3.4>, 0.28, <0.08, 0.45, 0.22>)
Ball(<4.6, 0, 1.8>, 0.95, <0.75, 0.70, 0.62>)
Ball(<-4.4, 0, 2.6>, 1.10, <0.24, 0.08, 0.30>)

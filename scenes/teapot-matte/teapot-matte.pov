// SPDX-License-Identifier: CC0-1.0
// Newell's teapot in unglazed clay on a round table, with some fruit: diffuse light only, soft colours,
// one shadow. The plainest picture of the 32 patches, and the one in which POV-Ray's triangles are
// easiest to see, at the outline of the lid and the handle.
//
// Must meet: with --method facets, at most 1 pixel in 10,000 differs from POV-Ray's by more than one step
// of 8 bits (tests/test_pictures.c). With --method qi only POV-Ray's triangles make a difference.
//
//   povray +Iscenes/teapot-matte/teapot-matte.pov +Lscenes/teapot +W640 +H400 +A0.3
#version 3.7;
global_settings { assumed_gamma 1.0 }

#include "teapot_patches.inc"

camera {
    perspective
    location <1.8, 4.6, -11.5>
    right x*image_width/image_height
    angle 42
    look_at <0.1, 1.15, 0>
}

light_source { <-9, 13, -8> rgb <1.5, 1.38, 1.2> }
light_source { <8, 6, -10> rgb <0.22, 0.27, 0.36> shadowless }

#declare Clay = texture {
    pigment { rgb <0.62, 0.25, 0.13> }
    finish { ambient 0.06 diffuse 0.8 brilliance 1.1 }
}

sky_sphere {
    pigment {
        gradient y
        color_map {
            [0.0 rgb <0.80, 0.66, 0.50>]
            [0.6 rgb <0.42, 0.45, 0.47>]
            [1.0 rgb <0.25, 0.30, 0.36>]
        }
    }
}

// The wall and the floor are one colour each, far enough to stay quiet.
plane {
    y, -3
    pigment { rgb <0.35, 0.27, 0.20> }
    finish { ambient 0.1 diffuse 0.6 }
}

// The table: a slab with a darker rim and a checked cloth laid over it.
cylinder {
    <0, -0.35, 0>, <0, -0.02, 0>, 4.6
    pigment { rgb <0.30, 0.17, 0.09> }
    finish { ambient 0.08 diffuse 0.7 }
}
disc {
    <0, 0, 0>, y, 4.35
    pigment {
        checker rgb <0.80, 0.75, 0.64>, rgb <0.30, 0.42, 0.45>
        scale 0.62
        rotate 28*y
    }
    finish { ambient 0.08 diffuse 0.75 }
}

object {
    Teapot
    rotate 20*y
    texture { Clay }
}

#macro Fruit(Place, Size, Colour)
    sphere {
        Place + Size*y, Size
        pigment { rgb Colour }
        finish { ambient 0.06 diffuse 0.8 }
    }
#end
Fruit(<2.85, 0, -1.80>, 0.48, <0.85, 0.42, 0.05>)
Fruit(<1.95, 0, -2.45>, 0.42, <0.55, 0.60, 0.12>)
Fruit(<-2.5, 0, -2.3>, 0.44, <0.66, 0.10, 0.07>)

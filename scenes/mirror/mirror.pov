// SPDX-License-Identifier: CC0-1.0
// Butterflies above a hill: the right half of each is the left one mirrored by scale <-1, 1, 1>, and
// every butterfly is stretched by three unequal factors. A mirror turns the two sides of a patch over,
// so the mirrored wings carry their upper and lower textures exchanged.
//
// Must meet: with --method facets, at most 1 pixel in 10,000 differs from POV-Ray's by more than one step
// of 8 bits (tests/test_pictures.c). With --method qi only POV-Ray's triangles make a difference.
//
//   povray +Iscenes/mirror/mirror.pov +W640 +H400 +A0.3
#version 3.7;
global_settings { assumed_gamma 1.0 }

camera {
    perspective
    location <0, 5.0, -11.5>
    right x*image_width/image_height
    angle 44
    look_at <0, 1.45, 0>
}

light_source { <-6, 14, -7> rgb <1.45, 1.35, 1.15> }
light_source { <10, 6, -6> rgb <0.25, 0.28, 0.36> shadowless }

sky_sphere {
    pigment {
        gradient y
        color_map {
            [0.0 rgb <0.92, 0.90, 0.80>]
            [0.3 rgb <0.50, 0.70, 0.86>]
            [1.0 rgb <0.12, 0.30, 0.60>]
        }
    }
}

// The hill: four patches, two of them mirrored, meeting at the top with one tangent.
#declare Quarter = bicubic_patch {
    type 1 flatness 0 u_steps 4 v_steps 4
    <0, 0, 0>, <4, 0, 0>, <8, -0.6, 0>, <14, -3, 0>,
    <0, 0, 3>, <4, 0, 3>, <8, -0.6, 3>, <14, -3, 3>,
    <0, -0.3, 8>, <4, 0.3, 8>, <8, -1.2, 8>, <14, -3, 8>,
    <0, -2.4, 14>, <4, -1.6, 14>, <8, -2.4, 14>, <14, -4, 14>
}
#declare Half_Hill = union { object { Quarter } object { Quarter scale <1, 1, -1> } }
union {
    object { Half_Hill }
    object { Half_Hill scale <-1, 1, 1> }
    pigment {
        checker rgb <0.24, 0.40, 0.10>, rgb <0.30, 0.46, 0.13>
        scale 0.9
        rotate 30*y
    }
    finish { ambient 0.1 diffuse 0.7 }
    translate -0.6*y
}

// The wings of one side, near the plane y = 0; the body lies along z, the head at +z. The normal of
// the patches points down.
#declare Fore_Wing = bicubic_patch {
    type 1 flatness 0 u_steps 4 v_steps 4
    <0.05, 0, 0.00>, <0.05, 0, 0.15>, <0.05, 0, 0.30>, <0.05, 0, 0.45>,
    <0.60, 0.14, -0.15>, <0.60, 0.16, 0.30>, <0.55, 0.16, 0.75>, <0.50, 0.10, 0.95>,
    <1.25, 0.20, -0.10>, <1.20, 0.24, 0.40>, <1.20, 0.20, 1.05>, <1.10, 0.12, 1.30>,
    <1.40, 0.05, 0.10>, <1.65, 0.08, 0.55>, <1.75, 0.05, 1.10>, <1.70, 0.00, 1.35>
}
#declare Hind_Wing = bicubic_patch {
    type 1 flatness 0 u_steps 4 v_steps 4
    <0.05, 0, -0.35>, <0.05, 0, -0.20>, <0.05, 0, -0.05>, <0.05, 0, 0.10>,
    <0.40, 0.04, -1.00>, <0.55, 0.12, -0.60>, <0.60, 0.14, -0.20>, <0.60, 0.10, 0.10>,
    <0.75, 0.02, -1.70>, <1.10, 0.10, -0.95>, <1.20, 0.14, -0.35>, <1.15, 0.10, 0.05>,
    <0.85, -0.05, -1.60>, <1.30, 0.00, -1.10>, <1.45, 0.02, -0.50>, <1.30, 0.02, -0.05>
}

// From the root of the wing outwards.
#macro Upper(Root, Middle, Edge)
    pigment {
        gradient x
        color_map {
            [0.00 rgb Root]
            [0.30 rgb Middle]
            [0.58 rgb Middle*0.75]
            [0.64 rgb Edge]
            [0.72 rgb Edge]
            [0.75 rgb <0.95, 0.93, 0.85>]
            [0.79 rgb <0.95, 0.93, 0.85>]
            [0.82 rgb Edge]
            [1.00 rgb Edge]
        }
        scale 1.85
    }
    finish { ambient 0.12 diffuse 0.72 }
#end
#macro Lower(Middle)
    pigment { rgb Middle*0.3 + <0.10, 0.08, 0.05> }
    finish { ambient 0.12 diffuse 0.6 }
#end

#declare Wings = union {
    object { Fore_Wing }
    object { Hind_Wing translate -0.02*y }
}

// Spread: how far the wings are lifted, in degrees.
#macro Butterfly(Root, Middle, Edge, Spread)
    union {
        object {
            Wings
            texture { Lower(Middle) }
            interior_texture { Upper(Root, Middle, Edge) }
            rotate Spread*z
        }
        object {
            Wings
            texture { Upper(Root, Middle, Edge) }
            interior_texture { Lower(Middle) }
            rotate Spread*z
            scale <-1, 1, 1>
        }
        sphere { 0, 1 scale <0.09, 0.09, 0.50> translate -0.25*z }
        sphere { 0, 1 scale <0.11, 0.11, 0.24> translate 0.28*z }
        sphere { <0, 0.02, 0.55>, 0.09 }
        cone { <0.02, 0.05, 0.6>, 0.012, <0.32, 0.25, 1.15>, 0.006 }
        cone { <-0.02, 0.05, 0.6>, 0.012, <-0.32, 0.25, 1.15>, 0.006 }
        pigment { rgb <0.07, 0.05, 0.04> }
        finish { ambient 0.1 diffuse 0.7 specular 0.2 roughness 0.05 }
    }
#end

#declare Black = <0.03, 0.025, 0.03>;
#declare Monarch = Butterfly(<0.45, 0.16, 0.03>, <0.90, 0.36, 0.04>, Black, 24)
#declare Morpho = Butterfly(<0.02, 0.08, 0.25>, <0.06, 0.32, 0.80>, Black, 38)
#declare Brimstone = Butterfly(<0.65, 0.68, 0.12>, <0.88, 0.84, 0.22>, <0.45, 0.42, 0.08>, 10)
#declare Peacock = Butterfly(<0.30, 0.05, 0.04>, <0.62, 0.12, 0.08>, <0.10, 0.06, 0.14>, 55)

object { Monarch scale <1.0, 1.3, 0.85> rotate <-38, 22, 10> translate <-1.1, 2.0, -0.8> }
object { Morpho scale <1.1, 0.9, 0.9> rotate <-40, -28, -10> translate <2.4, 1.9, 0.2> }
object { Brimstone scale <0.7, 1.2, 0.55> rotate <-48, 50, 10> translate <-3.9, 0.9, -0.8> }
object { Peacock scale <0.65, 0.7, 0.85> rotate <-40, -12, 8> translate <0.9, 0.85, -2.8> }
object { Morpho scale <0.5, 0.7, 0.5> rotate <-50, 35, 20> translate <-3.3, 3.1, 1.6> }
object { Brimstone scale <0.55, 1.6, 0.6> rotate <-40, -40, -8> translate <3.9, 0.35, -1.2> }
object { Monarch scale <0.5, 0.45, 0.55> rotate <-50, 10, -18> translate <0.9, 3.6, 2.0> }

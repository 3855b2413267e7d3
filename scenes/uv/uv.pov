// SPDX-License-Identifier: CC0-1.0
// Hot-air balloons: their checks, stripes and rings live in the patches' own coordinates (uv_mapping).
// Each envelope is made of eight gores of three patches; uv_vectors join them to one sheet that runs
// once around (u) and from the mouth to the crown (v), where a whole edge is one point. The hills below
// carry fields that follow their curves the same way.
//
// Must meet: with --method facets, at most 1 pixel in 10,000 differs from POV-Ray's by more than one step
// of 8 bits (tests/test_pictures.c). With --method qi only POV-Ray's triangles make a difference.
//
//   povray +Iscenes/uv/uv.pov +W640 +H400 +A0.3
#version 3.7;
global_settings { assumed_gamma 1.0 }

camera {
    perspective
    location <0, 3.2, -13>
    right x*image_width/image_height
    angle 45
    look_at <0, 3.5, 0>
}

light_source { <-12, 14, -10> rgb <1.5, 1.35, 1.1> }
light_source { <10, 3, -12> rgb <0.22, 0.26, 0.36> shadowless }

sky_sphere {
    pigment {
        gradient y
        color_map {
            [0.00 rgb <0.98, 0.80, 0.60>]
            [0.18 rgb <0.80, 0.78, 0.80>]
            [0.60 rgb <0.30, 0.50, 0.80>]
            [1.00 rgb <0.10, 0.22, 0.50>]
        }
    }
}

// ---- envelopes ------------------------------------------------------------------------------

// An eighth of a turn: handles of length 4/3 tan(45/4 degrees) make the rings round.
#declare Handle = 4/3*tan(radians(45/4));
#macro Ring(R, Y)
    #local C = cos(radians(45));
    <R, Y, 0>, <R, Y, R*Handle>, <R*C*(1 + Handle), Y, R*C*(1 - Handle)>, <R*C, Y, R*C>
#end

// Four rings are one patch: from height V0 to V1 of the sheet, in the gore number G.
#macro Gore(G, V0, V1, R0, Y0, R1, Y1, R2, Y2, R3, Y3)
    bicubic_patch {
        type 1 flatness 0 u_steps 4 v_steps 3
        uv_vectors <G/8, V0>, <(G + 1)/8, V0>, <(G + 1)/8, V1>, <G/8, V1>
        Ring(R0, Y0) Ring(R1, Y1) Ring(R2, Y2) Ring(R3, Y3)
        rotate -45*G*y
    }
#end

#declare Envelope = union {
    #for (G, 0, 7)
        object { Gore(G, 0.0, 0.3, 0.30, 0, 0.62, 0.45, 1.00, 0.85, 1.22, 1.35) }
        object { Gore(G, 0.3, 0.7, 1.22, 1.35, 1.48, 1.94, 1.50, 2.50, 1.22, 2.90) }
        object { Gore(G, 0.7, 1.0, 1.22, 2.90, 1.00, 3.20, 0.50, 3.36, 0, 3.36) }
    #end
}

#declare Cloth = finish { ambient 0.14 diffuse 0.7 specular 0.12 roughness 0.06 }

#macro Balloon(Skin, Size, Turn, Place)
    union {
        object {
            Envelope
            uv_mapping
            texture { Skin finish { Cloth } }
            rotate Turn*y
        }
        box {
            <-0.17, -0.85, -0.17>, <0.17, -0.58, 0.17>
            pigment { rgb <0.36, 0.20, 0.09> }
            finish { ambient 0.1 diffuse 0.7 }
        }
        torus {
            0.3, 0.025
            pigment { rgb <0.25, 0.20, 0.15> }
        }
        #for (I, 0, 3)
            cylinder {
                <0.16, -0.6, 0.16>, <0.21, 0, 0.21>, 0.012
                rotate 90*I*y
                pigment { rgb <0.2, 0.16, 0.12> }
            }
        #end
        scale Size
        translate Place
    }
#end

#declare Checks = texture {
    pigment {
        checker rgb <0.80, 0.08, 0.06>, rgb <0.95, 0.88, 0.74>
        scale <1/16, 1/10, 1>
    }
}
#declare Stripes = texture {
    pigment {
        gradient x
        color_map {
            [0.00 rgb <0.10, 0.25, 0.60>]
            [0.25 rgb <0.10, 0.25, 0.60>]
            [0.25 rgb <0.95, 0.75, 0.15>]
            [0.50 rgb <0.95, 0.75, 0.15>]
            [0.50 rgb <0.90, 0.35, 0.08>]
            [0.75 rgb <0.90, 0.35, 0.08>]
            [0.75 rgb <0.95, 0.75, 0.15>]
            [1.00 rgb <0.95, 0.75, 0.15>]
        }
        scale 1/4
    }
}
// A map of pigments: checks and stripes in rings of the sheet.
#declare Rings = texture {
    pigment {
        gradient y
        pigment_map {
            [0.00 rgb <0.06, 0.32, 0.30>]
            [0.36 rgb <0.06, 0.32, 0.30>]
            [0.36 checker rgb <0.92, 0.90, 0.80>, rgb <0.06, 0.32, 0.30> scale <1/24, 0.07, 1> translate 0.01*y]
            [0.64 checker rgb <0.92, 0.90, 0.80>, rgb <0.06, 0.32, 0.30> scale <1/24, 0.07, 1> translate 0.01*y]
            [0.64 rgb <0.85, 0.60, 0.20>]
            [1.00 rgb <0.55, 0.15, 0.10>]
        }
    }
}

object { Balloon(Checks, 1.25, 12, <-0.4, 2.2, 0>) }
object { Balloon(Stripes, 0.9, 40, <3.9, 3.6, 2>) }
object { Balloon(Rings, 0.85, 5, <-3.9, 1.7, 0.5>) }
object { Balloon(Stripes, 0.4, 10, <-3.2, 5.6, 6>) }
object { Balloon(Checks, 0.35, 50, <1.9, 1.5, 4>) }

// ---- hills ----------------------------------------------------------------------------------

#declare Field = finish { ambient 0.1 diffuse 0.65 }
bicubic_patch {
    type 1 flatness 0 u_steps 4 v_steps 4
    <-16, -2, -6>, <-16, 1.0, 0>, <-16, 2.6, 6>, <-16, 0.5, 14>,
    <-5, -2, -6>, <-5, 0.6, 0>, <-5, 1.4, 6>, <-5, 0.0, 14>,
    <5, -2, -6>, <5, -0.2, 0>, <5, 1.8, 6>, <5, 1.4, 14>,
    <16, -2, -6>, <16, 0.4, 0>, <16, 2.4, 6>, <16, 1.5, 14>
    uv_mapping
    texture {
        pigment {
            checker rgb <0.32, 0.42, 0.12>, rgb <0.50, 0.50, 0.16>
            scale <1/10, 1/14, 1>
        }
        finish { Field }
    }
    texture {
        pigment {
            gradient y
            color_map {
                [0.0 rgbt <1, 1, 1, 1>]
                [0.8 rgbt <1, 1, 1, 1>]
                [0.8 rgbt <0.10, 0.20, 0.05, 0.3>]
                [1.0 rgbt <0.10, 0.20, 0.05, 0.3>]
            }
            scale 1/56
        }
        finish { Field }
    }
}

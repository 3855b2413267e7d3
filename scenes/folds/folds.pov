// SPDX-License-Identifier: CC0-1.0
// A gallery of patches that are hard to intersect. From left to right: a ball of eight patches, each with
// one edge that is a single point; a ribbon that folds over itself twice, so that a ray can meet one
// patch up to three times; an arch whose rows run from a curve through a cusp to a loop; a spindle of
// four patches with two collapsed edges each; in front, a cushion of two patches that share all four
// edges and touch at their corners.
//
// Must meet: with --method facets, at most 1 pixel in 10,000 differs from POV-Ray's by more than one step
// of 8 bits (tests/test_pictures.c). With --method qi only POV-Ray's triangles make a difference.
//
//   povray +Iscenes/folds/folds.pov +W640 +H400 +A0.3
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 6 }

camera {
    perspective
    location <0.5, 3.0, -10.5>
    right x*image_width/image_height
    angle 45
    look_at <0, 1.12, 0>
}

light_source { <-6, 9, -8> rgb <1.3, 1.2, 1.05> }
light_source { <7, 6, -9> rgb <0.35, 0.4, 0.5> shadowless }

// The hall: a floor of slabs, a wall that darkens upwards.
plane {
    y, 0
    pigment {
        checker rgb <0.52, 0.48, 0.42>, rgb <0.42, 0.38, 0.34>
        scale 1.4
        translate 0.7*x
    }
    finish { ambient 0.08 diffuse 0.65 reflection 0.06 }
}
plane {
    z, 6
    pigment {
        gradient y
        color_map {
            [0.0 rgb <0.46, 0.42, 0.44>]
            [0.5 rgb <0.22, 0.22, 0.28>]
            [1.0 rgb <0.08, 0.09, 0.13>]
        }
        scale 12
    }
    finish { ambient 0.12 diffuse 0.6 }
}

#macro Plinth(Where)
    box {
        <-0.75, 0, -0.75>, <0.75, 1, 0.75>
        pigment { rgb <0.62, 0.60, 0.57> }
        finish { ambient 0.08 diffuse 0.7 }
        translate Where
    }
#end
Plinth(-3.45*x)
Plinth(-1.15*x)
Plinth(1.15*x)
Plinth(3.45*x)

// 1: an eighth of the ball; its first row is the north (or, mirrored, the south) pole.
#declare K = 0.5522847498;
#declare Eighth = bicubic_patch {
    type 1 flatness 0 u_steps 4 v_steps 4
    <0, 1, 0>, <0, 1, 0>, <0, 1, 0>, <0, 1, 0>,
    <K, 1, 0>, <K, 1, K*K>, <K*K, 1, K>, <0, 1, K>,
    <1, K, 0>, <1, K, K>, <K, K, 1>, <0, K, 1>,
    <1, 0, 0>, <1, 0, K>, <K, 0, 1>, <0, 0, 1>
}
#declare Half_Ball = union {
    #for (I, 0, 3)
        object { Eighth rotate 90*I*y }
    #end
}
union {
    object { Half_Ball }
    object { Half_Ball scale <1, -1, 1> }
    pigment { rgb <0.85, 0.55, 0.20> }
    finish {
        ambient 0.05 diffuse 0.35 specular 0.8 roughness 0.01 metallic
        reflection { rgb <0.45, 0.30, 0.12>, rgb <0.9, 0.7, 0.4> falloff 2 }
    }
    scale 0.72
    rotate <20, 25, 0>
    translate <-3.45, 1.72, 0>
}

// 2: the ribbon.
bicubic_patch {
    type 1 flatness 0 u_steps 5 v_steps 3
    <-0.55, 0.00, -0.55>, <-0.55, 0.00, -0.2>, <-0.55, 0.00, 0.2>, <-0.55, 0.00, 0.55>,
    <1.95, 0.35, -0.65>, <1.95, 0.30, -0.2>, <1.95, 0.45, 0.2>, <1.95, 0.40, 0.65>,
    <-1.95, 1.05, -0.65>, <-1.95, 1.15, -0.2>, <-1.95, 0.95, 0.2>, <-1.95, 1.10, 0.65>,
    <0.55, 1.45, -0.40>, <0.55, 1.45, -0.2>, <0.55, 1.45, 0.2>, <0.55, 1.45, 0.40>
    texture {
        pigment { rgb <0.62, 0.08, 0.10> }
        finish { ambient 0.08 diffuse 0.7 specular 0.3 roughness 0.03 }
    }
    interior_texture {
        pigment { rgb <0.85, 0.66, 0.30> }
        finish { ambient 0.08 diffuse 0.7 specular 0.3 roughness 0.03 }
    }
    rotate 62*y
    translate <-1.15, 1.01, 0>
}

// 3: from an arch (back) through the cusp to a loop (front). At the cusp the two middle points of a
// row lie crosswise on the corners of a square.
#macro Crossed(Z, Reach, Height)
    <-0.5, 0, Z>, <-0.5 + Reach, Height, Z>, <0.5 - Reach, Height, Z>, <0.5, 0, Z>
#end
bicubic_patch {
    type 1 flatness 0 u_steps 4 v_steps 5
    Crossed(0.65, 0.25, 1.5)
    Crossed(0.25, 0.75, 1.7)
    Crossed(-0.25, 1.25, 1.7)
    Crossed(-0.65, 1.95, 1.5)
    texture {
        pigment { rgb <0.10, 0.42, 0.36> }
        finish { ambient 0.08 diffuse 0.65 specular 0.5 roughness 0.015 reflection 0.06 }
    }
    interior_texture {
        pigment { rgb <0.55, 0.72, 0.55> }
        finish { ambient 0.08 diffuse 0.65 specular 0.5 roughness 0.015 reflection 0.06 }
    }
    scale 0.9
    rotate 32*y
    translate <1.15, 1.01, 0>
}

// 4: the spindle; its first row is the lower tip, its last the upper one.
#declare Quarter_Spindle = bicubic_patch {
    type 1 flatness 0 u_steps 4 v_steps 3
    <0, 0, 0>, <0, 0, 0>, <0, 0, 0>, <0, 0, 0>,
    <0.85, 0.25, 0>, <0.85, 0.25, 0.85*K>, <0.85*K, 0.25, 0.85>, <0, 0.25, 0.85>,
    <0.40, 1.05, 0>, <0.40, 1.05, 0.4*K>, <0.4*K, 1.05, 0.40>, <0, 1.05, 0.40>,
    <0, 1.65, 0>, <0, 1.65, 0>, <0, 1.65, 0>, <0, 1.65, 0>
}
union {
    #for (I, 0, 3)
        object { Quarter_Spindle rotate 90*I*y }
    #end
    pigment {
        gradient y
        color_map {
            [0.0 rgb <0.06, 0.10, 0.32>]
            [0.5 rgb <0.12, 0.25, 0.60>]
            [0.5 rgb <0.80, 0.74, 0.58>]
            [0.54 rgb <0.80, 0.74, 0.58>]
            [0.54 rgb <0.12, 0.25, 0.60>]
            [1.0 rgb <0.30, 0.50, 0.80>]
        }
        scale 1.7
    }
    finish { ambient 0.08 diffuse 0.65 phong 0.6 phong_size 50 reflection 0.05 }
    rotate 20*y
    translate <3.45, 1, 0>
}

// 5: the cushion.
#macro Half_Cushion(H)
    bicubic_patch {
        type 1 flatness 0 u_steps 4 v_steps 4
        <-1, 0, -1>, <-0.4, 0, -0.75>, <0.4, 0, -0.75>, <1, 0, -1>,
        <-0.75, 0, -0.4>, <-0.3, H, -0.3>, <0.3, H, -0.3>, <0.75, 0, -0.4>,
        <-0.75, 0, 0.4>, <-0.3, H, 0.3>, <0.3, H, 0.3>, <0.75, 0, 0.4>,
        <-1, 0, 1>, <-0.4, 0, 0.75>, <0.4, 0, 0.75>, <1, 0, 1>
    }
#end
union {
    object { Half_Cushion(1) }
    object { Half_Cushion(-0.9) }
    pigment {
        checker rgb <0.62, 0.50, 0.62>, rgb <0.34, 0.20, 0.38>
        scale 0.25
    }
    finish { ambient 0.08 diffuse 0.7 }
    scale 0.8
    rotate 35*y
    translate <0.05, 0.41, -2.6>
}

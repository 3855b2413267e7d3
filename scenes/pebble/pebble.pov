// SPDX-License-Identifier: CC0-1.0
// A pebble of six patches that is closed, so that --patch-solids takes it as a solid: hollowed,
// cut open, and as what cuts. For POV-Ray patches have no inside; there the cuts are gone.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 10 }
camera { location <0, 4.2, -7> right 16/10*x look_at <0, 0.1, 0> angle 51 }
light_source { <-5, 9, -6>, 1 area_light x, z, 3, 3 adaptive 0 }
light_source { <7, 4, -4>, 0.35 shadowless }
background { rgb <0.55, 0.62, 0.7> }
plane { y, -1 pigment { checker rgb 0.35 rgb 0.45 scale 0.7 } finish { reflection 0.06 } }

// A point of the cube from -1 to 1, pressed towards the sphere: the same on both sides of an edge.
#macro Round(P) (P * 1.25 / pow(vlength(P), 0.72)) #end
#macro Face(U, V, N)
  bicubic_patch { type 1 flatness 0 u_steps 4 v_steps 4
    #for (I, 0, 3) #for (J, 0, 3)
      , Round(N + (2*I/3 - 1)*U + (2*J/3 - 1)*V)
    #end #end
  }
#end
#declare Pebble = union {
  Face(x, y, z) Face(x, y, -z) Face(y, z, x) Face(y, z, -x) Face(z, x, y) Face(z, x, -y)
  interior { ior 1.2 }
}

// Cut open: the inner wall is a smaller pebble.
difference {
  object { Pebble }
  object { Pebble scale 0.8 pigment { rgb <0.95, 0.8, 0.55> } }
  box { <0, -2, -2>, <2, 2, 0> rotate 20*y }
  pigment { rgb <0.25, 0.4, 0.65> } finish { phong 0.5 }
  scale <1, 0.8, 1> rotate 25*y translate <-2.1, -0.05, 0>
}
// A block with the pebble's print.
difference {
  box { <-1, -1, -1>, <1, 0.2, 1> }
  object { Pebble scale 0.7 rotate <20, 30, 0> translate 0.25*y }
  pigment { rgb <0.8, 0.45, 0.3> } finish { phong 0.3 }
  rotate 15*y translate 0.2*x
}
// What the pebble and some rods have in common.
intersection {
  object { Pebble scale 0.9 }
  union {
    #for (I, -3, 3) #for (K, -3, 3) cylinder { <I*0.3, -2, K*0.3>, <I*0.3, 2, K*0.3>, 0.13 } #end #end
  }
  pigment { rgb <0.5, 0.65, 0.35> } finish { phong 0.4 }
  rotate 35*y translate <2.4, -0.05, -0.1>
}

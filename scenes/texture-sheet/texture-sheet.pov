// CC0. A sheet of textures from the standard includes, each on a curved patch.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 8 }

#include "colors.inc"
#include "textures.inc"
#include "metals.inc"
#include "woods.inc"
#include "stones.inc"
#include "glass.inc"
#include "skies.inc"
#include "stars.inc"
#include "texture-sheet.inc"

#declare Columns = 6;
#declare Sheet = array[24] {
    texture { Jade }, texture { Red_Marble }, texture { White_Marble },
    texture { Blood_Marble }, texture { Blue_Agate }, texture { Sapphire_Agate },
    texture { Pink_Granite }, texture { Cherry_Wood }, texture { Sandalwood },
    texture { T_Wood7 }, texture { T_Wood19 }, texture { T_Wood33 },
    texture { T_Stone1 }, texture { T_Stone16 }, texture { T_Stone24 },
    texture { T_Grnt9 }, texture { T_Grnt25 }, texture { T_Crack1 },
    texture { T_Brass_3C }, texture { T_Chrome_2D }, texture { T_Copper_4B },
    texture { T_Cloud3 }, texture { Starfield2 }, texture { Cork }
}

#macro Swatch(Number)
    object {
        Swatch_Patch()
        texture { Sheet[Number] }
        translate <7.4 * mod(Number, Columns), -6.2 * div(Number, Columns), 0>
    }
#end

#declare I = 0;
#while (I < dimension_size(Sheet, 1))
    Swatch(I)
    #declare I = I + 1;
#end

Swatch_Floor()
camera { orthographic location <18.5, -9.3, -20> direction z up 26*y right 45*x }
light_source { <0, 30, -40>, rgb 0.9 }
light_source { <40, -20, -30>, rgb 0.3 shadowless }

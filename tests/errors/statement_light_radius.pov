// 2:26 needs spotlight
light_source { <1,2,3> 1 radius 5 spotlight }

// 2:34 'internal(79)' does not exist
#declare f = function { internal(79) }

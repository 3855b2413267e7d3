// 3:12 camera after its name
#declare C = camera { }
camera { C location x }

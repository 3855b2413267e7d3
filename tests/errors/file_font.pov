// 2:12 font 'nope.ttf'
text { ttf "nope.ttf" "A", 1, 0 }

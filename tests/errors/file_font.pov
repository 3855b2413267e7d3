// 2:12 cannot open font file 'nope.ttf'
text { ttf "nope.ttf" "A", 1, 0 }

// 2:43 expected a kind of warp
sphere { 0, 1 pigment { gradient x warp { foo } } }

// 2:1 (reserved words are in small letters: 'sphere')
Sphere { 0, 1 }

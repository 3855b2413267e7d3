// 2:13 '}' found
sphere { 0, }

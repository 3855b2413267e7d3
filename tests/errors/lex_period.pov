// 2:15 additional '.' in floating-point
#if (0) cat 5..6 meow #end

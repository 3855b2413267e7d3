// 2:16 mis-matched '#else'
#if (0) #else #else #end

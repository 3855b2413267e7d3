// 3:1 comment never ends
#declare A = 1;
/* open /* closed */

// 2:2 mis-matched '#end'
#end

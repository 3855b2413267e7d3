// 2:16 expected 'function' in 'isosurface'
isosurface {   threshold 1 function { x } }

// 2:41 radiosity importance must be greater than 0.0
sphere { 0, 1 radiosity {    importance -1 } }

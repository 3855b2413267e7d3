// 2:2 undeclared identifier 'foo' found after '#'
#foo

// 2:1 undeclared identifier 'Import'
Import foo

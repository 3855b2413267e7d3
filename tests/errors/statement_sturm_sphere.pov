// 2:15 'sturm' cannot be used
sphere { 0, 1 sturm }

// User functions: their own language.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "check.inc"
#declare K = 5;
#declare Square = function(x) { x*x }
Check("call", Square(3) + Square(0.5)*4, 10)
#declare Frozen = function(u, v) { x + 10*y + K }
#declare K = 50;
Check("x is u, y is v; constants are frozen", Frozen(1, 2), 26)
#declare Swapped = function(y, x) { x + 10*y + 100*z }
Check("by name, not by place; z is not there", Swapped(1, 2), 12)
#declare Mixed = function(a, x) { a*100 + x + u + y }
Check("names", Mixed(1, 2), 104)
#declare Plain = function { x + 10*y + 100*z }
Check("x, y, z without a list", Plain(1, 2, 3), 321)
#declare Logic = function(a b c) { a | b & c }
Check("& before |", Logic(1, 1, 0) + 10*Logic(0, 1, 1) + 100*Logic(0, 1, 0), 11)
#declare Compare = function(x) { (x<2)*10 + (x<=2)*100 + (x>2) + (x>=2)*1000 + (x!=2)*10000 }
Check("comparisons", Compare(2) + Compare(1) + Compare(3), 1100 + 10110 + 11001)
#declare Chain = function(x) { 3 = 3 < 4 }
Check("one level of comparisons", Chain(0), 1)
#declare Exact = function(x) { 1e-11 = 0 }
Check("no tolerance", Exact(0), 0)
#declare Series = function(n) { sum(i, 1, n, i*i) + prod(j, 1, n, j) }
Check("sum and prod", Series(4), 30 + 24)
#declare Table = function(m, n) { sum(i, 1, m, sum(j, 1, n, i*j)) }
Check("nested sums", Table(3, 4), 60)
#declare Signs = function(x) { -x*2 + +x - -x }
Check("signs", Signs(3), 0)
#declare Choices = function(x) { min(x, 2, 3) + max(x, 5)*select(x, 1, 2, 3) + select(x, 7, 8) }
Check("min max select", Choices(1)*10000 + Choices(-1)*100 + Choices(0), 24*10000 + 11*100 + 18)
#declare Whole = function(x) { div(x, 2) + mod(x, 2) + int(x/3) + floor(x) + ceil(x) + abs(-x) }
Check("integers", Whole(7.25) + Whole(-7.25), 3 + 1.25 + 2 + 7 + 8 + 7.25 - 3 - 1.25 - 2 - 8 - 7 + 7.25)
#declare Calls = function(x) { Square(Square(x)) + Frozen(x, x) }
Check("functions in functions", Calls(2), 16 + 27)
#declare Real = function(x) {
  sin(x) + cos(x)*tan(x) + asin(x) + acos(x) + atan(x) + atan2(x, 2) + pow(x, 3) + exp(x) + ln(x)
  + log(x) + sqrt(x) + sinh(x) + cosh(x) + tanh(x) + asinh(x) + atanh(x) + radians(x) + degrees(x)
  + acosh(1 + x) + pi
}
#declare x0 = 0.3;
#declare Sum = sin(x0) + cos(x0)*tan(x0) + asin(x0) + acos(x0) + atan(x0) + atan2(x0, 2);
#declare Sum = Sum + pow(x0, 3) + exp(x0) + ln(x0) + log(x0) + sqrt(x0) + sinh(x0) + cosh(x0);
#declare Sum = Sum + tanh(x0) + asinh(x0) + atanh(x0) + radians(x0) + degrees(x0) + acosh(1 + x0);
Check("all of them as in expressions", Real(x0), Sum + pi)
#macro Ten() 10 #end
#declare Expanded = function(x) { x*Ten() + #if (K = 50) 7 #else 8 #end }
Check("macros and directives inside", Expanded(2), 27)
#declare A = array[2] { 3, 4 }
#declare OfArray = function(x) { x*A[1] }
Check("array elements", OfArray(2), 8)
#declare Alias = Square;
#undef Square
Check("copied", Alias(3) + Calls(1), 9 + 17)
Check("no commas needed", Frozen(1 2), 26)
CheckV("in a vector", <Alias(1), Alias(2), Alias(3)>, <1, 4, 9>)
CheckV("a float in the place of a vector", vrotate(Alias(2), 0), <4, 4, 4>)
#declare Curve = function { spline { 0, <1, 2, 3> 1, <4, 5, 6> } }
CheckV("spline", Curve(0.5), <2.5, 3.5, 4.5>)
Check("component", Curve(0.5).y, 3.5)
#declare OfCurve = function(x) { Curve(x).z*2 }
Check("component inside", OfCurve(0.5), 9)
#declare Wrapped = function { internal(24) }
#declare Uses = function { Wrapped(x, y, z, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10) + Wrapped(0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10) }
sphere { 0, 1 }

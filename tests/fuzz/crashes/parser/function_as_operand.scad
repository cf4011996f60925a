a = [for (i = [0:2]) if (i % 2 == 0) each [i, -i] else let(k = i) k];
b = [for (i = 0, j = 1; i < 3; i = i + 1) [i, j]];
c = function(x) x ^ 2;
d = c(2)[0].x + (function(y)each1) - +1 /+!true || false && 1 <= 2 != 3 >= .5e-3;
e = assert(true, "m") echo("e", d) [1:2:3];
f = undef; g = [1- 2,]; h = a[0][1]; i = "x" < "y" == true; j = ~1 | 2 & 3 << 1 >> 1;

// Identities of two's complement, for many pairs.
function bits(n) = [for (k = [15 : -1 : 0]) (n >> k) & 1];
function value(bits, k = 0) = k == 16 ? 0 : bits[k] * 2 ^ (15 - k) + value(bits, k + 1);
pairs = [for (a = [0 : 777 : 65535], b = [5 : 1234 : 65535]) [a, b]];
echo([for (p = pairs) if ((p.x | p.y) + (p.x & p.y) != p.x + p.y) p]);
echo([for (p = pairs) if (~(p.x & p.y) != (~p.x | ~p.y)) p]);
echo([for (p = pairs) if (value(bits(p.x)) != p.x || ~p.x != -p.x - 1) p]);
echo([for (k = [0 : 52]) if (1 << k != 2 ^ k || 2 ^ k >> k != 1) k]);

// Arithmetic binds more tightly, comparison less; & before |, shifts first.
echo(1 | 2 + 4, 6 & 3 << 1, 1 | 6 & 2, 1 << 2 << 3, 64 >> 2 >> 1);
echo(2 | 1 == 3, 4 > 1 | 2, 1 & 1 && 2, 1 << 1 + 1, ~1 ^ 2, ~-1, !~-1);

// Cut towards zero; all of 64 bits, sign included.
echo(1.9 | 0, -1.9 | 0, -1.5 & 3, -8 >> 1, 1 << 63, 1 << 32 << 32, -1 >> 63);
echo(1e30 | 0, (0 / 0) & -1);

// What has no meaning.
echo(1 << 64, 1 >> -1, 1 << -0.5);
echo(1 | "a", [1] & 2, true << 1, 1 >> undef, ~"a");
x = undef;
echo(x | 1);
echo(~x);
echo(function(a, b) ~a | b & 1 << 2 >> 3);

// expect: ECHO: []
// expect: ECHO: []
// expect: ECHO: []
// expect: ECHO: []
// expect: ECHO: 7, 6, 3, 32, 8
// expect: ECHO: true, true, true, 4, -2, 0, true
// expect: ECHO: 1, -1, 3, -4, -9.22337e+18, 0, -1
// expect: ECHO: -9.22337e+18, -9.22337e+18
// expect: WARNING: shift too large in file bitwise.scad, line 19
// expect: WARNING: negative shift in file bitwise.scad, line 19
// expect: ECHO: undef, undef, 1
// expect: WARNING: undefined operation (number | string) in file bitwise.scad, line 20
// expect: WARNING: undefined operation (vector & number) in file bitwise.scad, line 20
// expect: WARNING: undefined operation (bool << number) in file bitwise.scad, line 20
// expect: WARNING: undefined operation (number >> undefined) in file bitwise.scad, line 20
// expect: WARNING: undefined operation (~string) in file bitwise.scad, line 20
// expect: ECHO: undef, undef, undef, undef, undef
// expect: WARNING: undefined operation (undefined | number) in file bitwise.scad, line 22
// expect: ECHO: undef
// expect: WARNING: undefined operation (~undefined) in file bitwise.scad, line 23
// expect: ECHO: undef
// expect: ECHO: function(a, b) (~a | (b & ((1 << 2) >> 3)))

echo(0x0, 0xff, 0xFF, 0x00010, -0x10, 0xdeadBEEF == 3735928559, [0x1, 0x2]);
echo(0xFFFFFFFF == 2 ^ 32 - 1, 0x20000000000000 == 2 ^ 53, 0x8000000000000000 == 2 ^ 63);
function f(n = 0xa) = n + 0x1;
echo(f(), is_undef(0x1), [for (i = [0x1 : 0x3]) i]);
echo(0x20000000000001 == 2 ^ 53, 0xffffffffffffffff == 2 ^ 64);
echo(0x10000000000000000 == 2 ^ 64);

// What 2021.01 takes for a name is one, where something has it.
0xcafe = "mine";
function 0xbabe(n) = n;
echo(0xcafe, 0xbabe(5), let (0x1 = 7) 0x1);
echo(0XFF, 0x, 0xfg, 0b, 0b102);

// Binary ones are ours.
echo(0b0, 0b101, -0b10, 0b11111111 == 0xff, 0b1 << 3);
0b11 = "mine";
echo(0b11);

// expect: ECHO: 0, 255, 255, 16, -16, true, [1, 2]
// expect: ECHO: true, true, true
// expect: ECHO: 11, false, [1, 2, 3]
// expect: WARNING: Integer "0x20000000000001" cannot be represented precisely in file prefixed_numbers.scad, line 5
// expect: WARNING: Integer "0xffffffffffffffff" cannot be represented precisely in file prefixed_numbers.scad, line 5
// expect: ECHO: true, true
// expect: WARNING: Hexadecimal constant "0x10000000000000000" too large in file prefixed_numbers.scad, line 6
// expect: ECHO: true
// expect: ECHO: "mine", 5, 7
// expect: WARNING: Ignoring unknown variable '0XFF' in file prefixed_numbers.scad, line 12
// expect: WARNING: Ignoring unknown variable '0x' in file prefixed_numbers.scad, line 12
// expect: WARNING: Ignoring unknown variable '0xfg' in file prefixed_numbers.scad, line 12
// expect: WARNING: Ignoring unknown variable '0b' in file prefixed_numbers.scad, line 12
// expect: WARNING: Ignoring unknown variable '0b102' in file prefixed_numbers.scad, line 12
// expect: ECHO: undef, undef, undef, undef, undef
// expect: ECHO: 0, 5, -2, true, 8
// expect: ECHO: "mine"

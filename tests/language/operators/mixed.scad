echo(1 + "a");
echo([1, 2] + [3, 4, 5], [1, 2] - [3], [1, "a"] + [1, 1]);
echo([1, 2] * 3, 3 * [1, [2]], [1, 2] / 2, 2 / [1, 4], 7 % 3, -7 % 3);
echo([1, 2] * [3, 4], [[1, 2], [3, 4]] * [5, 6], [5, 6] * [[1, 2], [3, 4]]);
echo([[1, 2], [3, 4]] * [[0, 1], [1, 0]]);
echo([1, 2] * [1, 2, 3]);
echo([] * [1]);
echo(["a"] * [1]);
echo([[1, 2], [3]] * [1, 2]);
echo(2 ^ 10, 2 ^ -1, 2 ^ 3 ^ 2, -2 ^ 2);
echo(1 < 2, "a" < "b", true > false, [1, 2] < [1, 3], 1 < "a");
echo([1, "a"] < [1, 2]);
echo(undef == undef, undef < 1, undef + 1, -undef, -"a", !undef, !"");
echo(1 == true, "1" == 1, [1] == [1], [0 : 2] == [0 : 1 : 2.5]);
echo(true && undef, 0 || "a", false && (1 + "a"));
echo(1 / 0, -1 / 0, 0 / 0, 0 * -1);
echo([1, 2, 3].x, [1, 2, 3].z, [1].y, [1 : 3].step, "abc".x);
echo([1, 2][0], [1, 2][2], [1, 2][-1], [1, 2]["a"], "abc"[1], "äöü"[1], [5 : 7][2], [1, 2][0.9]);

// expect: WARNING: undefined operation (number + string) in file mixed.scad, line 1
// expect: ECHO: undef
// expect: ECHO: [4, 6], [-2], [2, undef]
// expect: ECHO: [3, 6], [3, [6]], [0.5, 1], [2, 0.5], 1, -1
// expect: ECHO: 11, [17, 39], [23, 34]
// expect: ECHO: [[2, 1], [4, 3]]
// expect: WARNING: vector*vector requires matching lengths (2 != 3) in file mixed.scad, line 6
// expect: ECHO: undef
// expect: WARNING: Multiplication is undefined on empty vectors in file mixed.scad, line 7
// expect: ECHO: undef
// expect: WARNING: undefined vector*vector multiplication where first elements are types string and number in file mixed.scad, line 8
// expect: ECHO: undef
// expect: WARNING: Matrix must be rectangular. Problem at row 1 in file mixed.scad, line 9
// expect: ECHO: undef
// expect: ECHO: 1024, 0.5, 512, -4
// expect: WARNING: undefined operation (number < string) in file mixed.scad, line 11
// expect: ECHO: true, true, true, true, undef
// expect: WARNING: undefined operation (string < number)
// expect: \tin vector comparison at index 1 in file mixed.scad, line 12
// expect: ECHO: undef
// expect: WARNING: undefined operation (undefined < number) in file mixed.scad, line 13
// expect: WARNING: undefined operation (undefined + number) in file mixed.scad, line 13
// expect: WARNING: undefined operation (-undefined) in file mixed.scad, line 13
// expect: WARNING: undefined operation (-string) in file mixed.scad, line 13
// expect: ECHO: true, undef, undef, undef, undef, true, true
// expect: ECHO: false, false, true, true
// expect: ECHO: false, true, false
// expect: ECHO: inf, -inf, nan, 0
// expect: ECHO: 1, 3, undef, 1, undef
// expect: ECHO: 1, undef, undef, undef, "b", "ö", 7, 1

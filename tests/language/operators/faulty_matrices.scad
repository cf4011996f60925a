// OpenSCAD warns twice where a vector meets a faulty matrix from the left.
echo(["a", 1] * [1, 2]);
echo([1, 2] * [["a", 1], [2, 3]]);
echo([1, 2] * [[1, 2], [3]]);
echo([[1, 2], [3, "a"]] * [[1, 2], [3, 4]]);
echo([[1, 2], ["a", 1]] * [1, 2]);

// expect: WARNING: undefined vector*vector multiplication where first elements are types string and number in file faulty_matrices.scad, line 2
// expect: ECHO: undef
// expect: WARNING: Matrix must contain only numbers. Problem at row 0, col 0
// expect: WARNING: Matrix must contain only numbers. Problem at row 0, col 0 in file faulty_matrices.scad, line 3
// expect: ECHO: undef
// expect: WARNING: Matrix must be rectangular. Problem at row 1
// expect: WARNING: Matrix must be rectangular. Problem at row 1 in file faulty_matrices.scad, line 4
// expect: ECHO: undef
// expect: WARNING: Vector must contain only numbers. Problem at index 1
// expect: WARNING: Vector must contain only numbers. Problem at index 1
// expect: 	while processing left operand at row 1 in file faulty_matrices.scad, line 5
// expect: ECHO: undef
// expect: WARNING: Matrix must contain only numbers. Problem at row 1, col 0 in file faulty_matrices.scad, line 6
// expect: ECHO: undef

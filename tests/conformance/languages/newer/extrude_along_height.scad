// The height is a length along the vector.
linear_extrude(height = 5, v = [1, 2, 2]) square(2);

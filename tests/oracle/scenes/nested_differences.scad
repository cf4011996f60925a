// A difference of differences, eight deep.
module onion(n) {
  if (n == 0) cube(1.3, center = true);
  else difference() {
    if (n % 2 == 0) sphere(r = 1 + n, $fn = 20 + 2 * n);
    else cube(2 * (0.6 + n), center = true);
    onion(n - 1);
  }
}
onion(7);

$fn = 50;
$q = 7;
k = $q + 1;

function call() = [$q, $fn, k];

module show() {
  echo("show", $q, $fn, k);
  translate([2 * k * ($q == undef ? 1 : $q), 0, 0]) cylinder(r = 1, h = 1);
}

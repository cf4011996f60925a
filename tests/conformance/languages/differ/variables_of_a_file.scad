// `$` variables that a used file sets: whether its functions and modules see
// them.
use <used/variables_of_a_file.scad>
$fn = 7;
echo(call());
show();
module with() {
  $q = 3;
  $fn = 5;
  children();
}
with() {
  show();
  echo(call());
}

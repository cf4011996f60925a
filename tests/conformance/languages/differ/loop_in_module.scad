// Variables of a loop inside a module's children.
module twice() for ($i = [0, 1]) children();
$i = 7;
twice() { a = $i; echo(a, $i); translate([2 * a, 0, 0]) cube(1); }

// Used by use/uses.scad.
offset = 10;
hidden = 1;
function shifted(x) = x + offset;
function facets() = $fn;
module show(x = offset) { echo(x, hidden); }
module wrong() { echo(1 + "a"); nowhere(); cube(sice = 1); }
echo("not instantiated");

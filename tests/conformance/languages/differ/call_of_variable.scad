// A function in a variable whose name begins with a dollar sign.
$f = function (x) x + 1;
echo($f(2));
module m() { echo($f(3)); }
m($f = function (x) x * 2);

// What 2021.01 lets a program call so is the program's.
function object(x) = ["mine", x];
function has_key(x) = "mine";
function import(file) = str("own ", file);
echo(object(1), has_key(), import("a.json"), is_object(1));
is_object = function(x) "a variable";
echo(is_object(1));
object = 5;
echo(object, object(2), object.x);
module object(this) echo("module", this);
object(this = 3);
function this(this) = this;
echo(this(4), [for (object = [1, 2]) object]);

// expect: ECHO: ["mine", 1], "mine", "own a.json", "a variable"
// expect: ECHO: "a variable"
// expect: ECHO: 5, ["mine", 2], undef
// expect: ECHO: "module", 3
// expect: ECHO: 4, [1, 2]

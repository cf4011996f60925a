function positive(x) = assert(x > 0) x;
echo(positive(1));
assert(true, "never shown");
echo(assert(true));
x = assert(len("abc") == 3, "three") "fine";
echo(x);

// expect: ECHO: 1
// expect: ECHO: undef
// expect: ECHO: "fine"

o = object(a = 1, b = "two", c = [3, "x"]);
echo(o, str(o), object(), [object(o = o)]);

// Members by name; what is not there is undef without a word.
echo(o.a, o["b"], o.c[1], o.d, o["d"], o[0], o[undef], object(o = o).o.o, o.a.b);
echo(has_key(o, "a"), has_key(o, "d"), has_key(object(u = undef), "u"), len(o), len(object()));
echo([for (o = [o, 1, "a", [], [0 : 1], undef, true, function() 1]) is_object(o)]);
echo(is_list(o), is_string(o), is_undef(o), is_function(o), is_num(o), is_bool(o));
echo(o ? "full" : "empty", object() ? "full" : "empty");

// The last value counts, in the first place; removed and set again: at the end.
echo(object(a = 1, b = 2, a = 3), object(o, a = 7), object([["z", 1], ["y", 2]], x = 3));
echo(object(o, [["a"], ["d", 4]]), object(o, [["a"], ["a", 9]]), object([["q"]]), object(o, [], [["b"]]));
echo(object([["two words", 1], ["", 2]])["two words"], object([["", 2]])[""]);
echo(o);

// Keys, in order.
echo([for (k = o) k], [for (k = o) o[k]], [each o] == [o], object([for (k = o) [k, o[k]]]) == o);
for (k = o) echo(k);
for (k = object()) echo("never");

// Equal: the same members in the same order.
echo(o == object(o), o != object(o), object(o, [["a"]]) == o, object(a = 1, b = 2) == object(b = 2, a = 1));
echo(object(a = object(b = [1])) == object(a = object(b = [1])), object() == object(), object() == [], o == undef);
echo(o < o);
echo(o + 1);
echo(-o);

// Growing one member at a time; many members.
big = object([for (i = [1 : 20000]) [str("k", i), i]]);
echo(len(big), big.k20000, [for (i = [1 : 20000]) if (big[str("k", i)] != i) i]);
half = object(big, [for (i = [1 : 2 : 20000]) [str("k", i)]]);
echo(len(half), half.k1, half.k2, [for (k = half) if (half[k] % 2 == 1) k]);

// Nested deep, and freed again.
function nest(n, o = object()) = n == 0 ? o : nest(n - 1, object(o = o));
deep = nest(100000);
echo(deep == nest(100000), deep.o == nest(99999));

// expect: ECHO: { a = 1; b = "two"; c = [3, "x"]; }, "{ a = 1; b = "two"; c = [3, "x"]; }", { }, [{ o = { a = 1; b = "two"; c = [3, "x"]; }; }]
// expect: ECHO: 1, "two", "x", undef, undef, undef, undef, undef, undef
// expect: ECHO: true, false, true, 3, 0
// expect: ECHO: [true, false, false, false, false, false, false, false]
// expect: ECHO: false, false, false, false, false, false
// expect: ECHO: "full", "empty"
// expect: ECHO: { a = 3; b = 2; }, { a = 7; b = "two"; c = [3, "x"]; }, { z = 1; y = 2; x = 3; }
// expect: ECHO: { b = "two"; c = [3, "x"]; d = 4; }, { b = "two"; c = [3, "x"]; a = 9; }, { }, { a = 1; c = [3, "x"]; }
// expect: ECHO: 1, 2
// expect: ECHO: { a = 1; b = "two"; c = [3, "x"]; }
// expect: ECHO: ["a", "b", "c"], [1, "two", [3, "x"]], true, true
// expect: ECHO: "a"
// expect: ECHO: "b"
// expect: ECHO: "c"
// expect: ECHO: true, false, false, false
// expect: ECHO: true, true, false, false
// expect: WARNING: operation undefined (object < object) in file objects.scad, line 25
// expect: ECHO: undef
// expect: WARNING: undefined operation (object + number) in file objects.scad, line 26
// expect: ECHO: undef
// expect: WARNING: undefined operation (-object) in file objects.scad, line 27
// expect: ECHO: undef
// expect: ECHO: 20000, 20000, []
// expect: ECHO: 10000, undef, 2, []
// expect: ECHO: true, true

o = object(a = 1);
echo(object(o, 5));
echo(object(o, "a"), object(undef));
echo(object(o, [], [["b", 2], 7]));
echo(object([[]]));
echo(object([["a", 1, 2]]));
echo(object([[1, 2]]), object([[[]]]));
echo(has_key(o), has_key(1, "a"), has_key(o, 2));
echo(is_object(), is_object(1, 2));
echo(o.b());
echo(o());

// expect: WARNING: object(Argument 1 <number>) An unnamed argument must be either <object> or <list>, it is <number>.  in file wrong_objects.scad, line 2
// expect: ECHO: undef
// expect: WARNING: object(Argument 1 <string>) An unnamed argument must be either <object> or <list>, it is <string>.  in file wrong_objects.scad, line 3
// expect: WARNING: object(Argument 0 <undefined>) An unnamed argument must be either <object> or <list>, it is <undefined>.  in file wrong_objects.scad, line 3
// expect: ECHO: undef, undef
// expect: WARNING: object( Argument 2 [Element 1 <number>] ) Entry type is not a list, it is <number>. In an unnamed list, entries must be [key,value] to set or [key] to delete. The key must be <string>. in file wrong_objects.scad, line 4
// expect: ECHO: undef
// expect: WARNING: object(Argument 0 [Element 0 []]) Entry is empty. In an unnamed list, entries must be [key,value] to set or [key] to delete. The key must be <string>. in file wrong_objects.scad, line 5
// expect: ECHO: undef
// expect: WARNING: object(Argument 0 [Element 0 [...]]) Entry length is 3, must be 1 [key] or 2 [key,value]. In an unnamed list, entries must be [key,value] to set or [key] to delete. The key must be <string>. in file wrong_objects.scad, line 6
// expect: ECHO: undef
// expect: WARNING: object(Argument 0 [Element 0 [<number>,value]]) The key of the entry is not <string> but <number>. In an unnamed list, entries must be [key,value] to set or [key] to delete. The key must be <string>. in file wrong_objects.scad, line 7
// expect: WARNING: object(Argument 0 [Element 0 [<vector>]]) The key of the entry is not <string> but <vector>. In an unnamed list, entries must be [key,value] to set or [key] to delete. The key must be <string>. in file wrong_objects.scad, line 7
// expect: ECHO: undef, undef
// expect: WARNING: has_key() number of parameters does not match: expected 2, found 1 in file wrong_objects.scad, line 8
// expect: WARNING: has_key() parameter could not be converted: argument 0: expected object, found number (1) in file wrong_objects.scad, line 8
// expect: WARNING: has_key() parameter could not be converted: argument 1: expected string, found number (2) in file wrong_objects.scad, line 8
// expect: ECHO: undef, undef, undef
// expect: WARNING: is_object() number of parameters does not match: expected 1, found 0 in file wrong_objects.scad, line 9
// expect: WARNING: is_object() number of parameters does not match: expected 1, found 2 in file wrong_objects.scad, line 9
// expect: ECHO: undef, undef
// expect: WARNING: Can't call function on undefined in file wrong_objects.scad, line 10
// expect: ECHO: undef
// expect: WARNING: Ignoring unknown function 'o' in file wrong_objects.scad, line 11
// expect: ECHO: undef

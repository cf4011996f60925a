echo(str("a", 1, [1, "b"], undef, true), str());
echo(len("äöü"), len([1, 2]), len(5));
echo(chr(65), chr([72, 105]), chr([97 : 99]), chr(8364), chr(-1), chr("a"));
echo(ord("a"), ord("€"), ord(""), ord(5));
echo(concat([1], [2, 3], 4), concat("a"), concat());
echo(search("a", "abcabc"), search("abc", "cabd", 0), search("x", "abc"));
echo(search(3, [1, 3, 5, 3], 0), search([3, 9], [1, 3, 5]));
echo(search("b", [["a", 1], ["b", 2]]), search("z", [["a", 1]]));
echo(is_undef(nothing), is_undef(1), is_bool(true), is_num(1/0), is_num(0/0), is_string(""), is_list([]), is_function(1));
echo(version(), version_num());

// expect: ECHO: "a1[1, "b"]undeftrue", ""
// expect: WARNING: len() parameter could not be converted in file strings.scad, line 2
// expect: ECHO: 3, 2, undef
// expect: ECHO: "A", "Hi", "abc", "€", "", ""
// expect: WARNING: ord() argument 5 is not of type string in file strings.scad, line 4
// expect: ECHO: 97, 8364, undef, undef
// expect: ECHO: [1, 2, 3, 4], ["a"], []
// expect: ECHO: [0], [[1], [2], [0]], []
// expect: ECHO: [1, 3], [1, []]
// expect: WARNING: search term not found: "z" in file strings.scad, line 8
// expect: ECHO: [1], []
// expect: ECHO: true, false, true, true, false, true, true, false
// expect: ECHO: [2021, 1, 0], 2.02101e+7

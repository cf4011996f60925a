v = [10, "b", [30], 40, 50];
echo(v.x, v.y, v.z, v.w, v.r, v.g, v.b, v.a);
echo(v.xy, v.zyx, v.wwww, v.rgba, v.ba);
// The same as writing the elements one by one.
echo(v.xwz == [v.x, v.w, v.z], v.bg == v.zy, v.xyz.zyx.zyx == v.xyz);
// Letters of both kinds, too many or others: nothing.
echo(v.xr, v.xyxyx, v.xyq, v.q, v.xx2, v["x"]);
// A short vector has no more than its elements.
echo([1].y, [1, 2].xyz, [].w, "text".x, (5).x, undef.xy, [1 : 3].x);

// expect: ECHO: 10, "b", [30], 40, 10, "b", [30], 40
// expect: ECHO: [10, "b"], [[30], "b", 10], [40, 40, 40, 40], [10, "b", [30], 40], [[30], 40]
// expect: ECHO: true, true, true
// expect: ECHO: undef, undef, undef, undef, undef, undef
// expect: ECHO: undef, [1, 2, undef], undef, undef, undef, undef, undef

// Arguments without a name count in 2026 only.
f = "measures.dxf";
echo(dxf_dim(f), dxf_dim(f, "d"), dxf_dim(f, "d", [0, 0], 2, "n"));
echo(dxf_dim(layer = "d", f), dxf_dim(file = f, "d"), dxf_dim(f, undef, [1, 2]));
echo(dxf_cross(f), dxf_cross(f, "0", [1, 2], 3));

ring = import("ring.json");
echo(ring);
echo(ring.size, ring.stones[0].at.zx, ring["name"], ring.stones[1].d, is_undef(ring.note), has_key(ring, "note"));
echo(import(file = "ring.json") == ring, [for (key = ring) key]);
echo(import("ring.json", 1, layer = 2) == ring);
use <import_json_part.scad>
include <import_json_part.scad>
echo(part_size(), part_name);

// expect: ECHO: {  = { }; Size = 1.84467e+19; engraved = true; name = "Ada ♥ "A""; note = undef; size = 58; stones = [{ at = [0, 1.5, -0.002]; d = 1.25; }, { at = []; d = 1000; }]; }
// expect: ECHO: 58, [-0.002, 0], "Ada ♥ "A"", 1000, true, true
// expect: ECHO: true, ["", "Size", "engraved", "name", "note", "size", "stones"]
// expect: WARNING: Too many unnamed arguments supplied in file import_json.scad, line 5
// expect: WARNING: variable layer not specified as parameter in file import_json.scad, line 5
// expect: ECHO: true
// expect: ECHO: 58, "Ada ♥ "A""

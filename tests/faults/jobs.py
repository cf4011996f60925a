"""What is run while the world breaks: every command and every format once."""

import struct
import zlib


def _binary_stl():
    """A tetrahedron."""
    corners = [(0, 0, 0), (3, 0, 0), (0, 3, 0), (0, 0, 3)]
    faces = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]
    bytes_ = b"\0" * 80 + struct.pack("<I", len(faces))
    for face in faces:
        bytes_ += struct.pack("<3f", 0, 0, 0)
        for corner in face:
            bytes_ += struct.pack("<3f", *corners[corner])
        bytes_ += b"\0\0"
    return bytes_


def _grey_png():
    """2 × 2 pixels."""
    def chunk(name, data):
        return (struct.pack(">I", len(data)) + name + data +
                struct.pack(">I", zlib.crc32(name + data)))
    rows = b"\0\x10\xff" b"\0\xff\x40"
    return (b"\x89PNG\r\n\x1a\n" +
            chunk(b"IHDR", struct.pack(">2I5B", 2, 2, 8, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


_PANEL = (b'{"name":"tiny","pixels":[64,64],"pixel_mm":[0.2,0.2],'
          b'"right":"+x","up":"+y"}')

_LAYERS = (b'{"units":"mm","layers":[{"z":0.5,"bottom":0,"top":1,"contours":'
           b'[{"hole":false,"points":[[0,0],[4,0],[4,4],[0,4]]}]}]}')

INPUTS = {
    "a.scad": b"difference() { cube(4); translate([2, 2, -1])"
              b" cylinder(r = 1, h = 9, $fn = 8); }\n",
    "b.scad": b"size = 3;\necho(size); sphere(size, $fn = 12);\n",
    "slow.scad": b"for (x = [0 : 11]) for (y = [0 : 11])"
                 b" translate([x, y, 0]) sphere(0.7, $fn = 30);\n",
    "wordy.scad": b"for (i = [0 : 3000])"
                  b" echo(\"a line that makes the output long\", i);\ncube(1);",
    "solids.scad": b"include <part.scad>\nuse <b.scad>\n"
                   b"hull() { part(); translate([5, 0, 0]) cube(1); }\n"
                   b"minkowski() { cube(1); sphere(1, $fn = 6); }\n"
                   b"translate([9, 0, 0]) rotate([0, 0, 5])"
                   b" linear_extrude(1) offset(1) projection() part();\n",
    "part.scad": b"module part() { rotate_extrude($fn = 9) translate([2, 0])"
                 b" circle(1, $fn = 7); }\n",
    "deep.scad": b'include <d/e/part.scad>\npart(); import("d/e/t.stl");\n'
                 b'surface("d/e/t.dat");\n',
    "files.scad": b'import("t.stl"); import("t.off");\n'
                  b'linear_extrude(1) import("t.svg");\n'
                  b'linear_extrude(1) import("t.dxf");\n'
                  b'surface("t.dat"); surface("t.png");\n',
    "text.scad": b'cube(1); linear_extrude(1) text("lamina", size = 4);\n',
    "font.scad": b"use <t.ttf>\n"
                 b'linear_extrude(1) text("lamina", size = 4);\n',
    "table.csv": b"name,size\nada,2\nbob,3\ncyd,4\n",
    "tiny.json": _PANEL,
    "a.layers.json": _LAYERS,
    "t.stl": _binary_stl(),
    "t.off": b"OFF 4 4 6\n0 0 0\n3 0 0\n0 3 0\n0 0 3\n"
             b"3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n",
    "t.svg": b'<svg xmlns="http://www.w3.org/2000/svg" width="9mm" height="9mm"'
             b' viewBox="0 0 9 9"><path d="M1 1H8V8H1Z"/></svg>',
    "t.dxf": b"0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n8\n0\n10\n0\n20\n0\n40\n2\n"
             b"0\nENDSEC\n0\nEOF\n",
    "t.dat": b"0 1\n1 2\n",
    "t.png": _grey_png(),
}

# What stands under such a name where a run must not read it.
OUTSIDE = {
    "deep.scad": b"cube(50);\n",
    "part.scad": b"module part() { cube(50); }\n",
    "t.stl": INPUTS["t.stl"].replace(struct.pack("<f", 3), struct.pack("<f", 5)),
    "t.dat": b"5 7\n9 8\n",
}

# One that is installed, as a customer's.
_FONT = "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf"
with open(_FONT, "rb") as _file:
    INPUTS["t.ttf"] = _file.read()

# A folder of images such as lamina leaves.
OLD_FOLDER = {"index.json": b'{"maker":"lamina 0","images":["1.png"]}',
              "1.png": b"old"}


class Job:
    """One call of lamina.

    words    behind the program
    inputs   files that it needs
    outputs  what it makes; a folder ends with "/"
    prints   whether standard output is an output, too
    may_warn whether a warning excuses another output: of a font that cannot be
             found
    """

    def __init__(self, name, words, inputs, outputs=(), prints=False,
                 is_slow=False, may_warn=False):
        self.name = name
        self.words = words.split()
        self.inputs = inputs.split()
        self.outputs = list(outputs)
        self.prints = prints
        self.is_slow = is_slow
        self.may_warn = may_warn

    def hidden(self):
        """Names that its outputs may have before they have their own."""
        names = [name.rstrip("/").split("/")[-1] for name in self.outputs]
        return [f"out/.{name}.lamina-0" for name in names]

    def makes_folders(self):
        return any(name.endswith("/") for name in self.outputs)


def _slice(format_, more="", inputs="", folder=""):
    return Job(format_, f"a.scad -q -o out/a.{format_} {more}",
               f"a.scad {inputs}", [f"out/a.{format_}{folder}"])


_TINY = "--printer tiny.json --layer 0.2"

ALL = [
    _slice("slc"), _slice("cli"), _slice("svg"), _slice("layers.json"),
    _slice("slices.3mf"), _slice("csg"), _slice("echo"), _slice("ast"),
    _slice("zip", _TINY, "tiny.json"), _slice("sl1", _TINY, "tiny.json"),
    _slice("png", _TINY, "tiny.json", "/"),
    Job("long text", "wordy.scad -q -o out/a.echo", "wordy.scad",
        ["out/a.echo"]),
    Job("standard output", "a.scad -q -o - --export-format slc", "a.scad",
        prints=True),
    Job("rule and report", "a.scad -q -d out/a.d --report out/report.json "
        "-o out/a.slc", "a.scad", ["out/a.slc", "out/a.d", "out/report.json"]),
    Job("two designs", "a.scad b.scad -q -o out/", "a.scad b.scad",
        ["out/a.slc", "out/b.slc"]),
    Job("batch", "batch b.scad --table table.csv -q -o out/{name}.slc "
        "--report out/report.json", "b.scad table.csv",
        ["out/ada.slc", "out/bob.slc", "out/cyd.slc", "out/report.json"]),
    Job("inspect", "inspect a.layers.json", "a.layers.json", prints=True),
    Job("compare", "compare a.layers.json a.layers.json --report "
        "out/report.json --png out/a.png", "a.layers.json",
        ["out/report.json", "out/a.png"], prints=True),
    Job("view .png", "view a.layers.json -q -o out/a.png --width 300",
        "a.layers.json", ["out/a.png"]),
    Job("view .html", "view a.layers.json -q -o out/a.html", "a.layers.json",
        ["out/a.html"]),
    Job("solids", "solids.scad --layer 0.2 -o out/a.slc",
        "solids.scad part.scad b.scad", ["out/a.slc"]),
    Job("files", "files.scad -q --layer 0.2 -o out/a.slc",
        "files.scad t.stl t.off t.svg t.dxf t.dat t.png", ["out/a.slc"]),
    Job("files, confined", "files.scad -q --layer 0.2 -o out/a.slc --root .",
        "files.scad t.stl t.off t.svg t.dxf t.dat t.png", ["out/a.slc"]),
    Job("solids, confined", "solids.scad --layer 0.2 -o out/a.slc --root .",
        "solids.scad part.scad b.scad", ["out/a.slc"]),
    Job("deep, confined", "deep.scad --layer 0.2 -o out/a.slc --root .",
        "deep.scad d/e/part.scad d/e/t.stl d/e/t.dat", ["out/a.slc"]),
    Job("text", "text.scad --layer 0.2 --max-time 60 -o out/a.slc", "text.scad",
        ["out/a.slc"], may_warn=True),
    Job("font", "font.scad --layer 0.2 --max-time 60 -o out/a.slc", "font.scad t.ttf",
        ["out/a.slc"], may_warn=True),
    Job("slow .slc", "slow.scad -q -o out/a.slc", "slow.scad", ["out/a.slc"],
        is_slow=True),
    Job("slow .cli", "slow.scad -q -o out/a.cli", "slow.scad", ["out/a.cli"],
        is_slow=True),
    Job("slow .svg", "slow.scad -q -o out/a.svg", "slow.scad", ["out/a.svg"],
        is_slow=True),
    Job("slow .layers.json", "slow.scad -q -o out/a.layers.json", "slow.scad",
        ["out/a.layers.json"], is_slow=True),
    Job("slow .3mf", "slow.scad -q -o out/a.slices.3mf", "slow.scad", ["out/a.slices.3mf"],
        is_slow=True),
    Job("slow .zip", f"slow.scad -q -o out/a.zip {_TINY}",
        "slow.scad tiny.json", ["out/a.zip"], is_slow=True),
    Job("slow .png", f"slow.scad -q -o out/a.png {_TINY}",
        "slow.scad tiny.json", ["out/a.png/"], is_slow=True),
]

QUICK = [job for job in ALL if not job.is_slow]
SLOW = [job for job in ALL if job.is_slow]


def named(name):
    return next(job for job in ALL if job.name == name)

"""The files that Debian's packages openscad, openscad-mcad and
openscad-testing-data install, and how lamina is run on each of them."""
import re
import shutil
from dataclasses import dataclass, field
from pathlib import Path

DATA = Path("/usr/share/openscad")
FOLDERS = ("examples", "libraries", "testdata", "regression", "templates",
           "color-schemes")

MESHES = ("stl", "off", "amf", "3mf", "obj")
DRAWINGS = ("dxf", "svg")
HEIGHTS = ("png", "dat")
KINDS = ("scad", "csg", *MESHES, *DRAWINGS, *HEIGHTS, "json")

# The packages hold none of these.
MADE = {
    "made/tetrahedron.off": "OFF\n4 4 6\n0 0 0\n10 0 0\n0 10 0\n0 0 10\n"
                            "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n",
    "made/pyramid.off": "COFF\n# a comment\n5 5 0\n0 0 0 255 0 0 255\n"
                        "9 0 0 0 255 0 255\n9 9 0 0 0 255 255\n"
                        "0 9 0 0 0 0 255\n4 4 7 9 9 9 255\n4 3 2 1 0\n"
                        "3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n",
    "made/wedge.obj": "# a comment\nmtllib none.mtl\no wedge\nv 0 0 0\n"
                      "v 10 0 0\nv 10 10 0\nv 0 10 0\nv 0 0 5\nv 0 10 5\n"
                      "vn 0 0 -1\nvt 0 0\nusemtl none\ns off\n"
                      "f 4/1/1 3/1/1 2/1/1 1/1/1\nf 1//1 2//1 5//1\n"
                      "f 3 4 6\nf -5 -4 -1 -2\nf 1 5 6 \\\n4\n"}

# The expected pictures of openscad's own tests: a thousand, much alike.
PICTURES = "regression"

LAYER = "0.5"  # mm; the examples are some centimetres high
MANY = "5"  # mm, for pictures: a pixel is a millimetre


def place(text, tree, designs):
    return text.replace("{tree}", str(tree)).replace("{designs}", str(designs))


@dataclass(frozen=True)
class Run:
    """One run of lamina. `{tree}` and `{designs}` in the words stand for the
    copy of the data and the folder of `design`."""
    arguments: tuple
    ending: str  # of the output
    design: str = ""  # text of a design made for the run

    def words(self, tree, designs):
        return [place(word, tree, designs) for word in self.arguments]


@dataclass
class Input:
    path: str  # in the data
    data: bytes
    users: list = field(default_factory=list)  # paths of designs that name it
    sets: list = field(default_factory=list)  # names of parameter sets

    @property
    def kind(self):
        return self.path.rsplit(".", 1)[1].lower()

    @property
    def is_picture(self):
        return self.kind == "png" and self.path.startswith(PICTURES)

    def runs(self):
        """All runs for this file, that to layers first."""
        if self.kind in ("scad", "csg"):
            return layers(self.path) + texts(self.path)
        if self.kind in MESHES:
            cut = 'difference() { import("{file}"); cube([5, 5, 200]); }'
            return (layers(self.path) + self.designed(cut, "slc")
                    + self.designed(IMPORT, "csg"))
        if self.kind in DRAWINGS:
            solid = f"linear_extrude(2, twist = 20) {IMPORT}"
            outline = (self.designed(IMPORT, "svg") if self.kind == "svg"
                       else [Run(("{tree}/" + self.path,), "svg")])
            return (self.designed(solid, "slc") + outline
                    + self.designed(IMPORT, "csg"))
        if self.kind in HEIGHTS:
            return self.designed('surface("{file}", center = true);', "slc",
                                 MANY if self.kind == "png" else LAYER)
        return self.with_sets()

    def designed(self, text, ending, layer=LAYER):
        text = text.replace("{file}", "{tree}/" + self.path)
        layered = ("--layer", layer) if ending == "slc" else ()
        return [Run(("{designs}/design.scad", *layered), ending, text)]

    def with_sets(self):
        """Runs with this file as parameter sets."""
        design = self.path[:-len("json")] + "scad"
        own = () if design in self.users else ("width = 3; cube(width);",)
        word = "{designs}/design.scad" if own else "{tree}/" + design
        return [Run((word, "--layer", LAYER, "-p", "{tree}/" + self.path,
                     "-P", name), ending, *own)
                for name in self.sets or ["first"] for ending in ("slc", "ast")]


# What a design may name in `include`, `use`, `import` and `surface`.
NAMED = re.compile(rb'["<]([^"<>\n]+\.\w+)[">]')
IMPORT = 'import("{file}");'


def layers(path):
    return [Run(("{tree}/" + path, "--layer", LAYER), "slc")]


def texts(path):
    return [Run(("{tree}/" + path,), ending)
            for ending in ("csg", "echo", "ast")]


def collect():
    """All inputs, in the order of their paths, those made here first."""
    inputs = [Input(path, text.encode()) for path, text in MADE.items()]
    inputs += [Input(str(path.relative_to(DATA)), path.read_bytes())
               for folder in FOLDERS
               for path in sorted((DATA / folder).rglob("*"))
               if path.is_file() and path.suffix[1:].lower() in KINDS]
    users = {}
    for design in inputs:
        if design.kind == "scad":
            for name in set(NAMED.findall(design.data)):
                users.setdefault(Path(name.decode(errors="replace")).name,
                                 []).append(design.path)
    for one in inputs:
        one.users = [path for path in users.get(Path(one.path).name, [])
                     if path != one.path]
        if one.kind == "json":
            twin = one.path[:-len("json")] + "scad"
            one.users = [twin] if (DATA / twin).exists() else []
            one.sets = set_names(one.data)
    return inputs


def set_names(data):
    """The first names in a file of parameter sets."""
    names = re.findall(rb'"([^"]+)"\s*:\s*\{', data)
    return [name.decode(errors="replace") for name in names
            if name != b"parameterSets"][:3]


def copy_tree(folder):
    """A copy of the data, so that a damaged file is found where it belongs."""
    for name in FOLDERS:
        shutil.copytree(DATA / name, folder / name)
    for path, text in MADE.items():
        (folder / path).parent.mkdir(exist_ok=True)
        (folder / path).write_text(text)

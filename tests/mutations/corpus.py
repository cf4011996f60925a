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
    """All inputs, in the order of their paths."""
    inputs = [Input(str(path.relative_to(DATA)), path.read_bytes())
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

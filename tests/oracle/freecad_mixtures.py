#!/usr/bin/env python3
# Builds FreeCAD files of objects that stand for others, at random: links, parts
# of groups, arrays, mirrors, bodies and what they bind, groups of both kinds,
# some of all that hidden.
#
#   tests/oracle/freecad_mixtures.py FOLDER COUNT
#
# writes FOLDER/mixture_K.FCStd and FOLDER/mixtures.json: for each file the
# volume of what FreeCAD shows. Every object has a place of its own, so volumes
# add up. FreeCAD writes what its window shows to GuiDocument.xml; without a
# window that part of the file is written here, of the same visibilities.

import json
import os
import random
import sys
import zipfile

import freecad_sections  # noqa: F401: it finds FreeCAD

MODULES = "/usr/share/freecad/Mod"
for folder in (MODULES, "/usr/share/freecad/Ext", MODULES + "/Draft",
               "/usr/lib/python3/dist-packages"):
    sys.path.append(folder)

import FreeCAD  # noqa: E402
import Draft  # noqa: E402
import Part  # noqa: E402
import Sketcher  # noqa: E402, F401
from FreeCAD import Placement, Rotation, Vector  # noqa: E402

X, Y, Z = Vector(1, 0, 0), Vector(0, 1, 0), Vector(0, 0, 1)
STEP = 120  # from place to place [mm]


class Mixture:
    def __init__(self, seed, folder):
        self.random = random.Random(seed)
        self.folder = folder
        self.document = FreeCAD.newDocument(f"mixture_{seed}")
        self.places = 0
        self.parts = []  # that links, mirrors and arrays may take
        self.groups = []  # App::Part, with what they hold
        self.shown = []  # objects of the first level, for the volume

    # --- Pieces ---------------------------------------------------------------

    def place(self, at=None):
        self.places += 1
        turn = Rotation(Z, self.random.choice([0, 30, 90]))
        return Placement(at or Vector(STEP * self.places, 0, 0), turn)

    def hides(self, share=0.25):
        return self.random.random() < share

    def add(self, kind, at=None, **properties):
        thing = self.document.addObject(kind, kind.split("::")[1])
        for key, value in properties.items():
            setattr(thing, key, value)
        thing.Placement = self.place() if at is None else at
        return thing

    def primitive(self, at=None):
        size = self.random.randint(3, 9)
        kind = self.random.choice(["Box", "Cylinder", "Cone"])
        return {
            "Box": lambda: self.add("Part::Box", at, Length=size, Width=5,
                                    Height=7),
            "Cylinder": lambda: self.add("Part::Cylinder", at, Radius=size,
                                         Height=6),
            "Cone": lambda: self.add("Part::Cone", at, Radius1=size, Radius2=1,
                                     Height=8)}[kind]()

    def cut(self, at=None):
        origin = Placement()
        base = self.add("Part::Box", origin, Length=9, Width=8, Height=7)
        tool = self.add("Part::Cylinder", origin, Radius=3, Height=20)
        base.Visibility = tool.Visibility = False
        return self.add("Part::Cut", at, Base=base, Tool=tool)

    def rectangle(self, body, width, depth):
        sketch = body.newObject("Sketcher::SketchObject", "Sketch")
        corners = [Vector(0, 0, 0), Vector(width, 0, 0),
                   Vector(width, depth, 0), Vector(0, depth, 0)]
        for a, b in zip(corners, corners[1:] + corners[:1]):
            sketch.addGeometry(Part.LineSegment(a, b), False)
        sketch.Visibility = False
        return sketch

    def body(self, at=None):
        body = self.document.addObject("PartDesign::Body", "Body")
        body.Placement = self.place() if at is None else at
        pad = body.newObject("PartDesign::Pad", "Pad")
        pad.Profile = self.rectangle(body, 8, 6)
        pad.Length = 5
        pad.Visibility = False
        self.document.recompute()
        pocket = body.newObject("PartDesign::Pocket", "Pocket")
        pocket.Profile = self.rectangle(body, 3, 2)
        pocket.Length = 2
        pocket.Reversed = True
        self.document.recompute()
        return body

    def binder(self):
        bound = self.random.choice(self.parts)
        body = self.document.addObject("PartDesign::Body", "Body")
        binder = body.newObject("PartDesign::SubShapeBinder", "Binder")
        binder.Support = [(bound, "")]
        binder.Relative = False
        body.Placement = self.place()
        return body

    # --- What stands for others -----------------------------------------------

    def group(self):
        group = self.document.addObject("App::Part", "Group")
        group.Placement = self.place()
        held = [self.random.choice([self.primitive, self.cut])(
            Placement(Vector(25 * i, 0, 0), Rotation()))
            for i in range(self.random.randint(1, 3))]
        for thing in held:
            group.addObject(thing)
            thing.Visibility = not self.hides()
        self.groups.append((group, held))
        return group

    def plain_group(self):
        group = self.document.addObject("App::DocumentObjectGroup", "Plain")
        for _ in range(self.random.randint(1, 3)):
            thing = self.primitive()
            group.addObject(thing)
            thing.Visibility = not self.hides()
        return group

    def link(self):
        link = self.document.addObject("App::Link", "Link")
        link.setLink(self.random.choice(self.parts))
        self.set_link(link)
        return link

    def set_link(self, link):
        # With the target's own place in it: far off, where nothing else is.
        if self.hides(0.3):
            link.LinkTransform = True
            link.Placement = self.place(Vector(0, STEP * (self.places + 9), 0))
        else:
            link.Placement = self.place()
            if self.hides(0.3):
                link.Scale = self.random.choice([0.5, 2])

    def link_to_member(self):
        if not self.groups:
            return self.link()
        group, held = self.random.choice(self.groups)
        link = self.document.addObject("App::Link", "Link")
        link.setLink(group, self.random.choice(held).Name + ".")
        link.Placement = self.place()
        return link

    def link_to_file(self):
        name = f"other_{self.document.Name}_{self.places}"
        other = FreeCAD.newDocument(name)
        solid = other.addObject("Part::Box", "Solid")
        solid.Placement = Placement(Vector(3, 2, 1), Rotation(X, 90))
        other.recompute()
        other.saveAs(os.path.join(self.folder, name + ".FCStd"))
        FreeCAD.setActiveDocument(self.document.Name)
        # Links need a name for the file that they stand in.
        self.document.saveAs(self.path())
        link = self.document.addObject("App::Link", "Link")
        link.setLink(solid)
        link.Placement = self.place()
        return link

    def link_array(self):
        array = self.document.addObject("App::Link", "LinkArray")
        array.setLink(self.random.choice(self.parts))
        array.Placement = self.place()
        array.ShowElement = self.hides(0.5)
        count = self.random.randint(2, 4)
        array.ElementCount = count
        places = [Placement(Vector(0, 0, 40 * i), Rotation(Z, 20 * i))
                  for i in range(count)]
        if array.ShowElement:
            for element, place in zip(array.ElementList, places):
                element.Placement = place
        else:
            array.PlacementList = places
        if self.hides(0.5):
            array.setElementVisible("1", False)
        return array

    def draft_array(self):
        base = self.primitive()
        count = self.random.randint(2, 4)
        is_link = self.hides(0.5)
        if self.hides(0.5):
            array = Draft.make_ortho_array(
                base, v_x=Vector(0, 0, 30), v_y=Vector(0, 40, 0), n_x=count,
                n_y=2, n_z=1, use_link=is_link)
        else:
            center = base.Placement.Base + Vector(0, 50, 0)
            array = Draft.make_polar_array(base, count, 360, center,
                                           use_link=is_link)
        base.Visibility = False
        return array

    def path_array(self):
        base = self.primitive(Placement())
        base.Visibility = False
        begin = self.place().Base
        wire = Draft.make_wire([begin, begin + Vector(0, 0, 90)])
        return Draft.make_path_array(base, wire, count=3, align=False,
                                     use_link=self.hides(0.5))

    def mirror(self):
        source = self.random.choice([self.primitive, self.cut])()
        mirror = self.document.addObject("Part::Mirroring", "Mirror")
        mirror.Source = source
        mirror.Normal = X
        mirror.Base = Vector(-STEP * self.places, 0, 0)
        source.Visibility = not self.hides(0.5)
        self.shown.append(source)
        return mirror

    def body_on_base(self):
        base = self.random.choice([self.primitive, self.cut])()
        base.Visibility = not self.hides(0.5)
        self.shown.append(base)
        body = self.document.addObject("PartDesign::Body", "Body")
        body.BaseFeature = base
        body.Placement = self.place()
        return body

    # --- Files ----------------------------------------------------------------

    def path(self):
        return os.path.join(self.folder, self.document.Name + ".FCStd")

    def build(self):
        for make in (self.primitive, self.cut, self.body):
            thing = make()
            self.parts.append(thing)
            self.shown.append(thing)
        kinds = [self.group, self.plain_group, self.link, self.link_to_member,
                 self.link_to_file, self.link_array, self.draft_array,
                 self.path_array, self.mirror, self.binder, self.body_on_base]
        for make in self.random.choices(kinds, k=self.random.randint(3, 7)):
            thing = make()
            self.document.recompute()
            self.shown.append(thing)
            # A link to a link that keeps its target's place would lie where
            # another thing may.
            keeps_place = getattr(thing, "LinkTransform", False)
            if (make in (self.group, self.link, self.draft_array) and
                    not keeps_place):
                self.parts.append(thing)
        for thing in self.shown:
            if self.hides():
                thing.Visibility = False
        self.document.recompute()
        broken = [o.Name for o in self.document.Objects
                  if "Invalid" in o.State or "Error" in o.State]
        if broken:
            raise RuntimeError(f"{self.path()}: FreeCAD makes nothing of {broken}")

    def write(self):
        self.document.saveAs(self.path())
        views = "".join(
            f'<ViewProvider name="{o.Name}"><Properties>'
            '<Property name="Visibility" type="App::PropertyBool">'
            f'<Bool value="{"true" if o.Visibility else "false"}"/>'
            "</Property></Properties></ViewProvider>"
            for o in self.document.Objects)
        with zipfile.ZipFile(self.path(), "a") as archive:
            archive.writestr("GuiDocument.xml",
                             "<?xml version='1.0' encoding='utf-8'?><Document>"
                             f"<ViewProviderData>{views}</ViewProviderData>"
                             "</Document>")
        return sum(shown_volume(o) for o in self.shown)


def shown_volume(thing):
    """Of what FreeCAD shows of the object."""
    if thing.isDerivedFrom("App::DocumentObjectGroup"):
        return sum(shown_volume(o) for o in thing.Group)
    if not thing.Visibility:
        return 0
    shape = Part.getShape(thing)
    if thing.isDerivedFrom("PartDesign::Body") and not thing.Tip:
        shape = Part.getShape(thing.Group[0])
    return sum(solid.Volume for solid in shape.Solids)


def main():
    folder = sys.argv[1]
    os.makedirs(folder, exist_ok=True)
    volumes = {}
    for seed in range(int(sys.argv[2])):
        mixture = Mixture(seed, folder)
        mixture.build()
        volumes[mixture.document.Name] = mixture.write()
        for name in list(FreeCAD.listDocuments()):
            FreeCAD.closeDocument(name)
    with open(os.path.join(folder, "mixtures.json"), "w") as file:
        json.dump(volumes, file)


if __name__ == "__main__":
    main()

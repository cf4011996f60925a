# Five Part designs, exported as .csg by FreeCAD's OpenSCAD workbench.
#
#   freecadcmd bench/freecad_designs.py      into the folder $LAMINA_FREECAD_OUT
#
# Beside each NAME.csg stands NAME.txt: FreeCAD's volume [mm³] and surface
# [mm²]. FreeCAD 0.20 writes the radii of spheres, tori and prisms with their
# unit, which no reader of .csg takes, and forgets the placement of a Boolean,
# so none of these is used here; it centres an extruded plane, so the hole goes
# far through it.

import os
import sys

import FreeCAD
from FreeCAD import Placement, Rotation, Vector

sys.path.append(os.path.join(FreeCAD.getHomePath(), "Mod", "OpenSCAD"))
import exportCSG  # noqa: E402

OUT = os.environ["LAMINA_FREECAD_OUT"]
X, Y, Z = Vector(1, 0, 0), Vector(0, 1, 0), Vector(0, 0, 1)


class Design:
    def __init__(self, name):
        self.name = name
        self.document = FreeCAD.newDocument(name)

    def add(self, kind, at=(0, 0, 0), turn=(Z, 0), **properties):
        part = self.document.addObject("Part::" + kind, kind)
        for key, value in properties.items():
            setattr(part, key, value)
        if at != (0, 0, 0) or turn[1] != 0:
            part.Placement = Placement(Vector(*at), Rotation(*turn))
        return part

    def boolean(self, kind, base, tool):
        return self.add(kind, Base=base, Tool=tool)

    def export(self, part):
        self.document.recompute()
        path = os.path.join(OUT, self.name)
        exportCSG.export([part], path + ".csg")
        with open(path + ".txt", "w") as file:
            file.write(f"{part.Shape.Volume} {part.Shape.Area}\n")


def cut():
    d = Design("cut")
    block = d.add("Box", Length=10, Width=8, Height=6)
    drill = d.add("Cylinder", at=(5, 4, -2), turn=(X, 20), Radius=3, Height=20)
    d.export(d.boolean("Cut", block, drill))


def fuse():
    d = Design("fuse")
    stem = d.add("Cylinder", Radius=5, Height=4)
    horn = d.add("Cone", at=(1, 0, 2), turn=(Y, 35), Radius1=4, Radius2=1,
                 Height=9)
    d.export(d.boolean("Fuse", stem, horn))


def common():
    d = Design("common")
    cone = d.add("Cone", Radius1=7, Radius2=2, Height=8)
    bar = d.add("Cylinder", at=(-9, 0, 3), turn=(Y, 80), Radius=3, Height=20)
    d.export(d.boolean("Common", cone, bar))


def placements():
    d = Design("placements")
    parts = [d.add("Box", at=(4 * i, i, 0.5 * i), turn=(Vector(1, 1, i), 15 * i),
                   Length=6, Width=3, Height=5) for i in range(5)]
    bars = d.add("MultiFuse", Shapes=parts)
    pins = d.add("MultiFuse", Shapes=[
        d.add("Cylinder", at=(3 + 4 * i, 2, -9), Radius=0.8, Height=30)
        for i in range(4)])
    d.export(d.boolean("Cut", bars, pins))


def extrusion():
    d = Design("extrusion")
    plate = d.add("Extrusion", Base=d.add("Plane", Length=12, Width=7),
                  Dir=Vector(0, 0, 4), Solid=True)
    hole = d.add("Cylinder", at=(6, 3.5, -5), Radius=2.5,
                 Height=12)
    d.export(d.boolean("Cut", plate, hole))


for make in (cut, fuse, common, placements, extrusion):
    make()

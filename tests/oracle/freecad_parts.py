#!/usr/bin/env python3
# Builds parts with FreeCAD, of all kinds of surfaces, and writes each as STEP,
# IGES and BREP, beside its sections (freecad_sections.py).
#
#   tests/oracle/freecad_parts.py FOLDER
#
# writes FOLDER/NAME.step, .iges, .brep, .brp (binary) and .json. Some names have
# no file but that of STEP: what the format alone can say.

import json
import math
import os
import sys

import freecad_sections
import FreeCAD
import Part
from FreeCAD import Matrix, Placement, Rotation, Vector

LAYERS = 9

X, Y, Z = Vector(1, 0, 0), Vector(0, 1, 0), Vector(0, 0, 1)
LEAN = Placement(Vector(3, -2, 1), Rotation(Vector(1, 2, 3), 37))

PARTS = {}


def part(build):
    PARTS[build.__name__] = build
    return build


def placed(shape, placement):
    shape = shape.copy()
    shape.Placement = placement
    return shape


@part
def cylinder():
    return Part.makeCylinder(5, 12)


@part
def leaning_cylinder():
    return placed(Part.makeCylinder(4, 15), LEAN)


@part
def cone():
    return Part.makeCone(6, 1.5, 9)


@part
def whole_cone():
    return placed(Part.makeCone(5, 0, 11), LEAN)


@part
def ball():
    return Part.makeSphere(6, Vector(1, 2, 3))


@part
def ring():
    return Part.makeTorus(8, 2.2)


@part
def leaning_ring():
    return placed(Part.makeTorus(8, 1.3), LEAN)


@part
def ellipsoid():
    matrix = Matrix()
    matrix.scale(Vector(1, 0.6, 1.7))
    return Part.makeSphere(4).transformGeometry(matrix)


@part
def filleted_block():
    box = Part.makeBox(12, 9, 7)
    return box.makeFillet(1.5, box.Edges)


@part
def chamfered_block():
    box = placed(Part.makeBox(12, 9, 7), LEAN)
    return box.makeChamfer(1.2, box.Edges[:6])


@part
def drilled_block():
    block = Part.makeBox(20, 14, 8)
    block = block.cut(Part.makeCylinder(3, 20, Vector(6, 7, -2)))
    block = block.cut(Part.makeCylinder(2.5, 30, Vector(-5, 7, 4), X))
    return block.cut(Part.makeCone(1, 4, 10, Vector(15, 7, -1)))


@part
def hollow_ball():
    return Part.makeSphere(7).cut(Part.makeSphere(5, Vector(0.7, 0.4, 0.3)))


@part
def loft():
    square = Part.makePolygon(
        [Vector(*p) for p in
         [(-5, -5, 0), (5, -5, 0), (5, 5, 0), (-5, 5, 0), (-5, -5, 0)]])
    turned = placed(Part.makePolygon(
        [Vector(*p) for p in
         [(-2, -4, 0), (3, -3, 0), (4, 2, 0), (-3, 4, 0), (-2, -4, 0)]]),
        Placement(Vector(1, 1, 10), Rotation(Z, 20)))
    return Part.makeLoft([square, turned], True)


@part
def smooth_loft():
    def circle(r, x, z):
        return Part.Wire(Part.makeCircle(r, Vector(x, 0, z)))

    return Part.makeLoft(
        [circle(4, 0, 0), circle(6, 2, 4), circle(2, -1, 9), circle(3, 0, 12)],
        True)


@part
def vase():
    curve = Part.BSplineCurve()
    curve.interpolate([Vector(4, 0, 0), Vector(7, 0, 5), Vector(2, 0, 11),
                       Vector(3.5, 0, 15)])
    wire = Part.Wire([
        Part.makeLine(Vector(0, 0, 0), Vector(4, 0, 0)), curve.toShape(),
        Part.makeLine(Vector(3.5, 0, 15), Vector(0, 0, 15)),
        Part.makeLine(Vector(0, 0, 15), Vector(0, 0, 0))])
    return Part.Face(wire).revolve(Vector(0, 0, 0), Z, 360)


@part
def part_of_a_turn():
    face = Part.Face(Part.Wire(Part.makeCircle(2, Vector(9, 0, 0), Y)))
    return placed(face.revolve(Vector(0, 0, 0), Z, 250), LEAN)


@part
def pipe():
    spine = Part.BSplineCurve()
    spine.interpolate([Vector(0, 0, 0), Vector(3, 4, 6), Vector(-2, 6, 12),
                       Vector(0, 0, 18)])
    wire = Part.Wire(spine.toShape())
    profile = Part.Wire(Part.makeCircle(1.5, Vector(0, 0, 0),
                                        spine.tangent(0)[0]))
    return wire.makePipeShell([profile], True, True)


@part
def spline_plate():
    surface = Part.BSplineSurface()
    surface.interpolate([
        [Vector(4 * i, 4 * j, 6 + 1.5 * math.sin(1.3 * i) * math.cos(1.1 * j))
         for j in range(5)] for i in range(5)])
    top = surface.toShape()
    block = top.extrude(Vector(0, 0, -9))
    return block.common(Part.makeBox(12, 12, 30, Vector(2, 2, 0.5)))


@part
def shelled_block():
    block = Part.makeBox(16, 12, 10)
    block = block.makeFillet(2, [e for e in block.Edges
                                 if abs(e.tangentAt(0).z) > 0.9])
    top = max(block.Faces, key=lambda face: face.CenterOfMass.z)
    return block.makeThickness([top], -1.2, 1e-3)


@part
def mirrored_wedge():
    wedge = Part.makeWedge(0, 0, 0, 2, 2, 10, 8, 12, 7, 9)
    wedge = wedge.cut(Part.makeCylinder(1.5, 20, Vector(4, -4, 5), Y))
    return placed(wedge, LEAN).mirror(Vector(1, 1, 1), Vector(1, 2, 0.5))


@part
def crossed_pipes():
    a = Part.makeCylinder(3, 20, Vector(-10, 0, 0), X)
    b = Part.makeCylinder(3, 20, Vector(0, -10, 0), Y)
    c = Part.makeCylinder(2, 16, Vector(0, 0, -8), Vector(0.2, 0.1, 1))
    return placed(a.fuse(b).cut(c).removeSplitter(), LEAN)


@part
def tiny_gem():
    gem = Part.makeCone(0.4, 0.02, 0.5).fuse(
        Part.makeCone(0.4, 0.25, 0.2, Vector(0, 0, 0), -Z))
    return gem.removeSplitter()


@part
def knob():
    box = Part.makeBox(8, 8, 9, Vector(-4, -4, -4.5))
    return box.makeFillet(0.6, box.Edges).common(Part.makeSphere(5.2))


@part
def assembly():
    pin = Part.makeCylinder(1, 6).fuse(Part.makeSphere(1.6, Vector(0, 0, 6)))
    places = [
        Placement(Vector(10 * i, 7 * j, 2 * i), Rotation(Vector(1, j, i), 25 * i))
        for i in range(3) for j in range(2)]
    return Part.makeCompound([placed(pin, place) for place in places])


# --- What only STEP says ------------------------------------------------------

UNITS = {
    "metre": "( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT($,.METRE.) )",
    "inch": "( CONVERSION_BASED_UNIT('INCH',#99001) LENGTH_UNIT() "
            "NAMED_UNIT(#99002) )",
}
INCH = """#99001=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#99003);
#99002=DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);
#99003=( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.) );
"""


def with_unit(step, unit):
    """The same numbers in another unit of length."""
    at = step.index("SI_UNIT(.MILLI.,.METRE.)")
    begin = step.rindex("=", 0, at)
    end = step.index(";", at)
    tail = step[end:].replace("ENDSEC;\nEND-ISO", INCH + "ENDSEC;\nEND-ISO")
    return step[:begin] + "=" + UNITS[unit] + tail


def write_in_units(folder):
    with open(os.path.join(folder, "drilled_block.step")) as file:
        step = file.read()
    for unit, size in (("inch", 25.4), ("metre", 1000)):
        name = "drilled_block_in_" + unit
        with open(os.path.join(folder, name + ".step"), "w") as file:
            file.write(with_unit(step, unit))
        write_sections(folder, name, drilled_block().scaled(size))


# --- Files --------------------------------------------------------------------

def write_sections(folder, name, shape):
    heights = freecad_sections.heights_of(shape, LAYERS)
    with open(os.path.join(folder, name + ".json"), "w") as file:
        json.dump({"volume": shape.Volume,
                   "layers": freecad_sections.sections(shape, heights)}, file)


def main():
    folder = sys.argv[1]
    os.makedirs(folder, exist_ok=True)
    for name, build in PARTS.items():
        shape = build()
        if not shape.isValid():
            raise SystemExit(f"{name} is no valid shape")
        path = os.path.join(folder, name)
        shape.exportStep(path + ".step")
        shape.exportIges(path + ".iges")
        shape.exportBrep(path + ".brep")
        shape.exportBinary(path + ".brp")
        write_sections(folder, name, shape)
    write_in_units(folder)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# Builds FreeCAD files, one for each feature that lamina reads, and sections of
# what FreeCAD makes of them.
#
#   tests/oracle/freecad_models.py FOLDER [NAME…]
#
# writes FOLDER/NAME.FCStd and FOLDER/NAME.json: the feature's name as the table
# shows it, whether lamina reads it by parameter or by its boundary, and sections
# (freecad_sections.py) whose outer loops run counter-clockwise, holes clockwise.

import json
import math
import os
import shutil
import sys

import freecad_sections

MODULES = "/usr/share/freecad/Mod"
for folder in (MODULES, "/usr/share/freecad/Ext", MODULES + "/Draft"):
    sys.path.append(folder)

import FreeCAD  # noqa: E402
import Part  # noqa: E402
import Sketcher  # noqa: E402, F401
from FreeCAD import Matrix, Placement, Rotation, Vector  # noqa: E402

LAYERS = 5

# A hundredth of the chordal error that is judged, for parts of 30 mm.
freecad_sections.DEFLECTION = 3e-6

X, Y, Z = Vector(1, 0, 0), Vector(0, 1, 0), Vector(0, 0, 1)
LEAN = Placement(Vector(3, -2, 1), Rotation(Vector(1, 2, 3), 37))
TILT = Placement(Vector(-4, 6, 2), Rotation(Vector(0, 1, 0.3), -48))
FLIP = Placement(Vector(1, 2, 3), Rotation(Vector(1, 0, 0), 180))

MODELS = {}


class Model:
    """A document, and what its layers are judged against."""

    def __init__(self, name):
        self.document = FreeCAD.newDocument(name)
        self.result = None

    def add(self, kind, name=None, at=None, **properties):
        part = self.document.addObject(kind, name or kind.split("::")[1])
        for key, value in properties.items():
            setattr(part, key, value)
        if at is not None:
            part.Placement = at
        return part

    def part(self, kind, at=None, **properties):
        return self.add("Part::" + kind, at=at, **properties)

    def sketch(self, curves, at=None, holder=None):
        if holder is None:
            sketch = self.document.addObject("Sketcher::SketchObject", "Sketch")
        else:
            sketch = holder.newObject("Sketcher::SketchObject", "Sketch")
        for curve in curves:
            sketch.addGeometry(curve, False)
        if at is not None:
            sketch.Placement = at
        return sketch

    def body(self, at=None):
        body = self.document.addObject("PartDesign::Body", "Body")
        if at is not None:
            body.Placement = at
        return body

    def feature(self, body, kind, curves=None, at=None, **properties):
        sketch = self.sketch(curves, at, body) if curves is not None else None
        feature = body.newObject("PartDesign::" + kind, kind)
        if sketch is not None:
            feature.Profile = sketch
            sketch.recompute()
        for key, value in properties.items():
            setattr(feature, key, value)
        self.document.recompute()
        return feature

    def axis(self, body, role):
        return next(o for o in body.Origin.OriginFeatures if o.Role == role)


def model(feature, by="parameter"):
    def add(build):
        MODELS[build.__name__] = (build, feature, by)
        return build
    return add


# --- Curves -------------------------------------------------------------------


def line(ax, ay, bx, by):
    return Part.LineSegment(Vector(ax, ay, 0), Vector(bx, by, 0))


def path(*points):
    return [line(*a, *b) for a, b in zip(points, points[1:] + points[:1])]


def box(x0, y0, x1, y1):
    return path((x0, y0), (x1, y0), (x1, y1), (x0, y1))


def circle(x, y, r):
    return Part.Circle(Vector(x, y, 0), Z, r)


def arc(x, y, r, begin, end, normal=Z):
    return Part.ArcOfCircle(Part.Circle(Vector(x, y, 0), normal, r),
                            math.radians(begin), math.radians(end))


def slot(x0, x1, y, r):
    return [line(x0, y - r, x1, y - r), arc(x1, y, r, -90, 90),
            line(x1, y + r, x0, y + r), arc(x0, y, r, 90, 270)]


def ellipse(x, y, a, b, angle=0):
    e = Part.Ellipse(Vector(x, y, 0), a, b)
    e.AngleXU = math.radians(angle)
    return e


# --- Primitives of Part -------------------------------------------------------


@model("Part::Box")
def part_box(m):
    return m.part("Box", LEAN, Length=7, Width=5, Height=9)


@model("Part::Cylinder")
def part_cylinder(m):
    return m.part("Cylinder", LEAN, Radius=4, Height=11)


@model("Part::Cylinder, Angle", "boundary")
def part_cylinder_sector(m):
    return m.part("Cylinder", TILT, Radius=5, Height=8, Angle=130)


@model("Part::Cylinder, FirstAngle", "boundary")
def part_cylinder_leaning(m):
    return m.part("Cylinder", Radius=4, Height=9, FirstAngle=20, SecondAngle=-15)


@model("Part::Sphere")
def part_sphere(m):
    return m.part("Sphere", LEAN, Radius=6)


@model("Part::Sphere, Angle1 to Angle3", "boundary")
def part_sphere_part(m):
    return m.part("Sphere", TILT, Radius=6, Angle1=-30, Angle2=50, Angle3=200)


@model("Part::Cone")
def part_cone(m):
    return m.part("Cone", LEAN, Radius1=6, Radius2=1.5, Height=9)


@model("Part::Cone, Radius2 = 0, Angle", "boundary")
def part_cone_sector(m):
    return m.part("Cone", Radius1=5, Radius2=0, Height=8, Angle=250)


@model("Part::Torus")
def part_torus(m):
    return m.part("Torus", LEAN, Radius1=8, Radius2=2.5)


@model("Part::Torus, Angle3", "boundary")
def part_torus_sector(m):
    return m.part("Torus", TILT, Radius1=8, Radius2=2.5, Angle3=220)


@model("Part::Torus, Angle1 to Angle3", "boundary")
def part_torus_part(m):
    return m.part("Torus", LEAN, Radius1=8, Radius2=2.5, Angle1=-40, Angle2=110,
                  Angle3=300)


@model("Part::Prism", "boundary")
def part_prism(m):
    return m.part("Prism", LEAN, Polygon=5, Circumradius=4, Height=9)


@model("Part::Prism, FirstAngle", "boundary")
def part_prism_leaning(m):
    return m.part("Prism", Polygon=7, Circumradius=4, Height=9, FirstAngle=12,
                  SecondAngle=7)


@model("Part::Wedge", "boundary")
def part_wedge(m):
    return m.part("Wedge", LEAN, Xmin=0, Ymin=0, Zmin=0, X2min=2, Z2min=1,
                  Xmax=10, Ymax=8, Zmax=9, X2max=7, Z2max=5)


@model("Part::Wedge to an edge", "boundary")
def part_wedge_edge(m):
    return m.part("Wedge", TILT, Xmin=0, Ymin=0, Zmin=0, X2min=2, Z2min=4,
                  Xmax=10, Ymax=8, Zmax=9, X2max=7, Z2max=4)


@model("Part::Ellipsoid", "boundary")
def part_ellipsoid(m):
    return m.part("Ellipsoid", LEAN, Radius1=3, Radius2=7, Radius3=5)


@model("Part::Ellipsoid, Angle1 to Angle3", "boundary")
def part_ellipsoid_part(m):
    return m.part("Ellipsoid", Radius1=6, Radius2=4, Angle1=-60, Angle2=40,
                  Angle3=190)


# --- Booleans of Part ---------------------------------------------------------


@model("Part::Cut")
def part_cut(m):
    block = m.part("Box", Length=10, Width=8, Height=6)
    drill = m.part("Cylinder", Placement(Vector(5, 4, -2), Rotation(X, 20)),
                   Radius=2.5, Height=20)
    return m.part("Cut", LEAN, Base=block, Tool=drill)


@model("Part::Box, seen by a drawing and a hidden Part::Cut")
def part_box_seen(m):
    block = m.part("Box", LEAN, Length=7, Width=5, Height=9)
    m.add("TechDraw::DrawViewPart", "View", Source=[block])
    m.part("Cut", Base=block, Tool=m.part("Sphere", Radius=3, Visibility=False),
           Visibility=False)
    return block


@model("Part::Fuse")
def part_fuse(m):
    stem = m.part("Cylinder", Radius=5, Height=4)
    horn = m.part("Cone", Placement(Vector(1, 0, 2), Rotation(Y, 35)),
                  Radius1=4, Radius2=1, Height=9)
    return m.part("Fuse", TILT, Base=stem, Tool=horn)


@model("Part::Common")
def part_common(m):
    cone = m.part("Cone", Radius1=7, Radius2=2, Height=8)
    bar = m.part("Cylinder", Placement(Vector(-9, 0, 3), Rotation(Y, 80)),
                 Radius=3, Height=20)
    return m.part("Common", TILT, Base=cone, Tool=bar)


@model("Part::MultiFuse, Part::Cut nested")
def part_multi_fuse(m):
    bars = m.part("MultiFuse", Shapes=[
        m.part("Box", Placement(Vector(4 * i, i, i / 2),
                                Rotation(Vector(1, 1, i), 15 * i)),
               Length=6, Width=3, Height=5) for i in range(5)])
    pins = m.part("MultiFuse", TILT, Shapes=[
        m.part("Cylinder", Placement(Vector(3 + 4 * i, -2, -19), Rotation()),
               Radius=0.8, Height=50) for i in range(4)])
    return m.part("Cut", LEAN, Base=bars, Tool=pins)


@model("Part::MultiCommon")
def part_multi_common(m):
    return m.part("MultiCommon", Shapes=[
        m.part("Sphere", Radius=6),
        m.part("Box", Placement(Vector(-4, -4, -5), Rotation()), Length=8,
               Width=9, Height=10),
        m.part("Cylinder", Placement(Vector(0, 0, -8), Rotation(X, 10)),
               Radius=4.5, Height=20)])


@model("Part::Compound")
def part_compound(m):
    return m.part("Compound", LEAN, Links=[
        m.part("Box", Length=3, Width=4, Height=8),
        m.part("Cylinder", Placement(Vector(9, 0, 1), Rotation()), Radius=2,
               Height=6)])


@model("Part::Mirroring")
def part_mirroring(m):
    base = m.part("Cut", TILT, Base=m.part("Box", Length=9, Width=6, Height=4),
                  Tool=m.part("Cylinder", Placement(Vector(2, 2, -1), Rotation()),
                              Radius=1.5, Height=9), Visibility=False)
    return m.part("Mirroring", LEAN, Source=base, Base=Vector(2, 1, 0),
                  Normal=Vector(1, 1, 0.5))


# --- Extrusions and revolutions of Part ---------------------------------------


@model("Part::Extrusion: lines, arcs, holes")
def part_extrusion(m):
    sketch = m.sketch(box(-10, -6, 10, 6) + slot(-5, 5, 0, 3) +
                      [circle(0, 0, 1.5)], LEAN)
    return m.part("Extrusion", Base=sketch, Dir=Vector(0, 0, 1), DirMode=2,
                  LengthFwd=5, LengthRev=2, Solid=True,
                  FaceMakerClass="Part::FaceMakerBullseye")


@model("Part::Extrusion, oblique, placed", "boundary")
def part_extrusion_oblique(m):
    sketch = m.sketch(slot(-5, 5, 0, 3) + [ellipse(1, 0, 2, 1, 30)])
    return m.part("Extrusion", TILT, Base=sketch, Dir=Vector(1, 0.5, 2),
                  DirMode=0, LengthFwd=9, Solid=True, Symmetric=True,
                  FaceMakerClass="Part::FaceMakerCheese")


@model("Part::Extrusion, length of Dir, reversed")
def part_extrusion_dir(m):
    sketch = m.sketch(box(0, 0, 4, 5), TILT)
    return m.part("Extrusion", Base=sketch, Dir=Vector(0, 1, 6), DirMode=0,
                  LengthFwd=0, LengthRev=0, Reversed=True, Solid=True,
                  FaceMakerClass="Part::FaceMakerBullseye")


@model("Part::Extrusion: ellipses, arcs of ellipses", "boundary")
def part_extrusion_ellipse(m):
    half = Part.ArcOfEllipse(Part.Ellipse(Vector(0, 0, 0), 8, 5), 0, math.pi)
    sketch = m.sketch([half, line(-8, 0, 8, 0), ellipse(0, 2, 3, 1, 10)], LEAN)
    return m.part("Extrusion", Base=sketch, DirMode=2, LengthFwd=6, Solid=True,
                  FaceMakerClass="Part::FaceMakerBullseye")


@model("Part::Extrusion: B-splines", "boundary")
def part_extrusion_spline(m):
    closed = Part.BSplineCurve()
    closed.interpolate([Vector(*p, 0) for p in
                        ((-9, 0), (-3, -6), (5, -5), (9, 1), (2, 7), (-5, 5))],
                       PeriodicFlag=True)
    poles = [Vector(*p, 0) for p in ((-2, 0), (-1, 3), (1, 3), (2, 0))]
    weighted = Part.BSplineCurve()
    weighted.buildFromPolesMultsKnots(poles, [4, 4], [0, 1], False, 3,
                                      [1, 2, 0.5, 1])
    sketch = m.sketch([closed, weighted, line(-2, 0, 2, 0)], LEAN)
    return m.part("Extrusion", Base=sketch, DirMode=2, LengthFwd=6, Solid=True,
                  FaceMakerClass="Part::FaceMakerBullseye")


@model("Part::Extrusion: periodic B-spline by poles", "boundary")
def part_extrusion_periodic(m):
    poles = [Vector(*p, 0) for p in ((8, 0), (5, 6), (-4, 7), (-8, 0), (-3, -5),
                                     (4, -7))]
    closed = Part.BSplineCurve()
    closed.buildFromPolesMultsKnots(poles, [1] * 7, list(range(7)), True, 3)
    sketch = m.sketch([closed], TILT)
    return m.part("Extrusion", Base=sketch, DirMode=2, LengthFwd=6, Solid=True,
                  FaceMakerClass="Part::FaceMakerBullseye")


@model("Part::Extrusion: parabola, hyperbola", "boundary")
def part_extrusion_conics(m):
    parabola = Part.ArcOfParabola(
        Part.Parabola(Vector(1, 0, 0), Vector(0, 0, 0), Z), -5, 5)
    ends = parabola.StartPoint, parabola.EndPoint
    hyperbola = Part.ArcOfHyperbola(
        Part.Hyperbola(Vector(12, 0, 0), 2, 1), -1.2, 1.2)
    tips = hyperbola.StartPoint, hyperbola.EndPoint
    sketch = m.sketch([parabola, Part.LineSegment(ends[1], ends[0]),
                       hyperbola, Part.LineSegment(tips[1], tips[0])])
    return m.part("Extrusion", LEAN, Base=sketch, DirMode=2, LengthFwd=6,
                  Solid=True, FaceMakerClass="Part::FaceMakerBullseye")


@model("Part::Extrusion of RegularPolygon, Plane, Circle, Ellipse", "boundary")
def part_extrusion_plain(m):
    bases = [m.part("RegularPolygon", LEAN, Polygon=6, Circumradius=3),
             m.part("Plane", Placement(Vector(10, 0, 0), Rotation(X, 30)),
                    Length=5, Width=4),
             m.part("Circle", Placement(Vector(0, 12, 0), Rotation()), Radius=2),
             m.part("Ellipse", Placement(Vector(12, 12, 0), Rotation(Y, 10)),
                    MajorRadius=4, MinorRadius=2)]
    return m.part("Compound", Links=[
        m.part("Extrusion", Base=base, DirMode=0, Dir=Vector(0, 0, 1),
               LengthFwd=5, Solid=True,
               FaceMakerClass="Part::FaceMakerBullseye") for base in bases])


@model("Part::Revolution")
def part_revolution(m):
    sketch = m.sketch([line(3, -4, 7, -4), arc(7, 0, 4, -90, 90),
                       line(7, 4, 3, 4), line(3, 4, 3, -4),
                       *path((6, -1), (8, 0), (6, 1))],
                      Placement(Vector(0, 0, 0), Rotation(X, 90)))
    return m.part("Revolution", TILT, Source=sketch, Axis=Z,
                  Base=Vector(0, 0, 0), Angle=360, Solid=True)


@model("Part::Extrusion and Part::Revolution of a face, not Solid", "boundary")
def part_extrusion_face(m):
    plane = m.part("Plane", LEAN, Length=5, Width=4)
    other = m.part("Plane", Length=5, Width=4)
    return m.part("Compound", Links=[
        m.part("Extrusion", Base=plane, DirMode="Normal", LengthFwd=6,
               Solid=False),
        m.part("Revolution", TILT, Source=other, Axis=Y, Base=Vector(0, 0, 0),
               Angle=90, Solid=False)])


@model("Part::Extrusion of a face of no known outline, not Solid", "boundary")
def part_extrusion_drawn_face(m):
    face = m.part("Feature", Shape=Part.Face(Part.Wire(Part.makeCircle(5))))
    return m.part("Extrusion", LEAN, Base=face, DirMode="Normal", LengthFwd=6,
                  Solid=False)


@model("Part::Revolution, Angle, Symmetric")
def part_revolution_sector(m):
    sketch = m.sketch(box(2, -3, 6, 4), TILT)
    axis = TILT.Rotation.multVec(Y)
    return m.part("Revolution", Source=sketch, Axis=axis, Base=TILT.Base,
                  Angle=110, Symmetric=True, Solid=True)


@model("Part::Revolution, left of its axis")
def part_revolution_left(m):
    sketch = m.sketch(path((-6, -3), (-1, 0), (-5, 4)))
    return m.part("Revolution", LEAN, Source=sketch, Axis=Y, Base=Vector(0, 0, 0),
                  Angle=75, Solid=True)


# --- Bodies of PartDesign -----------------------------------------------------


@model("PartDesign::Pad")
def design_pad(m):
    body = m.body(LEAN)
    m.feature(body, "Pad", box(-8, -5, 8, 5) + [circle(3, 0, 2)], TILT, Length=4)
    return body


@model("PartDesign::Pad, Midplane")
def design_pad_midplane(m):
    body = m.body()
    m.feature(body, "Pad", slot(-4, 4, 0, 3), LEAN, Length=7, Midplane=True)
    return body


@model("PartDesign::Pad, Reversed, TwoLengths")
def design_pad_two_lengths(m):
    body = m.body(TILT)
    m.feature(body, "Pad", slot(-4, 4, 0, 3), LEAN, Type="TwoLengths", Length=7,
              Length2=2, Reversed=True)
    return body


@model("PartDesign::Pad, custom direction")
def design_pad_direction(m):
    body = m.body()
    m.feature(body, "Pad", slot(-4, 4, 0, 3), LEAN, Length=6,
              UseCustomVector=True, Direction=Vector(1, 0.5, 2),
              AlongSketchNormal=True)
    m.feature(body, "Pad", [circle(-4, 0, 2)], LEAN, Length=9,
              UseCustomVector=True, Direction=Vector(-0.5, 0.2, 1),
              AlongSketchNormal=False)
    return body


@model("PartDesign::Pocket")
def design_pocket(m):
    body = m.body(LEAN)
    m.feature(body, "Pad", box(-8, -5, 8, 5), Length=6)
    m.feature(body, "Pocket", slot(-4, 4, 0, 2),
              Placement(Vector(0, 0, 6), Rotation()), Length=2.5)
    m.feature(body, "Pocket", [circle(5, 3, 1)],
              Placement(Vector(0, 0, 0), Rotation()), Length=3, Reversed=True)
    return body


@model("PartDesign::Pocket, ThroughAll, Midplane, TwoLengths")
def design_pocket_through(m):
    body = m.body(TILT)
    m.feature(body, "Pad", box(-8, -5, 8, 5), Length=6)
    m.feature(body, "Pocket", [circle(0, 0, 2)],
              Placement(Vector(0, 0, 6), Rotation(X, 15)), Type="ThroughAll")
    m.feature(body, "Pocket", box(-7, -4, -5, -2),
              Placement(Vector(0, 0, 3), Rotation()), Type="ThroughAll",
              Midplane=True)
    m.feature(body, "Pocket", [circle(5, 2, 1)],
              Placement(Vector(0, 0, 3), Rotation()), Type="TwoLengths",
              Length=1, Length2=2)
    return body


@model("PartDesign::Pocket, custom direction")
def design_pocket_direction(m):
    body = m.body()
    m.feature(body, "Pad", box(-8, -5, 8, 5), Length=6)
    m.feature(body, "Pocket", [circle(0, 0, 2)],
              Placement(Vector(0, 0, 6), Rotation()), Length=4,
              UseCustomVector=True, Direction=Vector(1, 0, -2))
    return body


@model("PartDesign::Revolution")
def design_revolution(m):
    body = m.body(LEAN)
    sketch = m.sketch(box(3, -2, 7, 4) + [circle(5, 1, 1)], TILT, body)
    turned = body.newObject("PartDesign::Revolution", "Revolution")
    turned.Profile = sketch
    turned.ReferenceAxis = (sketch, ["V_Axis"])
    turned.Angle = 360
    return body


@model("PartDesign::Revolution, Angle, Reversed, Midplane")
def design_revolution_sector(m):
    body = m.body()
    at = Placement(Vector(0, 0, 0), Rotation(X, 90))
    for angle, flags, shift in ((80, {"Reversed": True}, 0),
                                (60, {"Midplane": True}, 3)):
        sketch = m.sketch(box(2 + shift, -2, 7, 4), at, body)
        turned = body.newObject("PartDesign::Revolution", "Revolution")
        turned.Profile = sketch
        turned.ReferenceAxis = (sketch, ["V_Axis"])
        turned.Angle = angle
        for key, value in flags.items():
            setattr(turned, key, value)
        m.document.recompute()
    return body


@model("PartDesign::Groove")
def design_groove(m):
    body = m.body(TILT)
    m.feature(body, "Pad", [circle(0, 0, 6)], Length=10)
    sketch = m.sketch([circle(6, 5, 2)],
                      Placement(Vector(0, 0, 0), Rotation(X, 90)), body)
    groove = body.newObject("PartDesign::Groove", "Groove")
    groove.Profile = sketch
    groove.ReferenceAxis = (m.axis(body, "Z_Axis"), [""])
    groove.Angle = 290
    return body


def drilled(m, **properties):
    body = m.body(LEAN)
    m.feature(body, "Pad", box(-9, -6, 9, 6), Length=10)
    m.feature(body, "Hole", [circle(-4, 0, 1), circle(4, 1, 1)],
              Placement(Vector(0, 0, 10), Rotation()), **properties)
    return body


@model("PartDesign::Hole", "boundary")
def design_hole(m):
    return drilled(m, Diameter=3, Depth=6, DrillPoint="Flat")


@model("PartDesign::Hole, ThroughAll", "boundary")
def design_hole_through(m):
    return drilled(m, Diameter=3, DepthType="ThroughAll")


@model("PartDesign::Hole, drill point", "boundary")
def design_hole_point(m):
    return drilled(m, Diameter=4, Depth=5, DrillPoint="Angled",
                   DrillPointAngle=118)


@model("PartDesign::Hole, counterbore", "boundary")
def design_hole_counterbore(m):
    return drilled(m, Diameter=3, Depth=7, DrillPoint="Flat",
                   HoleCutType="Counterbore", HoleCutDiameter=5, HoleCutDepth=2)


@model("PartDesign::Hole, countersink", "boundary")
def design_hole_countersink(m):
    return drilled(m, Diameter=3, Depth=7, DrillPoint="Flat",
                   HoleCutType="Countersink", HoleCutDiameter=6,
                   HoleCutCountersinkAngle=90)


@model("PartDesign primitives, additive and subtractive")
def design_primitives(m):
    body = m.body(LEAN)
    m.feature(body, "AdditiveBox", Length=12, Width=10, Height=6)
    m.feature(body, "AdditiveCylinder", Radius=3, Height=9,
              Placement=Placement(Vector(4, 4, 3), Rotation(X, 20)))
    m.feature(body, "SubtractiveSphere", Radius=3,
              Placement=Placement(Vector(12, 10, 6), Rotation()))
    m.feature(body, "SubtractiveCone", Radius1=2, Radius2=0.5, Height=8,
              Placement=Placement(Vector(10, 2, -1), Rotation()))
    m.feature(body, "SubtractiveTorus", Radius1=6, Radius2=1,
              Placement=Placement(Vector(6, 5, 0), Rotation()))
    return body


@model("PartDesign primitives of other forms, and parts of bodies", "boundary")
def design_primitives_rare(m):
    body = m.body(LEAN)
    m.feature(body, "AdditiveBox", Length=12, Width=10, Height=6)
    m.feature(body, "AdditivePrism", Polygon=5, Circumradius=2, Height=4,
              Placement=Placement(Vector(2, 8, 5), Rotation(Z, 12)))
    m.feature(body, "AdditiveEllipsoid", Radius1=2, Radius2=3, Radius3=1,
              Placement=Placement(Vector(0, 5, 3), Rotation(Z, 33)))
    m.feature(body, "SubtractiveWedge", Xmin=0, Ymin=0, Zmin=0, X2min=1, Z2min=1,
              Xmax=4, Ymax=3, Zmax=4, X2max=3, Z2max=3,
              Placement=Placement(Vector(4, -1, 4), Rotation()))
    return body


@model("PartDesign::LinearPattern", "boundary")
def design_linear_pattern(m):
    body = m.body(TILT)
    base = m.feature(body, "Pad", box(0, 0, 30, 10), Length=4)
    pocket = m.feature(body, "Pocket", [circle(3, 3, 1.5)],
                       Placement(Vector(0, 0, 4), Rotation()), Length=3)
    pattern = body.newObject("PartDesign::LinearPattern", "LinearPattern")
    pattern.Originals = [pocket]
    pattern.Direction = (m.axis(body, "X_Axis"), [""])
    pattern.Length = 20
    pattern.Occurrences = 4
    body.Tip = pattern
    m.document.recompute()
    knob = m.feature(body, "Pad", [circle(3, 7, 1)],
                     Placement(Vector(0, 0, 4), Rotation()), Length=2)
    again = body.newObject("PartDesign::LinearPattern", "LinearPattern")
    again.Originals = [knob]
    again.Direction = (base.Profile[0], ["H_Axis"])
    again.Reversed = False
    again.Length = 24
    again.Occurrences = 5
    body.Tip = again
    return body


@model("PartDesign::PolarPattern", "boundary")
def design_polar_pattern(m):
    body = m.body(LEAN)
    m.feature(body, "Pad", [circle(0, 0, 10)], Length=4)
    pocket = m.feature(body, "Pocket", [circle(7, 0, 1.5)],
                       Placement(Vector(0, 0, 4), Rotation()),
                       Type="ThroughAll")
    pattern = body.newObject("PartDesign::PolarPattern", "PolarPattern")
    pattern.Originals = [pocket]
    pattern.Axis = (m.axis(body, "Z_Axis"), [""])
    pattern.Angle = 360
    pattern.Occurrences = 5
    body.Tip = pattern
    m.document.recompute()
    fin = m.feature(body, "Pad", box(9, -0.5, 13, 0.5), Length=3)
    again = body.newObject("PartDesign::PolarPattern", "PolarPattern")
    again.Originals = [fin]
    again.Axis = (fin.Profile[0], ["N_Axis"])
    again.Angle = 120
    again.Reversed = True
    again.Occurrences = 3
    body.Tip = again
    return body


@model("PartDesign::Mirrored", "boundary")
def design_mirrored(m):
    body = m.body(TILT)
    m.feature(body, "Pad", box(-12, -8, 12, 8), Length=4)
    pocket = m.feature(body, "Pocket", path((2, 2), (9, 3), (4, 6)),
                       Placement(Vector(0, 0, 4), Rotation()), Length=3)
    across = body.newObject("PartDesign::Mirrored", "Mirrored")
    across.Originals = [pocket]
    across.MirrorPlane = (pocket.Profile[0], ["V_Axis"])
    body.Tip = across
    m.document.recompute()
    knob = m.feature(body, "Pad", path((3, -2), (8, -3), (5, -6)),
                     Placement(Vector(0, 0, 4), Rotation()), Length=2)
    along = body.newObject("PartDesign::Mirrored", "Mirrored")
    along.Originals = [knob]
    along.MirrorPlane = (m.axis(body, "YZ_Plane"), [""])
    body.Tip = along
    return body


@model("PartDesign::MultiTransform", "boundary")
def design_multi_transform(m):
    body = m.body(LEAN)
    m.feature(body, "Pad", box(-15, -10, 15, 10), Length=3)
    pocket = m.feature(body, "Pocket", path((1, 1), (3, 1.5), (2, 4)),
                       Placement(Vector(0, 0, 3), Rotation()), Length=2)
    many = body.newObject("PartDesign::MultiTransform", "MultiTransform")
    many.Originals = [pocket]
    rows = body.newObject("PartDesign::LinearPattern", "LinearPattern")
    rows.Direction = (m.axis(body, "X_Axis"), [""])
    rows.Length = 10
    rows.Occurrences = 3
    across = body.newObject("PartDesign::Mirrored", "Mirrored")
    across.MirrorPlane = (pocket.Profile[0], ["H_Axis"])
    around = body.newObject("PartDesign::PolarPattern", "PolarPattern")
    around.Axis = (pocket.Profile[0], ["N_Axis"])
    around.Angle = 360
    around.Occurrences = 2
    many.Transformations = [rows, across, around]
    body.Tip = many
    return body


@model("PartDesign::Boolean")
def design_boolean(m):
    other = m.body(Placement(Vector(3, 2, -1), Rotation(X, 10)))
    m.feature(other, "Pad", [circle(0, 0, 2)], Length=12)
    body = m.body(LEAN)
    m.feature(body, "Pad", box(-2, -3, 9, 6), Length=6)
    cut = body.newObject("PartDesign::Boolean", "Boolean")
    cut.Type = "Cut"
    cut.setObjects([other])
    body.Tip = cut
    return body


@model("PartDesign::Body with a base feature")
def design_base_feature(m):
    base = m.part("Box", TILT, Length=9, Width=8, Height=5)
    body = m.body(LEAN)
    body.BaseFeature = base
    m.document.recompute()
    m.feature(body, "Pocket", [circle(3, 4, 2)], Placement(Vector(0, 0, 5), Rotation()),
              Length=3)
    return body


# --- Groups and links ---------------------------------------------------------


@model("App::Part, nested")
def app_part(m):
    inner = m.add("App::Part", "Inner", LEAN)
    block = m.part("Box", Length=9, Width=7, Height=5, Visibility=False)
    ball = m.part("Sphere", Radius=4, Visibility=False)
    inner.addObject(m.part("Cut", Base=block, Tool=ball))
    outer = m.add("App::Part", "Outer", TILT)
    outer.addObject(inner)
    outer.addObject(m.part("Cone", Placement(Vector(14, 0, 0), Rotation(Y, 90)),
                           Radius1=3, Radius2=1, Height=6))
    return outer


@model("App::DocumentObjectGroup")
def app_group(m):
    group = m.add("App::DocumentObjectGroup", "Group")
    group.addObject(m.part("Box", LEAN, Length=4, Width=5, Height=6))
    group.addObject(m.part("Cylinder", TILT, Radius=2, Height=5))
    m.result = [group]
    return group


@model("App::GeometryPython with a plain group, as Arch's storeys are")
def app_group_python(m):
    storey = m.document.addObject("App::GeometryPython", "Storey")
    storey.addExtension("App::GroupExtensionPython")
    storey.addObject(m.part("Box", LEAN, Length=4, Width=5, Height=6))
    storey.addObject(m.part("Cylinder", TILT, Radius=2, Height=5))
    return storey


@model("App::Link")
def app_link(m):
    body = m.body(LEAN)
    m.feature(body, "Pad", path((0, 0), (9, 0), (2, 6)), Length=4)
    link = m.add("App::Link", "Link")
    link.setLink(body)
    link.Placement = Placement(Vector(15, 3, 2), Rotation(Y, 30))
    kept = m.add("App::Link", "Kept")
    kept.setLink(body)
    kept.LinkTransform = True
    kept.Placement = Placement(Vector(-20, 3, 2), Rotation(Z, 50))
    m.result = [body, link, kept]
    return body


@model("App::Link, scaled")
def app_link_scaled(m):
    block = m.part("Cut", LEAN,
                   Base=m.part("Box", Length=9, Width=7, Height=5,
                               Visibility=False),
                   Tool=m.part("Cylinder", Radius=3, Height=9,
                               Visibility=False))
    link = m.add("App::Link", "Link")
    link.setLink(block)
    link.ScaleVector = Vector(1.5, 0.5, 2)
    link.Placement = TILT
    block.Visibility = False
    return link


PLACES = [Placement(Vector(9 * i, 2 * i, i), Rotation(Z, 25 * i)) for i in range(3)]


def link_array(m, has_objects):
    """Three links to a hidden block."""
    array = m.add("App::Link", "Array", TILT)
    array.setLink(m.part("Box", LEAN, Length=4, Width=5, Height=6, Visibility=False))
    array.ShowElement = has_objects
    array.ElementCount = len(PLACES)
    return array


@model("App::Link, an array of elements")
def app_link_array(m):
    array = link_array(m, True)
    for element, place in zip(array.ElementList, PLACES):
        element.Placement = place
    return array


@model("App::Link, an array of lists")
def app_link_array_collapsed(m):
    array = link_array(m, False)
    array.PlacementList = PLACES
    array.ScaleList = [Vector(1, 1, 1) * (1 + i / 4) for i in range(3)]
    return array


@model("App::LinkGroup that hides a link")
def app_link_group(m):
    group = m.add("App::LinkGroup", "LinkGroup", TILT)
    group.setLink([m.part("Box", LEAN, Length=9, Width=7, Height=5),
                   m.part("Sphere", Radius=9)])
    group.setElementVisible("1", False)
    return group


# --- By boundary --------------------------------------------------------------


@model("PartDesign::Fillet", "boundary")
def design_fillet(m):
    body = m.body(LEAN)
    pad = m.feature(body, "Pad", box(-8, -5, 8, 5), Length=6)
    m.feature(body, "Fillet", Base=(pad, ["Edge1", "Edge5", "Edge9"]), Radius=1.5)
    return body


@model("PartDesign::Chamfer, then Pocket", "boundary")
def design_chamfer(m):
    body = m.body(TILT)
    pad = m.feature(body, "Pad", box(-8, -5, 8, 5), Length=6)
    m.feature(body, "Chamfer", Base=(pad, ["Edge1", "Edge7"]), Size=1)
    m.feature(body, "Pocket", [circle(0, 0, 2)],
              Placement(Vector(0, 0, 6), Rotation()), Length=4)
    return body


@model("PartDesign::Pad, TaperAngle", "boundary")
def design_pad_taper(m):
    body = m.body(LEAN)
    m.feature(body, "Pad", box(-8, -5, 8, 5), Length=5, TaperAngle=10)
    return body


@model("PartDesign::AdditiveLoft", "boundary")
def design_loft(m):
    body = m.body()
    low = m.sketch(box(-5, -4, 5, 4), None, body)
    high = m.sketch([circle(0, 0, 2)], Placement(Vector(1, 0, 9), Rotation()),
                    body)
    loft = body.newObject("PartDesign::AdditiveLoft", "Loft")
    loft.Profile = low
    loft.Sections = [high]
    return body


@model("PartDesign::AdditivePipe", "boundary")
def design_pipe(m):
    body = m.body(LEAN)
    spine = m.sketch([arc(0, 0, 10, 0, 80)], None, body)
    profile = m.sketch([circle(10, 0, 2)],
                       Placement(Vector(0, 0, 0), Rotation(X, 90)), body)
    pipe = body.newObject("PartDesign::AdditivePipe", "Pipe")
    pipe.Profile = profile
    pipe.Spine = spine
    return body


@model("PartDesign::Thickness", "boundary")
def design_thickness(m):
    body = m.body(TILT)
    pad = m.feature(body, "Pad", box(-8, -5, 8, 5), Length=6)
    m.feature(body, "Thickness", Base=(pad, ["Face6"]), Value=1)
    return body


@model("Part::Fillet, cut by a primitive", "boundary")
def part_fillet(m):
    block = m.part("Box", TILT, Length=9, Width=7, Height=5)
    m.document.recompute()
    fillet = m.part("Fillet", Base=block)
    fillet.Edges = [(1, 1.0, 1.0), (4, 1.5, 1.5)]
    return m.part("Cut", LEAN, Base=fillet,
                  Tool=m.part("Sphere", TILT, Radius=4))


@model("PartDesign::Pad to a face", "boundary")
def design_pad_to_face(m):
    body = m.body(LEAN)
    m.feature(body, "Pad", box(-8, -5, 8, 5), Length=3)
    pad = m.feature(body, "Pad", box(4, -5, 8, 5),
                    Placement(Vector(0, 0, 3), Rotation()), Length=4)
    to = m.feature(body, "Pad", box(-2, -2, 2, 2),
                   Placement(Vector(0, 0, 5), Rotation(Y, 90)))
    to.UpToFace = (pad, ["Face%d" % next(
        i for i, f in enumerate(pad.Shape.Faces, 1)
        if f.CenterOfMass.x > 3.9 and f.CenterOfMass.x < 4.1)])
    to.Type = "UpToFace"
    return body


@model("PartDesign::LinearPattern along an edge", "boundary")
def design_pattern_edge(m):
    body = m.body(TILT)
    pad = m.feature(body, "Pad", box(0, 0, 30, 10), Length=4)
    pocket = m.feature(body, "Pocket", [circle(3, 3, 1.5)],
                       Placement(Vector(0, 0, 4), Rotation()), Length=3)
    edge = next(i for i, e in enumerate(pad.Shape.Edges, 1)
                if abs(e.tangentAt(0).x) > 0.9)
    pattern = body.newObject("PartDesign::LinearPattern", "LinearPattern")
    pattern.Originals = [pocket]
    pattern.Direction = (pad, ["Edge%d" % edge])
    pattern.Length = 20
    pattern.Occurrences = 4
    body.Tip = pattern
    return body


@model("Part::Chamfer, Part::Thickness", "boundary")
def part_chamfer(m):
    block = m.part("Box", TILT, Length=9, Width=7, Height=5)
    m.document.recompute()
    chamfer = m.part("Chamfer", Base=block)
    chamfer.Edges = [(1, 1.0, 1.0), (4, 1.5, 1.5)]
    cup = m.part("Box", Placement(Vector(12, 0, 0), Rotation()), Length=9,
                 Width=7, Height=5)
    m.document.recompute()
    hollow = m.part("Thickness", Faces=(cup, ["Face6"]), Value=1.0)
    return m.part("Compound", Links=[chamfer, hollow])


@model("Part::FeaturePython, as Draft's copies are", "boundary")
def part_feature_python(m):
    row = Part.makeCompound([
        Part.makeCone(3, 1, 5, Vector(8 * i, 0, 0)) for i in range(3)])
    return m.part("FeaturePython", LEAN, Shape=row)


@model("Part::Feature, imported", "boundary")
def part_feature(m):
    shape = Part.makeTorus(6, 2).cut(Part.makeBox(5, 5, 5))
    return m.part("Feature", LEAN, Shape=shape)


@model("Part::Loft", "boundary")
def part_loft(m):
    low = m.sketch([circle(0, 0, 5)])
    high = m.sketch(box(-2, -2, 2, 2), Placement(Vector(1, 1, 8), Rotation()))
    return m.part("Loft", LEAN, Sections=[low, high], Solid=True)


@model("Part::Sweep", "boundary")
def part_sweep(m):
    spine = m.sketch([arc(0, 0, 10, 0, 80)])
    profile = m.sketch([circle(10, 0, 2)],
                       Placement(Vector(0, 0, 0), Rotation(X, 90)))
    m.document.recompute()
    return m.part("Sweep", Sections=[profile], Spine=(spine, ["Edge1"]),
                  Solid=True, Frenet=True)


@model("Part::Offset", "boundary")
def part_offset(m):
    block = m.part("Box", LEAN, Length=9, Width=7, Height=5)
    return m.part("Offset", Source=block, Value=1.0)


# --- FreeCAD's own examples ---------------------------------------------------

EXAMPLES = {
    "example_drilling": (
        "Path/PathTests/Drilling_1.FCStd", ["Pocket006"],
        "FreeCAD's Drilling_1: 3 pads, 7 pockets, 2 patterns", "boundary"),
    "example_contact": (
        "Fem/femtest/data/calculix/constraint_contact_solid_solid.FCStd",
        ["AllGeomFusion"], "FreeCAD's constraint_contact_solid_solid",
        "parameter"),
}


# --- Writing ------------------------------------------------------------------


def doubled_area(loop):
    return sum(a[0] * b[1] - b[0] * a[1]
               for a, b in zip(loop, loop[1:] + loop[:1]))


def is_inside(point, loop):
    x, y = point
    inside = False
    for (ax, ay), (bx, by) in zip(loop, loop[1:] + loop[:1]):
        if (ay > y) != (by > y) and x < ax + (y - ay) / (by - ay) * (bx - ax):
            inside = not inside
    return inside


def oriented(loops):
    """Outer loops counter-clockwise, what lies in an odd number clockwise."""
    result = []
    for i, loop in enumerate(loops):
        depth = sum(is_inside(loop[0], other)
                    for j, other in enumerate(loops) if j != i)
        if (doubled_area(loop) > 0) != (depth % 2 == 0):
            loop = loop[::-1]
        result.append(loop)
    return result


def heights_of(shape):
    """Heights off both ends, where surfaces lie so flat in the layer that a
    small distance off them is a large one along it."""
    box = shape.optimalBoundingBox(False)
    height = box.ZMax - box.ZMin
    return [box.ZMin + height * (0.12 + 0.76 * (k + 0.4837) / LAYERS)
            for k in range(LAYERS)]


def global_shape(thing):
    """What the object shows, in the document's frame."""
    if thing.isDerivedFrom("App::DocumentObjectGroup"):
        return Part.makeCompound([global_shape(o) for o in thing.Group])
    return Part.getShape(thing)


def write_sections(shapes, path, feature, by):
    shape = Part.makeCompound([global_shape(o) for o in shapes])
    sections = freecad_sections.sections(shape, heights_of(shape))
    for section in sections:
        section["loops"] = [loop for loops in section.pop("solids")
                            for loop in oriented(loops)]
    with open(path + ".json", "w") as file:
        json.dump({"feature": feature, "by": by, "sections": sections}, file)


def write_example(name, folder):
    file, shown, feature, by = EXAMPLES[name]
    path = os.path.join(folder, name)
    shutil.copy(os.path.join(MODULES, file), path + ".FCStd")
    document = FreeCAD.openDocument(path + ".FCStd")
    if name == "example_drilling":
        # A later sketch was moved after its pocket had been cut.
        document.Body.Tip = document.Pocket006
    document.save()
    shapes = [document.getObject(o) for o in shown]
    write_sections(shapes, path, feature, by)
    FreeCAD.closeDocument(document.Name)


def write(name, folder):
    build, feature, by = MODELS[name]
    m = Model(name)
    shown = build(m)
    m.document.recompute()
    broken = [o.Name for o in m.document.Objects
              if "Invalid" in o.State or "Error" in o.State]
    if broken:
        raise RuntimeError(f"{name}: FreeCAD makes nothing of {broken}")
    path = os.path.join(folder, name)
    m.document.saveAs(path + ".FCStd")
    write_sections(m.result or [shown], path, feature, by)
    FreeCAD.closeDocument(m.document.Name)


def main():
    folder = sys.argv[1]
    os.makedirs(folder, exist_ok=True)
    for name in sys.argv[2:] or [*MODELS, *EXAMPLES]:
        (write if name in MODELS else write_example)(name, folder)


if __name__ == "__main__":
    main()

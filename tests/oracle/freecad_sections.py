#!/usr/bin/env python3
# FreeCAD as the judge of layers: sections of shapes as its kernel, OpenCASCADE,
# computes them from the exact surfaces, with no triangle in between.
#
#   tests/oracle/freecad_sections.py --count 12 PART.step   as JSON
#   tests/oracle/freecad_sections.py PART.step HEIGHT…
#   tests/oracle/freecad_sections.py --off LAYERS.json PART.step
#   import freecad_sections                                 from other scripts
#
# Sections are [{"height": z, "area": a, "perimeter": p, "solids": […]}, …]. For
# each solid there are its loops, [[[x, y], …], …]: closed, in no order and
# direction, and inside is what an odd number of them encloses. Curves are cut
# into chords that are off by at most DEFLECTION times the solid's size. Area and
# perimeter are those of the exact faces, of all solids added.

import json
import random
import sys

for folder in ("/usr/lib/freecad-python3/lib", "/usr/lib/freecad/lib"):
    sys.path.append(folder)

import FreeCAD  # noqa: E402
import Part  # noqa: E402

UP = FreeCAD.Vector(0, 0, 1)

# Far below the chordal errors that are judged.
DEFLECTION = 2e-6

# Ends of neighbouring curves are this close [mm].
GAP = 1e-4


def points_of(edge, deflection):
    if isinstance(edge.Curve, Part.Line):
        return [v.Point for v in (edge.Vertexes[0], edge.Vertexes[-1])]
    return edge.discretize(Deflection=deflection)


def chain(edges, deflection):
    """The curves of one closed wire as one polygon, end to end."""
    rest = [points_of(edge, deflection) for edge in edges]
    loop = rest.pop(0)
    while rest:
        end = loop[-1]

        def gap(i):
            return min((rest[i][0] - end).Length, (rest[i][-1] - end).Length)

        nearest = min(range(len(rest)), key=gap)
        if gap(nearest) > GAP:
            # The first curve may run the other way.
            if (loop[0] - end).Length > GAP:
                loop.reverse()
                end = loop[-1]
                nearest = min(range(len(rest)), key=gap)
        points = rest.pop(nearest)
        if (points[0] - end).Length > (points[-1] - end).Length:
            points.reverse()
        loop += points[1:]
    return [[p.x, p.y] for p in loop[:-1]]


def section(shape, height):
    result = {"height": height, "area": 0.0, "perimeter": 0.0, "solids": []}
    for solid in shape.Solids:
        wires = solid.slice(UP, height)
        if not wires:
            continue
        face = Part.makeFace(Part.makeCompound(wires),
                             "Part::FaceMakerBullseye")
        deflection = DEFLECTION * solid.BoundBox.DiagonalLength
        result["area"] += face.Area
        result["perimeter"] += face.Length
        result["solids"].append(
            [chain(wire.Edges, deflection) for wire in wires])
    return result


def sections(shape, heights):
    return [section(shape, height) for height in heights]


def heights_of(shape, count):
    """Heights that meet no round number, and not the shape's ends, where round
    surfaces lie nearly in the plane of the section."""
    box = shape.BoundBox
    return [box.ZMin + (0.07 + 0.86 * (k + 0.4837) / count)
            * (box.ZMax - box.ZMin) for k in range(count)]


def distance_in_space(shape, layers, count=200):
    """The greatest distance from the part's faces of some points of contours,
    of a .layers.json, corners and middles of sides."""
    points = []
    for layer in layers:
        for contour in layer["contours"]:
            loop = contour["points"]
            for a, b in zip(loop, loop[1:] + loop[:1]):
                points.append((*a, layer["z"]))
                points.append(((a[0] + b[0]) / 2, (a[1] + b[1]) / 2,
                               layer["z"]))
    faces = Part.makeCompound(shape.Faces)
    return max(faces.distToShape(Part.Vertex(*p))[0] for p in
               random.Random(1).sample(points, min(count, len(points))))


def main():
    arguments = sys.argv[1:]
    if arguments[0] == "--off":
        with open(arguments[1]) as file:
            layers = json.load(file)["layers"]
        print(distance_in_space(Part.read(arguments[2]), layers))
        return
    if arguments[0] == "--count":
        shape = Part.read(arguments[2])
        heights = heights_of(shape, int(arguments[1]))
    else:
        shape = Part.read(arguments[0])
        heights = [float(z) for z in arguments[1:]]
    json.dump(sections(shape, heights), sys.stdout)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# FreeCAD as the judge of layers: sections of shapes as its kernel, OpenCASCADE,
# computes them from the exact surfaces, with no triangle in between.
#
#   tests/oracle/freecad_sections.py PART.step HEIGHT…      as JSON
#   import freecad_sections                                 from other scripts
#
# A section is [{"height": z, "area": a, "loops": [[[x, y], …], …]}, …]. Its
# loops are closed, in no order and direction; curves are cut into chords that
# are off by at most DEFLECTION times the part's size. The section of a part is what an odd number of
# loops of one solid encloses, all solids united: "solids" has the loops of each
# apart. Areas are those of the exact faces, of all solids added.

import json
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


def solid_section(solid, height):
    """The wires of one solid, and the area between them."""
    wires = solid.slice(UP, height)
    if not wires:
        return [], 0.0
    deflection = DEFLECTION * solid.BoundBox.DiagonalLength
    face = Part.makeFace(Part.makeCompound(wires), "Part::FaceMakerBullseye")
    return [chain(wire.Edges, deflection) for wire in wires], face.Area


def section(shape, height):
    solids = []
    area = 0.0
    for solid in shape.Solids:
        loops, own = solid_section(solid, height)
        if loops:
            solids.append(loops)
            area += own
    return {
        "height": height,
        "area": area,
        "solids": solids,
        "loops": [loop for loops in solids for loop in loops],
    }


def sections(shape, heights):
    return [section(shape, height) for height in heights]


def heights_of(shape, count):
    """Heights between the shape's ends that meet no round number."""
    box = shape.BoundBox
    step = (box.ZMax - box.ZMin) / count
    return [box.ZMin + (k + 0.4837) * step for k in range(count)]


def main():
    shape = Part.read(sys.argv[1])
    json.dump(sections(shape, [float(z) for z in sys.argv[2:]]), sys.stdout)


if __name__ == "__main__":
    main()

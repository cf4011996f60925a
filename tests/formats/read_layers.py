#!/usr/bin/env python3
"""Reads layer files as docs/formats.md describes them, and nothing else.

    read_layers.py <file>…

Written from the description of the formats alone, so that a misunderstanding
of lamina's writers and readers shows. Prints one line a layer,

    <height> <loops> <holes> <area> <perimeter>

with millimetres; the height is that of the layer's upper side. Of images, in
archives and folders, only the area is known: the grey of all pixels. Whatever
breaks a rule of the format ends it with a message and status 1.
"""
import json
import math
import os
import re
import struct
import sys
import xml.etree.ElementTree
import zipfile
import zlib


def demand(condition, words):
    if not condition:
        raise SystemExit(f"read_layers: {words}")


class Bytes:
    """Little-endian numbers one after another."""

    def __init__(self, data, place=0):
        self.data = data
        self.place = place

    def take(self, layout):
        size = struct.calcsize("<" + layout)
        demand(self.place + size <= len(self.data), "the file ends too early")
        values = struct.unpack_from("<" + layout, self.data, self.place)
        self.place += size
        return values if len(values) > 1 else values[0]

    def points(self, count):
        numbers = self.take(f"{2 * count}f")
        return list(zip(numbers[::2], numbers[1::2]))

    def at_end(self):
        return self.place == len(self.data)


def open_loop(points):
    """A loop whose last point repeats the first, without that point."""
    demand(len(points) >= 4, "a loop of fewer than four written points")
    demand(points[0] == points[-1], "a loop does not close")
    demand(all(a != b for a, b in zip(points, points[1:])), "a repeated point")
    return points[:-1]


def signed_area(loop):
    """Positive where the loop runs counter-clockwise."""
    x0, y0 = loop[0]
    return 0.5 * sum((a[0] - x0) * (b[1] - y0) - (a[1] - y0) * (b[0] - x0)
                     for a, b in zip(loop, loop[1:] + loop[:1]))


def read_slc(data):
    end = data.index(b"\r\n\x1a") + 3
    demand(end <= 2048, "the header is too long")
    header = data[:end - 3].decode("ascii")
    demand(header.startswith("-SLCVER 2.0 -UNIT MM -TYPE PART -PACKAGE lamina"),
           "the header does not begin as it should")
    box = re.search(r"-EXTENTS (\S+),(\S+) (\S+),(\S+) (\S+),(\S+)$", header)
    demand(box, "no extents")
    body = Bytes(data, end + 256)
    rows = [body.take("4f") for _ in range(body.take("B"))]
    demand(rows, "no row in the sampling table")
    layers = []
    while True:
        z, boundaries = body.take("fI")
        if boundaries == 0xFFFFFFFF:
            break
        loops = []
        for _ in range(boundaries):
            vertices, gaps = body.take("II")
            demand(gaps == 0, "a gap")
            loops.append(open_loop(body.points(vertices)))
        demand(not layers or z > layers[-1][0], "layers do not rise")
        layers.append((z, loops))
    demand(body.at_end(), "bytes behind the end")
    thickness = rows[0][1]
    demand(not layers or abs(layers[-1][0] + thickness - z) < 1e-5 * (1 + z),
           "the top is not that of the last layer")
    check_box(layers, [float(n) for n in box.groups()])
    return [(low + thickness, loops) for low, loops in layers]


def check_box(layers, box):
    points = [p for _, loops in layers for loop in loops for p in loop]
    if not points:
        return
    found = [min(x for x, _ in points), max(x for x, _ in points),
             min(y for _, y in points), max(y for _, y in points)]
    demand(all(math.isclose(a, b, rel_tol=1e-6, abs_tol=1e-6)
               for a, b in zip(found, box)), f"the box is {found}, not {box}")


def read_cli(data):
    lines, place = [], 0
    while not data.startswith(b"$$HEADEREND", place):
        end = data.index(b"\n", place)
        lines.append(data[place:end].decode("ascii"))
        place = end + 1
    place += len("$$HEADEREND")
    demand(lines[0] == "$$HEADERSTART", "no header")
    keys = dict((line[2:].split("/", 1) + [""])[:2] for line in lines[1:])
    demand(keys["VERSION"] == "200", "not version 2.0")
    unit = float(keys["UNITS"])
    read = read_cli_ascii if "ASCII" in keys else read_cli_binary
    layers = [(z * unit, [[(x * unit, y * unit) for x, y in loop]
                          for loop in loops])
              for z, loops in read(data, place)]
    demand(len(layers) == int(keys["LAYERS"]), "layers do not count up")
    low_x, low_y, _, high_x, high_y, high_z = map(
        float, keys["DIMENSION"].split(","))
    demand(not layers or abs(layers[-1][0] - high_z) < 1e-5 * (1 + high_z),
           "the top is not that of the last layer")
    check_box(layers, [low_x, high_x, low_y, high_y])
    return layers


def turned(direction, points):
    demand(direction in (0, 1), f"direction {direction}")
    loop = open_loop(points)
    demand((signed_area(loop) > 0) == (direction == 1),
           "a loop does not run as its direction says")
    return loop


def read_cli_ascii(data, place):
    lines = data[place:].decode("ascii").split("\n")
    demand(lines[:2] == ["", "$$GEOMETRYSTART"], "no start of the geometry")
    demand(lines[-2:] == ["$$GEOMETRYEND", ""], "no end of the geometry")
    layers = []
    for line in lines[2:-2]:
        command, parameters = line.split("/")
        if command == "$$LAYER":
            layers.append((float(parameters), []))
            continue
        demand(command == "$$POLYLINE", f"command {command}")
        fields = parameters.split(",")
        numbers = [float(field) for field in fields[3:]]
        demand(len(numbers) == 2 * int(fields[2]), "points do not count up")
        layers[-1][1].append(
            turned(int(fields[1]), list(zip(numbers[::2], numbers[1::2]))))
    return layers


def read_cli_binary(data, place):
    body = Bytes(data, place)
    layers = []
    while not body.at_end():
        command = body.take("H")
        if command == 127:
            layers.append((body.take("f"), []))
            continue
        demand(command == 130, f"command {command}")
        _, direction, count = body.take("3i")
        layers[-1][1].append(turned(direction, body.points(count)))
    return layers


def read_svg(data):
    """Heights are those of the sections; slic3r 1.3 writes them in metres."""
    name = "{http://slic3r.org/namespaces/slic3r}"
    svg = "{http://www.w3.org/2000/svg}"
    layers = []
    for group in xml.etree.ElementTree.fromstring(data).iter(svg + "g"):
        demand(group.get("id") == f"layer{len(layers)}", "groups do not count up")
        loops = []
        for polygon in group.iter(svg + "polygon"):
            loop = [tuple(map(float, point.split(",")))
                    for point in polygon.get("points").split()]
            kind = polygon.get(name + "type")
            demand(kind in ("contour", "hole"), f"type {kind}")
            is_clockwise = signed_area(loop) < 0
            loops.append(loop if is_clockwise == (kind == "hole")
                         else loop[::-1])
        layers.append((float(group.get(name + "z")), loops))
    return layers


SLICE = "{http://schemas.microsoft.com/3dmanufacturing/slice/2015/07}"
CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"


def read_3mf(path):
    archive = zipfile.ZipFile(path)
    demand(archive.testzip() is None, "a broken entry")
    demand(set(archive.namelist()) == {"[Content_Types].xml", "_rels/.rels",
                                       "3D/3dmodel.model"}, "parts")
    types = xml.etree.ElementTree.fromstring(
        archive.read("[Content_Types].xml"))
    demand({t.get("Extension"): t.get("ContentType") for t in types} == {
        "rels": "application/vnd.openxmlformats-package.relationships+xml",
        "model": "application/vnd.ms-package.3dmanufacturing-3dmodel+xml"},
        "content types")
    relation, = xml.etree.ElementTree.fromstring(archive.read("_rels/.rels"))
    demand(relation.get("Target") == "/3D/3dmodel.model" and
           relation.get("Type") ==
           "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel",
           "the relationship")
    model = xml.etree.ElementTree.fromstring(archive.read("3D/3dmodel.model"))
    demand(model.tag == CORE + "model" and model.get("unit") == "millimeter" and
           model.get("requiredextensions") == "s", "the model")
    stack, part = model.find(CORE + "resources")
    item, = model.find(CORE + "build")
    demand(part.tag == CORE + "object" and item.attrib == {
        "objectid": part.get("id")}, "the object is not built")
    demand(part.get(SLICE + "slicestackid") == stack.get("id") and
           part.get(SLICE + "meshresolution") == "lowres", "no stack")
    demand(re.fullmatch(r"contours within [0-9.e-]+ mm", part.get("name", "")),
           "no bound on the contours")
    layers = [(float(piece.get("ztop")), slice_loops(piece))
              for piece in stack]
    bottom = float(stack.get("zbottom"))
    heights = [bottom] + [top for top, _ in layers]
    demand(all(a < b for a, b in zip(heights, heights[1:])), "slices sink")
    check_box_mesh(part.find(CORE + "mesh"), layers, bottom)
    return [(top, statistics(loops)) for top, loops in layers]


def slice_loops(piece):
    demand(piece.tag == SLICE + "slice", "no slice")
    if len(piece) == 0:
        return []
    vertices, *polygons = piece
    demand(vertices.tag == SLICE + "vertices" and polygons, "an odd slice")
    points = [(float(v.get("x")), float(v.get("y"))) for v in vertices]
    loops = []
    for polygon in polygons:
        demand(polygon.tag == SLICE + "polygon", "no polygon")
        indices = [int(polygon.get("startv"))]
        indices += [int(segment.get("v2")) for segment in polygon]
        demand(all(a != b for a, b in zip(indices, indices[1:])), "repeats")
        demand(all(0 <= i < len(points) for i in indices), "no such vertex")
        demand(indices[0] == indices[-1], "an open polygon")
        loops.append(open_loop([points[i] for i in indices]))
    return loops


def check_box_mesh(mesh, layers, bottom):
    """The box of all layers, its triangles counter-clockwise from outside."""
    points = [p for _, loops in layers for loop in loops for p in loop]
    sides = [(min(p[i] for p in points), max(p[i] for p in points))
             for i in (0, 1)] + [(bottom, layers[-1][0])]
    corners = [tuple(float(v.get(a)) for a in "xyz")
               for v in mesh.find(CORE + "vertices")]
    demand(len(set(corners)) == 8 and
           all(c[i] in sides[i] for c in corners for i in range(3)),
           "the mesh is not the box")
    triangles = [[int(t.get(v)) for v in ("v1", "v2", "v3")]
                 for t in mesh.find(CORE + "triangles")]
    edges = {(t[i], t[(i + 1) % 3]) for t in triangles for i in range(3)}
    demand(len(edges) == 36 and all((b, a) in edges for a, b in edges),
           "the box is not closed")
    volume = sum(
        sum(a[i] * (b[(i + 1) % 3] * c[(i + 2) % 3] -
                    b[(i + 2) % 3] * c[(i + 1) % 3]) for i in range(3)) / 6
        for a, b, c in ([corners[i] for i in t] for t in triangles))
    demand(math.isclose(volume, math.prod(b - a for a, b in sides),
                        rel_tol=1e-6), "the box is inside out")


def png_rows(png):
    """(bytes a pixel, rows of bytes) of a PNG whose rows are stored as they
    are: 8 bits of grey or of red, green and blue."""
    demand(png[:8] == b"\x89PNG\r\n\x1a\n", "no PNG")
    packed, place = b"", 8
    while place < len(png):
        size, = struct.unpack_from(">I", png, place)
        kind = png[place + 4:place + 8]
        body = png[place + 8:place + 8 + size]
        check, = struct.unpack_from(">I", png, place + 8 + size)
        demand(zlib.crc32(kind + body) == check, "a broken chunk")
        if kind == b"IHDR":
            width, height, *form = struct.unpack(">IIBBBBB", body)
            demand(form in ([8, 0, 0, 0, 0], [8, 2, 0, 0, 0]), "an odd PNG")
        elif kind == b"IDAT":
            packed += body
        place += 12 + size
    channels = 3 if form[1] == 2 else 1
    raw = zlib.decompress(packed)
    line = channels * width + 1
    demand(len(raw) == line * height, "pixels do not count up")
    rows = [raw[y * line:(y + 1) * line] for y in range(height)]
    demand(all(row[0] == 0 for row in rows), "a filtered row")
    return channels, [row[1:] for row in rows]


def grey_rows(png):
    channels, rows = png_rows(png)
    demand(channels == 1, "not grey")
    return rows


def image_statistics(rows, pixels, pixel_area):
    demand((len(rows[0]), len(rows)) == tuple(pixels), "not the panel's size")
    return 0, 0, sum(map(sum, rows)) / 255 * pixel_area, 0


def read_sl1(path):
    archive = zipfile.ZipFile(path)
    demand(archive.testzip() is None, "a broken entry")
    config = dict(line.split(" = ") for line in
                  archive.read("config.ini").decode().splitlines())
    thickness = float(config["layerHeight"])
    images = sorted(n for n in archive.namelist()
                    if n.endswith(".png") and not n.startswith("thumbnail/"))
    demand(images == [f"{config['jobDir']}{i:05}.png"
                      for i in range(len(images))], "images do not count up")
    return [((i + 1) * thickness,
             image_statistics(grey_rows(archive.read(name)), (1440, 2560), 0.04725 ** 2))
            for i, name in enumerate(images)]


def read_nanodlp(path):
    archive = zipfile.ZipFile(path)
    demand(archive.testzip() is None, "a broken entry")
    texts = {name: json.loads(archive.read(f"{name}.json")) for name in
             ("meta", "slicer", "plate", "profile", "info")}
    count = texts["plate"]["LayersCount"]
    demand(count == len(texts["info"]) == texts["slicer"]["LayerCount"] and
           set(archive.namelist()) == {f"{name}.json" for name in texts} |
           {f"{i + 1}.png" for i in range(count)}, "entries do not count up")
    demand(texts["meta"]["FormatVersion"] == 1 and
           not texts["meta"]["Profile"], "the meta text")
    slicer = texts["slicer"]
    pixels = slicer["PWidth"], slicer["PHeight"]
    pixel_area = slicer["XPixelSize"] * slicer["YPixelSize"]
    demand(texts["profile"]["Depth"] == slicer["Thickness"], "thicknesses")
    layers = []
    for i, info in enumerate(texts["info"]):
        _, rows = png_rows(archive.read(f"{i + 1}.png"))
        facts = image_statistics(rows, pixels, pixel_area)
        demand(abs(facts[2] - info["TotalSolidArea"]) <
               1e-3 * (1 + facts[2]), "the area told of a layer")
        check_pixel_box(rows, info)
        layers.append(((i + 1) * slicer["Thickness"] / 1000, facts))
    return layers


def check_pixel_box(rows, info):
    """What a layer covers lies in the box told of it, and fills it."""
    ys = [y for y, row in enumerate(rows) if any(row)]
    xs = [x for y in ys for x in (len(rows[y]) - len(rows[y].lstrip(b"\0")),
                                  len(rows[y].rstrip(b"\0")))]
    found = [min(xs), max(xs), ys[0], ys[-1] + 1] if ys else [0, 0, 0, 0]
    told = [info["MinX"], info["MaxX"], info["MinY"], info["MaxY"]]
    # A pixel that is covered by less than 1/510 is black.
    demand(all(0 <= sign * (b - a) <= 1 for a, b, sign in
               zip(found, told, (-1, 1, -1, 1))), f"box {told}, not {found}")
    smallest, largest = info["SmallestArea"], info["LargestArea"]
    demand(smallest <= largest and info["AreaCount"] * smallest - 1e-5 <=
           info["TotalSolidArea"] <= info["AreaCount"] * largest + 1e-5,
           "areas of regions")


def read_folder(path):
    with open(os.path.join(path, "index.json"), encoding="utf-8") as file:
        index = json.load(file)
    names = [layer["file"] for layer in index["layers"]]
    demand(sorted(os.listdir(path)) == sorted(names + ["index.json"]),
           "the folder does not hold what its index tells")
    layers = []
    for layer in index["layers"]:
        with open(os.path.join(path, layer["file"]), "rb") as file:
            layers.append((layer["z"] + index["layer_thickness"] / 2,
                           image_statistics(grey_rows(file.read()),
                                            index["pixels"],
                                            math.prod(index["pixel_mm"]))))
    return layers


READERS = {".slc": read_slc, ".cli": read_cli, ".svg": read_svg}


def read(path):
    """(height, statistics) of each layer."""
    suffix = path[path.rindex("."):]
    if suffix == ".sl1":
        return read_sl1(path)
    if suffix == ".png":
        return read_folder(path)
    if suffix in (".zip", ".nanodlp"):
        return read_nanodlp(path)
    if suffix == ".3mf":
        return read_3mf(path)
    demand(suffix in READERS, f"{path}: no format of this name")
    with open(path, "rb") as file:
        return [(height, statistics(loops))
                for height, loops in READERS[suffix](file.read())]


def statistics(loops):
    areas = [signed_area(loop) for loop in loops]
    perimeter = sum(math.dist(a, b) for loop in loops
                    for a, b in zip(loop, loop[1:] + loop[:1]))
    return len(loops), sum(a < 0 for a in areas), sum(areas), perimeter


def print_layers(layers):
    for height, (count, holes, area, perimeter) in layers:
        print(f"{height:.6f} {count} {holes} {area:.9g} {perimeter:.9g}")


def main():
    for path in sys.argv[1:]:
        print_layers(read(path))


if __name__ == "__main__":
    main()

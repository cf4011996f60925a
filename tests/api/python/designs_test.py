"""Designs: values, what is found in them, and that nothing is printed."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import lamina
import numpy as np

PROGRAM = os.environ["LAMINA_PROGRAM"]
EXAMPLES = Path(os.environ["LAMINA_SOURCE"]) / "examples"

FORM = """
/* [Size] */
// how wide
width = 0.5; // [0.25:0.25:3]
shape = "round"; // [round, square:Eckig]
is_open = true;
place = [1, 2]; // [0:10]
count = 5; // [10]
height = 3; // .5
name = "say \\"a\\"";
sides = 2; // [1:One, 2:Two]
module stop() {}
cube([width, 1, 1]);
echo(shape, is_open, place, name);
"""


def run(*words):
    return subprocess.run(
        [PROGRAM, *map(str, words)], check=True, capture_output=True, text=True
    ).stdout


class Designs(unittest.TestCase):
    def test_parameters_are_values_of_python(self):
        by_name = {p.name: p for p in lamina.Design.from_text(FORM).parameters}
        width = by_name["width"]
        self.assertEqual((width.value, width.minimum, width.step), (0.5, 0.25, 0.25))
        self.assertEqual((width.maximum, width.description), (3, "how wide"))
        self.assertEqual(width.group, "Size")
        self.assertEqual(by_name["shape"].choices, ("round", "square"))
        self.assertIs(by_name["is_open"].value, True)
        self.assertEqual(by_name["place"].value, [1, 2])
        self.assertEqual(by_name["count"].maximum, 10)
        self.assertEqual(by_name["height"].step, 0.5)
        self.assertEqual(by_name["name"].value, 'say "a"')
        self.assertEqual(by_name["sides"].choices, (1, 2))

    def test_values_change_the_design(self):
        design = lamina.Design.from_text(FORM)
        wide = design.with_(width=2.25)
        self.assertAlmostEqual(design.slice(heights=[0.5])[0].area, 0.5)
        self.assertAlmostEqual(wide.slice(heights=[0.5])[0].area, 2.25)
        # Values that are not named stay.
        both = wide.with_(shape="square")
        self.assertAlmostEqual(both.slice(heights=[0.5])[0].area, 2.25)
        self.assertEqual(
            {p.name: p.value for p in both.parameters}["shape"], "square"
        )

    def test_values_may_be_numbers_of_numpy_and_sequences(self):
        changed = lamina.Design.from_text(
            FORM,
            values={
                "width": np.float64(1.5),
                "is_open": np.bool_(False),
                "place": (3, np.int64(4)),
                "name": 'a "b" \\ c',
            },
        )
        self.assertAlmostEqual(changed.slice(heights=[0.5])[0].area, 1.5)
        self.assertEqual(
            changed.messages, ['ECHO: "round", false, [3, 4], "a "b" \\ c"\n']
        )

    def test_what_is_not_offered_is_refused(self):
        design = lamina.Design.from_text(FORM)
        for values in [
            {"width": 9},
            {"width": "wide"},
            {"shape": "oval"},
            {"is_open": 3},
            {"place": [1, 2, 3]},
            {"place": [1, 11]},
            {"widht": 1},
        ]:
            with self.subTest(values), self.assertRaises(lamina.Error):
                design.with_(**values)

    def test_echoes_and_warnings_are_messages(self):
        design = lamina.Design.from_text("echo(1); cube(unknown); cube(1);")
        self.assertEqual(design.messages[0], "ECHO: 1\n")
        self.assertIn("design.scad:1:15: warning: Ignoring", design.messages[1])

    def test_nothing_is_printed(self):
        script = (
            "import lamina\n"
            "d = lamina.Design.from_text('echo(1); cube(unknown); sphere(3);')\n"
            "d.slice(layer=0.1), d.check(layer=0.1), d.report(layer=0.1)\n"
            "try: lamina.Design.from_text('cube(')\n"
            "except lamina.Error: pass\n"
        )
        done = subprocess.run([sys.executable, "-c", script], capture_output=True)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, b"", b""))

    def test_findings_are_those_of_the_program(self):
        text = "cube(2); translate([5, 0, 3]) cube(2);"
        found = lamina.Design.from_text(text).check(layer=0.1)
        self.assertEqual([f.kind for f in found], ["loose part"])
        self.assertEqual((found[0].bottom, found[0].volume), (3.0, 8.0))
        self.assertTrue(found[0].source.startswith("design.scad:1:"))

    def test_thin_places_have_their_width(self):
        thin = lamina.Design.from_text("cube([5, 0.25, 2]);").thin_places(0.3)
        self.assertEqual([place.kind for place in thin], ["wall"])
        self.assertAlmostEqual(thin[0].width, 0.25)

    def test_supports_are_those_of_the_program(self):
        text = "translate([0, 0, 5]) cube([6, 6, 1]);"
        design = lamina.Design.from_text(text, supports="light", layer=0.1)
        self.assertTrue(design.supports)
        with tempfile.TemporaryDirectory() as folder:
            path, by_program = Path(folder) / "a.scad", Path(folder) / "a.slc"
            path.write_text(text)
            options = ["--supports=light", "--layer", "0.1", "--hollow", "0.4"]
            run(path, "-q", *options, "-o", by_program)
            by_package = Path(folder) / "b.slc"
            hollow = lamina.Design(path, supports="light", layer=0.1, hollow=0.4)
            hollow.write(by_package, layer=0.1)
            self.assertEqual(by_program.read_bytes(), by_package.read_bytes())
            self.assertTrue(all(s.tip > 0 for s in hollow.supports))

    def test_report_weighs_the_piece(self):
        report = lamina.Design.from_text(
            "cube(10);", material="bluecast-x10", metal="silver-925", prices=["2 EUR/g"]
        ).report(layer=0.1, min_feature=0.3)
        self.assertAlmostEqual(report["volume"], 1000, delta=1e-6)
        self.assertEqual((report["layers"], report["layer"]), (100, 0.1))
        np.testing.assert_allclose(report["size"], [10, 10, 10], atol=1e-9)
        grams = report["metal"]["grams"]
        self.assertAlmostEqual(grams, 10.36, delta=0.1)  # 1 cm³ of 925 silver
        self.assertAlmostEqual(report["metal"]["price"], 2 * grams)
        self.assertEqual((report["findings"], report["thinPlaces"]), ([], []))

    def test_inspect_reads_what_is_written(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "a.slc"
            lamina.Design.from_text("cube(4);").write(path, layer=0.5)
            found = lamina.inspect(path)
        self.assertEqual((found.format, len(found.layers)), ("SLC 2.0", 8))
        self.assertAlmostEqual(found.volume, 64, delta=1e-4)
        self.assertEqual(found.defects, 0)

    def test_page_shows_the_layers(self):
        page = lamina.Design.from_text("cube(4);").page(layer=0.5)
        self.assertTrue(page.html.startswith("<!DOCTYPE html>"))
        self.assertIn("srcdoc=", page._repr_html_())

    def test_texts_find_their_fonts(self):
        text = lamina.Design.from_text('linear_extrude(1) text("o");')
        self.assertEqual(len(text.slice(heights=[0.5])[0].loops), 2)

    def test_the_version_is_the_programs(self):
        self.assertIn(lamina.version, run("--version"))


if __name__ == "__main__":
    unittest.main()

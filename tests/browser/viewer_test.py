"""The page of `lamina view -o x.html`, as Chromium shows it.

usage: viewer_test.py LAMINA [unittest's arguments]
"""

import base64
import http.server
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import threading
import unittest

from browser import Browser

LAMINA = None
EXAMPLES = os.path.join(os.path.dirname(__file__), "..", "..", "examples")

LIGHT = {"solid": (217, 169, 64), "field": (255, 255, 253),
         "support": (143, 166, 191)}
DARK = {"solid": (210, 160, 58), "field": (29, 31, 35),
        "support": (125, 149, 176)}

# A plate with a round hole, off the middle, and a pin upon it.
PLATE = """
$fn = 48;
difference() {
  translate([10, 20, 1]) cube([10, 10, 1]);
  translate([17, 27, 0]) cylinder(r = 2, h = 3);
}
translate([11, 21, 1]) cube([0.25, 4, 2]);
"""

# A post, a ball in the air beside it, and a closed hollow.
FIGURE = """
$fn = 32;
difference() {
  cylinder(r = 4, h = 8);
  translate([0, 0, 4]) sphere(2);
}
for (x = [7, 10])
  translate([x, 0, 5]) sphere(1);
"""


# A cube in the air on a bar, which is half beside it where it is in it, and a
# post that touches nothing.
HELD = """
module support_of() {
  translate([5, 2, 0]) cube([2, 2, 4.5]);
  translate([10, 2, 0]) cube([1, 1, 8]);
}
translate([0, 0, 4]) cube(6);
support_of();
"""


# A gear of 24 teeth, turned by 60 degrees over its height, with a bore.
GEAR = """
difference() {
  linear_extrude(20, twist = 60, slices = 200)
    polygon([for (i = [0 : 479]) let (r = 10 + sin(i * 18))
      r * [cos(i * .75), sin(i * .75)]]);
  translate([0, 0, -1]) cylinder(r = 4, h = 30, $fn = 90);
}
"""


def lamina(*arguments, status=0):
    result = subprocess.run([LAMINA, *arguments], capture_output=True,
                            text=True, check=False)
    if result.returncode != status:
        raise AssertionError(f"{arguments}: {result.stderr}")
    return result.stdout


def inspected_layers(path):
    """The lines of `inspect --all`: z, loops, holes, vertices, area, perimeter.
    """
    lines = lamina("inspect", path, "--all").splitlines()
    begin = next(i for i, line in enumerate(lines) if "perimeter mm" in line)
    names = [name for name in lines[begin].split()
             if name not in ("mm", "mm²")]
    wanted = ["z", "loops", "holes", "vertices", "area", "perimeter"]
    rows = []
    for line in lines[begin + 1:]:
        if not line.strip():
            break
        values = dict(zip(names, line.split(), strict=True))
        rows.append([float(values[name]) for name in wanted])
    return rows


class ViewerTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.browser = Browser(1100, 560)
        with open(cls.path("plate.scad"), "w", encoding="utf-8") as file:
            file.write(PLATE)
        lamina(cls.path("plate.scad"), "--layer", "0.1")
        lamina("view", cls.path("plate.slc"), "-o", cls.path("plate.html"),
               "--min-feature", "0.4")

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.folder.cleanup()

    @classmethod
    def path(cls, name):
        return os.path.join(cls.folder.name, name)

    def open(self, name, state="theme=light&layer=1&view=layer"):
        self.browser.open(f"file://{self.path(name)}#{state}")

    def is_hidden(self, element):
        return self.browser.evaluate(
            f"document.getElementById('{element}').hidden")

    def tearDown(self):
        self.assertEqual(self.browser.faults, [])

    def on_page(self, x, y):
        """Where a place in mm is on the page."""
        left, top, _, _ = self.browser.place_of("drawing")
        px, py = self.browser.evaluate(
            f"viewer.view.toPage([{x} - viewer.part.low[0],"
            f" {y} - viewer.part.low[1]])")
        return left + px, top + py

    def test_numbers_are_those_of_inspect(self):
        self.open("plate.html")
        rows = inspected_layers(self.path("plate.slc"))
        self.assertEqual(len(rows), 20)
        # A file tells where layers begin, the page where their sections are,
        # above the bed.
        half_layer = 0.05
        bed = rows[0][0]
        for number, (z, loops, holes, vertices, area, perimeter) in enumerate(
                rows, 1):
            self.assertEqual(self.browser.text("number"),
                             f"{number} of {len(rows)}")
            self.assertAlmostEqual(
                float(self.browser.text("height").split()[0]),
                z - bed + half_layer, delta=5e-4)
            counts = [int(n) for n in
                      re.findall(r"\d+", self.browser.text("loops"))]
            self.assertEqual(counts, [loops, holes] if holes else [loops])
            self.assertAlmostEqual(
                float(self.browser.text("area").split()[0]), area, delta=6e-5)
            self.assertAlmostEqual(
                float(self.browser.text("perimeter").split()[0]), perimeter,
                delta=6e-4)
            self.assertEqual(
                self.browser.evaluate("viewer.part.layers[viewer.state.index]"
                                      ".vertices"), vertices)
            self.browser.press("ArrowUp")

    def test_contours_are_those_of_the_layers(self):
        lamina(os.path.join(EXAMPLES, "solitaire.scad"), "--layer", "0.05",
               "-o", self.path("ring.slc"))
        lamina("view", self.path("ring.slc"), "-o", self.path("ring.html"))
        self.assertLess(os.path.getsize(self.path("ring.html")), 400_000)
        self.open("ring.html")
        rows = inspected_layers(self.path("ring.slc"))
        drawn = self.browser.evaluate("""viewer.part.layers.map((layer) =>
          layer.contours.map((loop) => {
            let area = 0;
            for (let i = 0; i < loop.length; i += 2) {
              const j = (i + 2) % loop.length;
              area += loop[i] * loop[j + 1] - loop[j] * loop[i + 1];
            }
            return area / 2;
          }))""")
        self.assertEqual(len(drawn), len(rows))
        for areas, (_, loops, holes, _, area, perimeter) in zip(drawn, rows):
            self.assertEqual(len(areas), loops)
            self.assertEqual(sum(1 for a in areas if a < 0), holes)
            # Corners are rounded to 1e-4 mm.
            self.assertAlmostEqual(sum(areas), area, delta=1e-4 * perimeter)

    def test_the_section_is_drawn_where_it_is(self):
        for theme, colors in ("light", LIGHT), ("dark", DARK):
            self.open("plate.html", f"theme={theme}&layer=5&view=layer")
            picture = self.browser.screenshot()
            for place, name in [((12.3, 28.3), "solid"), ((19.8, 20.2), "solid"),
                                ((17.3, 27.3), "field"), ((18.2, 26.3), "field"),
                                ((20.3, 25.3), "field"), ((9.7, 25.3), "field")]:
                self.assertEqual(picture.at(*self.on_page(*place)),
                                 colors[name], (theme, place))
        # Above the plate only the pin is left.
        self.open("plate.html", "theme=light&layer=15&view=layer")
        picture = self.browser.screenshot()
        self.assertEqual(picture.at(*self.on_page(12.3, 28.3)), LIGHT["field"])

    def test_keys_wheel_and_slider_choose_layers(self):
        self.open("plate.html")
        number = lambda: int(self.browser.text("number").split()[0])
        for key, expected in [("ArrowRight", 2), ("PageUp", 12), ("End", 20),
                              ("ArrowUp", 20), ("ArrowDown", 19), ("Home", 1)]:
            self.browser.press(key)
            self.assertEqual(number(), expected, key)
        left, top, width, height = self.browser.place_of("slider")
        self.browser.wheel(left + 50, top + 20, -100)
        self.assertEqual(number(), 2)
        self.browser.wheel(left + 50, top + 20, 100)
        self.assertEqual(number(), 1)
        self.browser.click(left + width - 1, top + height / 2)
        self.assertEqual(number(), 20)
        self.browser.click(left + width / 2, top + height / 2)
        self.assertIn(number(), (10, 11))
        self.assertIn(f"Layer {number()} of 20", self.browser.evaluate(
            "document.getElementById('slider').ariaValueText"))

    def test_playing_ends_at_the_top(self):
        self.open("plate.html", "layer=18")
        self.browser.press(" ")
        self.browser.evaluate("""new Promise((resolve) => {
          const look = () => viewer.isPlaying ? setTimeout(look, 20) : resolve();
          look();
        })""")
        self.assertEqual(self.browser.text("number"), "20 of 20")

    def test_the_wheel_zooms_around_the_pointer_and_dragging_moves(self):
        self.open("plate.html")
        x, y = self.on_page(13, 23)
        scale = self.browser.evaluate("viewer.view.scale")
        self.browser.wheel(x, y, -300)
        self.assertGreater(self.browser.evaluate("viewer.view.scale"),
                           1.3 * scale)
        after = self.on_page(13, 23)
        self.assertAlmostEqual(after[0], x, delta=1)
        self.assertAlmostEqual(after[1], y, delta=1)
        self.browser.drag((x, y), (x + 80, y - 40))
        after = self.on_page(13, 23)
        self.assertAlmostEqual(after[0], x + 80, delta=1)
        self.assertAlmostEqual(after[1], y - 40, delta=1)
        self.browser.press("f")
        self.assertAlmostEqual(self.browser.evaluate("viewer.view.scale"),
                               scale)

    def test_two_clicks_measure(self):
        self.open("plate.html", "layer=1")
        self.browser.press("m")
        for place in (10, 20), (20, 30):
            x, y = self.on_page(*place)
            # Corners attract.
            self.browser.click(x + 3, y - 2)
        self.assertIn("14.142 mm", self.browser.text("distance"))
        # From layer to layer it is a distance in space.
        self.browser.click(*self.on_page(10, 20))
        self.browser.press("PageUp")
        self.browser.click(*self.on_page(11.25, 25))
        self.assertIn(f"{(1.25**2 + 25 + 1)**.5:.3f} mm",
                      self.browser.text("distance"))
        self.browser.press("Escape")
        self.assertTrue(self.browser.evaluate(
            "document.getElementById('distance').hidden"))

    def test_thin_places_are_those_of_inspect(self):
        self.open("plate.html", "theme=light&layer=1")
        table = lamina("inspect", self.path("plate.slc"), "--min-feature",
                       "0.4").split("thinner than")[1]
        self.assertIn("1 wall", table)
        listed = self.browser.text("findings")
        self.assertIn("1 wall thinner than 0.4 mm", listed)
        self.assertIn("0.250 mm", listed)
        self.assertIn("11–20", listed)
        self.browser.evaluate(
            "[...document.querySelectorAll('#findings button')].at(-1).click()")
        number = int(self.browser.text("number").split()[0])
        self.assertGreaterEqual(number, 11)
        picture = self.browser.screenshot()
        self.assertEqual(picture.at(*self.on_page(11.125, 23)), (200, 16, 46))
        self.browser.press("t")
        picture = self.browser.screenshot()
        self.assertEqual(picture.at(*self.on_page(11.125, 23)), LIGHT["solid"])

    def test_thin_places_of_a_design_name_what_made_them(self):
        lamina("view", self.path("plate.scad"), "--layer", "0.1", "-o",
               self.path("design.html"), "--min-feature", "0.4")
        self.open("design.html")
        self.assertIn("0.250 mm", self.browser.text("findings"))
        # The pin's line.
        self.assertIn("plate.scad:7:", self.browser.text("findings"))

    def make_figure(self):
        with open(self.path("figure.scad"), "w", encoding="utf-8") as file:
            file.write(FIGURE)
        lamina("view", self.path("figure.scad"), "--layer", "0.1", "-o",
               self.path("figure.html"))

    def test_findings_are_those_of_check_by_kind_and_line(self):
        self.make_figure()
        checked = lamina("check", self.path("figure.scad"), "--layer", "0.1",
                         status=1)
        counts = re.search("print: (.*)", checked)[1].split(" (")[0]
        self.assertIn("2 loose parts", counts)
        self.assertIn("1 resin trap", counts)
        self.open("figure.html")
        headings = self.browser.evaluate(
            "[...document.querySelectorAll('#findings h3')]"
            ".map((heading) => heading.textContent)")
        self.assertEqual(headings, counts.split(", "))
        # One line made both balls.
        self.assertEqual(self.browser.text("findings").count("figure.scad:8:"),
                         len([h for h in headings if "trap" not in h]))
        # A place leads to its layer, and is marked there.
        self.browser.evaluate(
            "[...document.querySelectorAll('#findings button')].at(-1).click()")
        found = self.browser.evaluate("viewer.part.found.places.at(-1)")
        self.assertEqual(found["kind"], "resin trap")
        self.assertEqual(
            int(self.browser.text("number").split()[0]), found["layer"])
        x, y = self.on_page(0, 0)
        at = self.browser.evaluate(
            "viewer.view.toPage(viewer.part.found.places.at(-1).place)")
        left, top, _, _ = self.browser.place_of("drawing")
        picture = self.browser.screenshot()
        self.assertEqual(picture.at(left + at[0], top + at[1]),
                         (107, 74, 43))
        self.assertLess(abs(left + at[0] - x) + abs(top + at[1] - y), 600)
        # The slider shows where it begins and ends.
        self.assertTrue(self.browser.evaluate("""(() => {
          const {first, last} = viewer.part.found.places.at(-1);
          return first >= 20 && last <= 60;
        })()"""))

    def test_a_part_with_nothing_wrong_says_so(self):
        with open(self.path("cube.scad"), "w", encoding="utf-8") as file:
            file.write("cube(2);")
        lamina("view", self.path("cube.scad"), "-o", self.path("cube.html"))
        self.open("cube.html")
        self.assertIn("No problems found", self.browser.text("findings"))

    def test_it_says_what_the_print_takes(self):
        lamina("view", self.path("plate.slc"), "-o", self.path("takes.html"),
               "--printer", "prusa-sl1", "--material", "bluecast-x10")
        self.open("takes.html")
        self.assertIn("0.0", self.browser.text("summary"))
        self.assertIn("ml of BlueCast X10", self.browser.text("summary"))
        self.assertIn("min on", self.browser.text("summary"))

    def test_it_opens_on_the_whole_solid_beside_the_layer(self):
        self.open("plate.html", "theme=light")
        self.assertFalse(self.is_hidden("solid-pane"))
        self.assertFalse(self.is_hidden("drawing-pane"))
        self.assertTrue(self.browser.evaluate("viewer.isWhole"))
        solid = self.browser.place_of("solid")
        drawing = self.browser.place_of("drawing")
        self.assertLessEqual(solid[0] + solid[2], drawing[0] + 1)
        # The first layer chosen cuts it; each pane may go, but not both.
        self.browser.press("ArrowUp")
        self.assertFalse(self.browser.evaluate("viewer.isWhole"))
        self.browser.press("s")
        self.assertTrue(self.is_hidden("solid-pane"))
        self.browser.press("l")
        self.assertTrue(self.is_hidden("drawing-pane"))
        self.assertFalse(self.is_hidden("solid-pane"))

    def test_without_webgl_it_says_why_there_is_no_solid(self):
        with open(self.path("plate.html"), encoding="utf-8") as file:
            page = file.read()
        with open(self.path("no3d.html"), "w", encoding="utf-8") as file:
            file.write(page.replace('getContext("webgl2"', 'getContext("none"'))
        self.open("no3d.html", "theme=light")
        self.assertFalse(self.is_hidden("no-solid"))
        self.assertIn("no WebGL", self.browser.text("no-solid"))
        self.assertTrue(self.is_hidden("solid"))

    def test_the_solid_is_cut_at_the_layer_and_turns(self):
        self.open("plate.html", "theme=light&layer=5&view=3d")
        left, top, width, height = self.browser.place_of("solid")

        def golden_pixels():
            picture = self.browser.screenshot()
            pixels = [picture.at(x, y)
                      for y in range(int(top), int(top + height), 7)
                      for x in range(int(left), int(left + width), 7)]
            return [p for p in pixels if p[0] > p[2] + 60]

        # The section is of one colour, the sides of many.
        pixels = golden_pixels()
        section = max(set(pixels), key=pixels.count)
        self.assertGreater(pixels.count(section), 200)
        self.assertGreater(len(pixels), 1.1 * pixels.count(section))
        # From below there is no section.
        middle = (left + width / 2, top + height / 2)
        self.browser.drag(middle, (middle[0], middle[1] - 150))
        self.browser.settle()
        self.assertEqual(golden_pixels().count(section), 0)
        self.browser.press("s")
        self.assertTrue(self.is_hidden("solid-pane"))

    def make_gear(self):
        with open(self.path("gear.scad"), "w", encoding="utf-8") as file:
            file.write(GEAR)
        lamina("view", self.path("gear.scad"), "--layer", "0.1", "-o",
               self.path("gear.html"))

    def test_a_large_solid_is_drawn_roughly_first_and_then_in_full(self):
        self.make_gear()
        with open(self.path("gear.html"), encoding="utf-8") as file:
            page = file.read()
        # Notes each solid when it is drawn, and whether the word is there.
        with open(self.path("noted.html"), "w", encoding="utf-8") as file:
            file.write(page.replace(
                "this.solid.show(this.part, () => this.draw())",
                "this.solid.show(this.part, () => { (window.noted ||= []).push("
                "[this.solid.bodies[0].mesh.quads.count,"
                " this.solid.bodies[0].mesh.layers.length,"
                " byId('working').hidden]); this.draw(); })"))
        self.open("noted.html", "theme=light")
        (rough, few, *_), (full, many, *_) = self.browser.evaluate("noted")
        self.assertLess(3 * rough, full)
        self.assertLess(few, many)
        self.assertEqual([hidden for *_, hidden in
                          self.browser.evaluate("noted")], [False, False])
        self.assertTrue(self.is_hidden("working"))

    def test_a_solid_takes_few_looks_for_each_corner(self):
        self.make_gear()
        self.open("gear.html", "theme=light")
        counts = self.browser.evaluate("""(() => {
          const count = {walls: 0, places: 0, edges: 0, steps: 0};
          const {at, look} = Depths.prototype;
          Depths.prototype.at = function(x, y) {
            ++count.places;
            return at.call(this, x, y);
          };
          Depths.prototype.look = function(cell, x, y) {
            count.edges += this.begins[cell + 1] - this.begins[cell];
            return look.call(this, cell, x, y);
          };
          const mesh = new PlateMesh(viewer.part, kFull);
          const edgesAt = mesh.edgesAt;
          mesh.edgesAt = (i) => {
            const edges = edgesAt.call(mesh, i);
            count.walls += edges.length;
            return edges;
          };
          for (const _ of mesh.build()) ++count.steps;
          count.layers = mesh.layers.length;
          count.quads = mesh.quads.count;
          Object.assign(Depths.prototype, {at, look});
          return count;
        })()""")
        self.assertEqual(counts["places"], 2 * counts["walls"])
        self.assertLess(counts["edges"], 25 * counts["places"])
        # A side of each edge, and at most two levels for its ends.
        self.assertLess(counts["quads"], 5 * counts["walls"])
        # The page gets its turn after each layer.
        self.assertEqual(counts["steps"], counts["layers"])

    def test_depths_are_those_of_all_edges(self):
        self.open("plate.html", "theme=light")
        worst = self.browser.evaluate("""(() => {
          // A star with a hole, by distances to all edges and by the winding.
          const ring = (count, radius, turn) => Float64Array.from(
              {length: 2 * count}, (_, i) => {
                const k = i >> 1;
                const angle = turn * 2 * Math.PI * k / count;
                return 12 + (i % 2 ? Math.sin(angle) : Math.cos(angle)) * radius(k);
              });
          const loops = [ring(34, (k) => k % 2 ? 5 : 11, 1), ring(40, () => 2, -1)];
          const reach = 3;
          const depths = new Depths(loops, reach);
          const brute = (x, y) => {
            let [nearest, isInside] = [Infinity, false];
            for (const loop of loops) {
              for (let i = 0, j = loop.length - 2; i < loop.length; j = i, i += 2) {
                const [ax, ay, bx, by] = [loop[j], loop[j + 1], loop[i], loop[i + 1]];
                const t = Math.min(1, Math.max(0, ((x - ax) * (bx - ax) +
                    (y - ay) * (by - ay)) / ((bx - ax) ** 2 + (by - ay) ** 2)));
                nearest = Math.min(nearest, Math.hypot(
                    x - ax - t * (bx - ax), y - ay - t * (by - ay)));
                if ((ay > y) !== (by > y) &&
                    x < ax + (y - ay) * (bx - ax) / (by - ay)) isInside = !isInside;
              }
            }
            return Math.min(reach, nearest) * (isInside ? 1 : -1);
          };
          let worst = 0;
          for (let x = -5.03; x < 30; x += .37) {
            for (let y = -5.07; y < 30; y += .41) {
              worst = Math.max(worst, Math.abs(brute(x, y) - depths.at(x, y)));
            }
          }
          return worst;
        })()""")
        self.assertLess(worst, 1e-9)

    def test_levels_cover_what_one_of_two_layers_has(self):
        self.make_figure()
        self.open("figure.html", "theme=light")
        worst = self.browser.evaluate("""(() => {
          const mesh = new PlateMesh(viewer.part, {finest: 0, corners: 1e9});
          const areaOf = (below, above) => {
            let area = 0;
            const at = (edge, y) =>
              edge.x + (edge.x1 - edge.x) * (y - edge.y) / (edge.y1 - edge.y);
            sweep(below, above, 0, (left, right, y0, y1) => {
              area += (at(right, y0) - at(left, y0) + at(right, y1) - at(left, y1)) / 2 *
                (y1 - y0);
            });
            return area;
          };
          // Where one layer lies within the next, areas differ by the level's.
          let worst = 0;
          viewer.part.layers.forEach((layer, i) => {
            const edges = mesh.edgesAt(i);
            worst = Math.max(worst, Math.abs(areaOf(edges, []) - layer.area),
                areaOf(edges, mesh.edgesAt(i)));
          });
          return worst;
        })()""")
        # Corners are rounded to 1e-4 mm.
        self.assertLess(worst, 1e-4 * 2 * 3.1416 * 8)

    def make_held(self):
        with open(self.path("held.scad"), "w", encoding="utf-8") as file:
            file.write(HELD)
        lamina("view", self.path("held.scad"), "--layer", "0.25", "-o",
               self.path("held.html"))

    def test_supports_are_hidden_and_measured_apart(self):
        self.make_held()
        # Layers 17 and 18 have the bar in the cube.
        for theme, colors in ("light", LIGHT), ("dark", DARK):
            self.open("held.html", f"theme={theme}&layer=18&view=layer")
            self.assertFalse(self.is_hidden("supports"))
            for shows in (True, False, True):
                support = colors["support" if shows else "field"]
                picture = self.browser.screenshot()
                for place, expected in [
                        ((3.3, 3.3), colors["solid"]),
                        ((5.5, 3.3), colors["solid"]), ((6.5, 3.3), support),
                        ((10.5, 2.6), support), ((8.3, 3.3), colors["field"])]:
                    self.assertEqual(picture.at(*self.on_page(*place)),
                                     expected, (theme, shows, place))
                self.assertEqual(self.browser.text("area"),
                                 "39.0000 mm²" if shows else "36.0000 mm²")
                self.assertEqual(self.browser.text("loops"),
                                 "2" if shows else "1")
                self.assertIn("241.00 mm³" if shows else "216.00 mm³",
                              self.browser.text("summary"))
                self.assertEqual(self.browser.evaluate(
                    "document.getElementById('supports').ariaPressed"),
                    "true" if shows else "false")
                self.browser.press("u")
        measured = re.search(r"supports +(.*touch the part.*)", lamina(
            "inspect", self.path("held.scad"), "--layer", "0.25"))[1]
        self.assertIn(measured, self.browser.text("summary"))

    def test_every_layer_has_the_loops_of_its_part_and_of_its_supports(self):
        self.make_held()
        self.open("held.html")
        layers = self.browser.evaluate("""(() => {
          const areaOf = (contours) => contours.reduce((sum, loop) => {
            for (let i = 0; i < loop.length; i += 2) {
              const j = (i + 2) % loop.length;
              sum += (loop[i] * loop[j + 1] - loop[j] * loop[i + 1]) / 2;
            }
            return sum;
          }, 0);
          const {layers, partLayers, supports} = viewer.part;
          return layers.map((layer, i) => [layer.z,
            areaOf(layer.contours), areaOf(partLayers[i].contours),
            areaOf(supports.layers[i].contours), partLayers[i].area]);
        })()""")
        self.assertEqual(len(layers), 40)
        for z, whole, part, supports, told in layers:
            bar, post = 4 * (z < 4.5), 1 * (z < 8)
            self.assertAlmostEqual(part, 36 * (z > 4), places=6)
            self.assertAlmostEqual(told, part, places=6)
            self.assertAlmostEqual(supports, bar + post, places=6)
            self.assertAlmostEqual(
                whole, part + supports - (2 if 4 < z < 4.5 else 0), places=6)

    def test_supports_of_the_solid_are_hidden(self):
        self.make_held()
        for state in ("theme=light&view=3d", "theme=light&layer=18&view=3d"):
            self.open("held.html", state)
            left, top, width, height = self.browser.place_of("solid")

            def count():
                picture = self.browser.screenshot()
                pixels = [picture.at(x, y)
                          for y in range(int(top), int(top + height), 3)
                          for x in range(int(left), int(left + width), 3)]
                return (sum(1 for p in pixels if p[2] > p[0] + 15),
                        sum(1 for p in pixels if p[0] > p[2] + 60))

            blue, golden = count()
            self.assertGreater(blue, 300)
            self.assertGreater(golden, 1000)
            self.browser.press("u")
            self.browser.settle()
            without = count()
            self.assertEqual(without[0], 0)
            # The bar and the post have hidden some of the cube.
            self.assertGreaterEqual(without[1], golden)

    def test_without_supports_nothing_speaks_of_them(self):
        self.open("plate.html")
        self.assertTrue(self.is_hidden("supports"))
        self.browser.press("?")
        self.assertNotIn("supports", self.browser.evaluate(
            "document.getElementById('keys').innerText"))
        self.browser.press("?")
        area = self.browser.text("area")
        self.browser.press("u")
        self.assertEqual(self.browser.text("area"), area)
        with open(self.path("plate.html"), encoding="utf-8") as file:
            facts = re.search('id="facts">(.*)</script>', file.read())[1]
        self.assertNotIn("supports", facts)

    def test_colors_of_the_design_show_on_the_solid(self):
        with open(self.path("colored.scad"), "w", encoding="utf-8") as file:
            file.write("""difference() {
                color("lime") cube([10, 10, 4]);
                translate([2, 2, 2]) cube([6, 6, 3]);
              }
              color("red") translate([14, 0, 0]) cube([6, 10, 4]);
              translate([0, 14, 0]) cube([20, 5, 4]);""")
        lamina("view", self.path("colored.scad"), "-o",
               self.path("colored.html"))
        for state in ("theme=light&view=3d", "theme=light&layer=5&view=3d"):
            self.open("colored.html", state)
            left, top, width, height = self.browser.place_of("solid")
            picture = self.browser.screenshot()
            counts = {"red": 0, "lime": 0, "gold": 0}
            for y in range(int(top), int(top + height), 3):
                for x in range(int(left), int(left + width), 3):
                    red, green, blue = picture.at(x, y)[:3]
                    if red > 2 * green + 40:
                        counts["red"] += 1
                    elif green > 2 * red + 40:
                        counts["lime"] += 1
                    elif red > blue + 60:
                        counts["gold"] += 1
            for color, count in counts.items():
                self.assertGreater(count, 300, f"{color} in {state}")

    def test_a_finding_is_turned_to(self):
        self.make_figure()
        self.open("figure.html", "theme=light")
        for index in (0, -1):
            # From below, and from behind.
            self.browser.evaluate("viewer.solid.yaw = 2; viewer.solid.pitch = -1.2")
            self.browser.evaluate(
                f"[...document.querySelectorAll('#findings button')].at({index})"
                ".click()")
            self.browser.settle()
            towards = self.browser.evaluate(f"""(() => {{
              const {{yaw, pitch}} = viewer.solid;
              const [x, y] = viewer.part.found.places.at({index}).place;
              return [-Math.sin(yaw) * (x - viewer.part.size[0] / 2) -
                Math.cos(yaw) * (y - viewer.part.size[1] / 2), pitch,
                Math.hypot(x - viewer.part.size[0] / 2, y - viewer.part.size[1] / 2)];
            }})()""")
            self.assertAlmostEqual(towards[0], towards[2], delta=1e-9)
            self.assertGreater(towards[1], 0)
            self.assertFalse(self.browser.evaluate("viewer.isWhole"))

    def test_files_are_named_from_the_folder_of_the_design(self):
        os.makedirs(self.path("far/project/parts"), exist_ok=True)
        os.makedirs(self.path("far/off"), exist_ok=True)
        ball = "module ball(x) translate([x, 0, 5]) sphere(1);\n"
        for name in ("far/project/parts/ball.scad", "far/off/other.scad"):
            with open(self.path(name), "w", encoding="utf-8") as file:
                file.write(ball.replace("ball(", os.path.basename(name)[:4] + "("))
        with open(self.path("far/project/main.scad"), "w",
                  encoding="utf-8") as file:
            file.write("use <parts/ball.scad>\nuse <../off/other.scad>\n"
                       "cube([4, 4, 8]);\nball(8);\nothe(12);\n")
        lamina("view", self.path("far/project/main.scad"), "-o",
               self.path("far.html"))
        self.open("far.html")
        listed = self.browser.text("findings")
        self.assertIn("parts/ball.scad:1:37 from main.scad:4:1", listed)
        self.assertIn("../off/other.scad:1:37 from main.scad:5:1", listed)
        with open(self.path("far.html"), encoding="utf-8") as file:
            self.assertNotIn(self.folder.name, file.read())

    def test_the_sheet_of_keys_opens_and_closes(self):
        self.open("plate.html")
        is_open = "document.getElementById('keys').open"
        self.browser.press("?")
        self.assertTrue(self.browser.evaluate(is_open))
        # Other keys wait.
        self.browser.press("ArrowUp")
        self.assertEqual(self.browser.text("number"), "1 of 20")
        self.browser.press("?")
        self.assertFalse(self.browser.evaluate(is_open))

    def test_heights_have_three_digits_and_nothing_is_minus_zero(self):
        self.open("plate.html")
        self.assertEqual(self.browser.text("height"), "0.050 mm")
        self.assertEqual(self.browser.evaluate(
            "[fixed(-1e-9, 4), fixed(-0, 2), fixed(-.25, 1), fixed(3, 0)]"),
            ["0.0000", "0.00", "-0.3", "3"])

    def test_it_fits_small_windows(self):
        for width, height in ((640, 480), (390, 844), (844, 390), (320, 568),
                              (200, 160)):
            small = Browser(width, height, is_phone=True)
            try:
                for state in ("", "#layer=5&view=layer", "#layer=5&view=3d"):
                    small.open(f"file://{self.path('plate.html')}{state}")
                    self.assertEqual(small.faults, [])
                    if width < 320:
                        continue
                    self.assertLessEqual(small.evaluate(
                        "document.documentElement.scrollWidth"), width)
                    for element in ("slider", "readout", "play", "help"):
                        x, y, w, h = small.place_of(element)
                        self.assertGreaterEqual(min(x, y), 0)
                        self.assertLessEqual(x + w, width)
                        self.assertLessEqual(y + h, height)
                    self.assertGreater(small.place_of("slider")[2], 200)
                    self.assertGreaterEqual(small.place_of("slider")[3], 36)
                    panes = [small.place_of(pane)
                             for pane in ("solid-pane", "drawing-pane")]
                    for _, _, w, h in panes:
                        self.assertTrue(h == 0 or (w > 150 and h > 150))
            finally:
                small.close()

    def test_the_page_asks_for_nothing(self):
        self.open("plate.html")
        self.assertEqual([url for url in self.browser.requests
                          if not url.startswith(("file:", "data:"))], [])
        self.assertEqual(len([url for url in self.browser.requests
                              if url.startswith("file:")]), 1)

    # ---- Measuring

    def target(self, x, y, pixels=(0, 0)):
        """What a click beside a place in mm would take."""
        px, py = self.on_page(x, y)
        self.browser.move(px + pixels[0], py + pixels[1])
        return self.browser.evaluate("viewer.measuring.target")

    def test_measuring_snaps_to_ends_centres_middles_and_edges(self):
        self.open("plate.html", "theme=light&layer=3")
        self.browser.press("m")
        corners = [(17 + 2 * math.cos(i * math.pi / 24),
                    27 + 2 * math.sin(i * math.pi / 24)) for i in range(48)]
        for place, pixels, kind, expected, radius in [
                ((10, 20), (3, -4), "end", (10, 20), None),
                (corners[5], (1, 1), "end", corners[5], 2),
                ((17, 27), (-5, 3), "centre", (17, 27), 2),
                ((15, 20), (4, -5), "middle", (15, 20), None),
                ((20, 25), (-5, 4), "middle", (20, 25), None),
                ((12.7, 20), (0, 6), "edge", (12.7, 20), None),
                ((18, 22), (0, 0), "free", (18, 22), None)]:
            [found] = self.target(*place, pixels)
            self.assertEqual(found["kind"], kind, place)
            x, y, z = found["at"]
            # Corners are rounded to 1e-4 mm; the pointer to a pixel.
            slack = .04 if kind == "free" else 1e-4
            self.assertAlmostEqual(x, expected[0], delta=slack)
            self.assertAlmostEqual(y, expected[1], delta=slack)
            # Heights of a file have 32 bits.
            self.assertAlmostEqual(z, .25, delta=1e-6)
            if radius:
                self.assertAlmostEqual(found["circle"]["radius"], radius,
                                       delta=1e-4)
            else:
                self.assertIsNone(found["circle"])
        # From the hole's centre to the plate's corner.
        self.browser.click(*self.on_page(17, 27))
        self.assertIn("R 2.000 ⌀ 4.000", self.browser.text("distance"))
        self.browser.click(*self.on_page(10, 20))
        told = self.browser.text("distance")
        for text in (f"{98**.5:.3f} mm", "Δx -7.000", "Δy -7.000",
                     "∠ -135.00°", "R 2.000 ⌀ 4.000"):
            self.assertIn(text, told)
        self.assertNotIn("Δz", told)

    def test_what_a_click_takes_is_shown(self):
        for theme, rgb in ("light", (11, 122, 91)), ("dark", (79, 214, 171)):
            self.open("plate.html", f"theme={theme}&layer=3&view=layer")
            self.browser.press("m")
            self.target(20, 20, (2, 2))
            x, y = self.on_page(20, 20)
            picture = self.browser.screenshot()
            for dx, dy in ((-5.5, 0), (5.5, 0), (0, -5.5), (0, 5.5)):
                self.assertEqual(picture.at(x + dx, y + dy), rgb)
            self.browser.press("Escape")
            self.browser.settle()
            self.assertNotEqual(self.browser.screenshot().at(x + 5.5, y), rgb)

    def test_walls_and_gaps_are_as_thick_as_they_are(self):
        thickness, gap, turn = .8, 1.3, 30
        with open(self.path("walls.scad"), "w", encoding="utf-8") as file:
            file.write(f"""rotate({turn}) for (i = [0, 1])
              translate([0, i * {thickness + gap}, 0])
                cube([12, {thickness}, 1]);""")
        lamina("view", self.path("walls.scad"), "--layer", "0.1", "-o",
               self.path("walls.html"))
        self.open("walls.html", "theme=light&layer=3&view=layer")
        self.browser.press("w")
        c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
        for along in (3, 5.3, 8.9):
            for across, kind, length in [
                    (.3 * thickness, "wall", thickness),
                    (thickness + .6 * gap, "gap", gap),
                    (thickness + gap + .5, "wall", thickness)]:
                ends = self.target(c * along - s * across,
                                   s * along + c * across)
                self.assertEqual([end["kind"] for end in ends], [kind] * 2)
                dx, dy, dz = (b - a for a, b in zip(ends[0]["at"],
                                                    ends[1]["at"]))
                # Faces are rounded to 1e-4 mm.
                self.assertAlmostEqual(math.hypot(dx, dy), length, delta=2e-4)
                self.assertAlmostEqual(abs(-s * dx + c * dy), length,
                                       delta=2e-4)
                self.assertEqual(dz, 0)
                # A click keeps it.
                px, py = self.on_page(c * along - s * across,
                                      s * along + c * across)
                self.browser.click(px, py)
                self.assertIn(f"{kind} {length:.3f} mm",
                              self.browser.text("distance"))
        # Beside the part there is neither.
        self.assertEqual(self.target(-1, -1), [])
        self.browser.click(*self.on_page(-1, -1))
        self.assertIn("No wall and no gap", self.browser.text("distance"))

    def test_chords_are_the_shortest_ones(self):
        found = self.evaluate_on_plate("""
          const ring = (count, radius, turn) => Float64Array.from(
              {length: 2 * count}, (_, i) => radius * (i % 2 ? Math.sin : Math.cos)(
                  turn * 2 * Math.PI * (i >> 1) / count));
          // A wedge: across its bisector.
          const half = .3;
          const wedge = new SnapGrid([Float64Array.of(0, 0,
              20, -20 * Math.tan(half), 20, 20 * Math.tan(half))]);
          const wedges = [1, 3.7, 9].map((x) => wedge.chordAt(x, 0).length / (2 * x * Math.tan(half)));
          // A ring: its width.
          const width = new SnapGrid([ring(360, 10, 1), ring(360, 8, -1)]);
          const widths = Array.from({length: 40}, (_, i) =>
            width.chordAt(8.2 * Math.cos(i), 8.2 * Math.sin(i)).length);
          // A star with a hole, by all directions and all edges.
          const loops = [Float64Array.from({length: 90}, (_, i) =>
            (i % 4 < 2 ? 11 : 5) * (i % 2 ? Math.sin : Math.cos)((i >> 1) * 2 * Math.PI / 45)),
            ring(17, 2, -1)];
          const star = new SnapGrid(loops);
          const edges = edgesOf(loops);
          const brute = (x, y) => {
            let least = Infinity;
            for (let k = 0; k < 3600; ++k) {
              const [dx, dy] = [Math.cos(k * Math.PI / 3600), Math.sin(k * Math.PI / 3600)];
              let [ahead, back] = [Infinity, Infinity];
              for (let i = 0; i < edges.length; i += 4) {
                const [ax, ay, bx, by] = [edges[i] - x, edges[i + 1] - y, edges[i + 2] - x, edges[i + 3] - y];
                const [a, b] = [dx * ay - dy * ax, dx * by - dy * bx];
                if ((a > 0) === (b > 0)) continue;
                const t = dx * (ax + a / (a - b) * (bx - ax)) + dy * (ay + a / (a - b) * (by - ay));
                if (t > 0) ahead = Math.min(ahead, t);
                else back = Math.min(back, -t);
              }
              least = Math.min(least, ahead + back);
            }
            return least;
          };
          const differences = [];
          for (let x = -10.03; x < 11; x += 2.1) {
            for (let y = -10.07; y < 11; y += 2.3) {
              const chord = star.chordAt(x, y);
              const least = brute(x, y);
              differences.push(!chord ? (least === Infinity ? 0 : 99) : chord.length - least);
            }
          }
          return {wedges, widths, differences};""")
        for ratio in found["wedges"]:
            self.assertAlmostEqual(ratio, 1, delta=1e-12)
        sagitta = 1 - math.cos(math.pi / 360)
        for width in found["widths"]:
            self.assertGreater(width, 2 - 10 * sagitta - 1e-9)
            self.assertLess(width, 2 + 8 * sagitta)
        for difference in found["differences"]:
            # What is found is no longer than any of those tried.
            self.assertLess(difference, 1e-9)
            self.assertGreater(difference, -.05)

    def evaluate_on_plate(self, body):
        self.open("plate.html")
        return self.browser.evaluate(f"(() => {{{body}}})()")

    def test_circles_are_those_of_the_corners(self):
        found = self.evaluate_on_plate("""
          const arc = (cx, cy, radius, from, to, count) => Array.from({length: count + 1}, (_, i) => {
            const angle = (from + (to - from) * i / count) * Math.PI / 180;
            return [cx + radius * Math.cos(angle), cy + radius * Math.sin(angle)];
          });
          const loop = (...points) => Float64Array.from(points.flat(2));
          const rounded = (value) => Math.round(value * 1000) / 1000;
          const arcs = (points) => arcsOf(points).map(
              ({center: [x, y], radius, count}) => [x, y, radius, count].map((v) => rounded(v) + 0));
          const jittered = (points) => points.map((value, i) => value + 4e-4 * Math.sin(99 * i));
          return {
            square: arcs(loop([[0, 0], [9, 0], [9, 9], [0, 9]])),
            hexagon: arcs(loop(arc(1, 2, 3, 0, 300, 5))),
            hole: arcs(jittered(loop(arc(5, 6, 2, 360, 10, 35)))),
            rounded: arcs(loop(arc(17, 7, 3, 0, 90, 8), arc(3, 7, 3, 90, 180, 8),
                arc(3, 3, 3, 180, 270, 8), arc(17, 3, 3, 270, 360, 8))),
            slot: arcs(loop(arc(20, 0, 2.5, -90, 90, 16), arc(0, 0, 2.5, 90, 270, 16))),
            flat: arcs(loop(arc(0, 0, 5, 30, 330, 50))),
            zigzag: arcs(loop(Array.from({length: 40}, (_, i) => [i, i % 2]))),
          };""")
        self.assertEqual(found["square"], [])
        self.assertEqual(found["zigzag"], [])
        self.assertEqual(found["hexagon"], [[1, 2, 3, 6]])
        [[x, y, radius, count]] = found["hole"]
        self.assertAlmostEqual(x, 5, delta=1e-3)
        self.assertAlmostEqual(y, 6, delta=1e-3)
        self.assertAlmostEqual(radius, 2, delta=1e-3)
        self.assertEqual(count, 36)
        self.assertEqual(sorted(found["rounded"]), [
            [3, 3, 3, 9], [3, 7, 3, 9], [17, 3, 3, 9], [17, 7, 3, 9]])
        self.assertEqual(sorted(found["slot"]),
                         [[0, 0, 2.5, 17], [20, 0, 2.5, 17]])
        # Its flat side is no chord of it.
        self.assertEqual(found["flat"], [[0, 0, 5, 51]])

    def test_snapping_is_that_of_all_edges(self):
        worst = self.evaluate_on_plate("""
          const {layers} = viewer.part;
          const grid = new SnapGrid(layers[2].contours);
          const edges = edgesOf(layers[2].contours);
          let worst = 0;
          for (let x = -1.03; x < 12; x += .21) {
            for (let y = -1.07; y < 12; y += .23) {
              for (const reach of [.05, .4, 3, 1e4]) {
                let nearest = Infinity;
                for (let i = 0; i < edges.length; i += 2) {
                  nearest = Math.min(nearest, Math.hypot(edges[i] - x, edges[i + 1] - y));
                }
                const found = grid.snap(x, y, reach);
                if ((nearest < reach) !== (found !== null && found.kind === "end")) worst = Infinity;
                if (nearest >= reach) continue;
                worst = Math.max(worst, Math.abs(nearest -
                    Math.hypot(found.place[0] - x, found.place[1] - y)));
              }
            }
          }
          return worst;""")
        self.assertLess(worst, 1e-12)

    def test_measuring_is_quick_in_a_layer_of_16000_corners(self):
        times = self.evaluate_on_plate("""
          const ring = (cx, cy, radius, count, turn) => Float64Array.from({length: 2 * count}, (_, i) => {
            const angle = turn * 2 * Math.PI * (i >> 1) / count;
            const r = radius * (1 + .1 * Math.sin(9 * angle));
            return i % 2 ? cy + r * Math.sin(angle) : cx + r * Math.cos(angle);
          });
          const layer = {contours: [ring(50, 50, 60, 800, 1),
            ...Array.from({length: 38}, (_, i) =>
              ring(12 + 11 * (i % 8), 14 + 15 * (i >> 3), 4.5, 400, -1))]};
          viewer.view.show([0, 0], [100, 100], ...viewer.room());
          const times = {};
          for (const mode of ["distance", "wall"]) {
            viewer.measuring.toggle(mode);
            const taken = Array.from({length: 201}, (_, i) => {
              const begin = performance.now();
              viewer.measuring.aim(layer, 0, viewer.view.toPage(
                  [5 + 90 * (i * .618 % 1), 5 + 90 * (i * .382 % 1)]));
              return performance.now() - begin;
            });
            // The first one makes the index.
            times[mode] = taken.slice(1).sort((a, b) => a - b)[100];
          }
          return times;""")
        self.assertLess(times["distance"], 4)
        self.assertLess(times["wall"], 4)

    def test_what_is_measured_is_copied(self):
        self.open("plate.html", "layer=1")
        self.browser.evaluate(
            "navigator.clipboard.writeText = async (text) => {"
            " window.copied = text; }")
        self.browser.press("c")
        self.browser.press("m")
        self.browser.press("c")
        self.assertIsNone(self.browser.evaluate("window.copied || null"))
        self.browser.click(*self.on_page(10, 20))
        self.browser.press("PageUp")
        self.browser.click(*self.on_page(11.25, 25))
        self.browser.press("c")
        self.assertEqual(
            self.browser.evaluate("window.copied"),
            f"{(1.25**2 + 25 + 1)**.5:.3f} mm, Δx 1.250, Δy 5.000, Δz 1.000, "
            f"∠ {math.degrees(math.atan2(5, 1.25)):.2f}°")
        self.assertIn("Copied", self.browser.text("distance"))

    def test_keys_measure(self):
        self.open("plate.html", "layer=3")
        self.set_part("cube([10, 10, 2]);")
        self.browser.evaluate("document.getElementById('drawing').focus()")
        self.browser.press("m")
        number = self.browser.text("number")
        # The cross begins in the middle, and goes to the right edge.
        self.browser.press("ArrowLeft")
        self.browser.press("Enter")
        self.assertIn("second", self.browser.text("distance"))
        for _ in range(5):
            self.browser.press("ArrowRight", shift=True)
        self.browser.press("Enter")
        scale = self.browser.evaluate("viewer.view.scale")
        self.assertIn(f"{50 / scale:.3f} mm", self.browser.text("distance"))
        self.assertEqual(self.browser.text("number"), number)
        self.browser.press("Escape")
        self.browser.press("ArrowRight")
        self.assertNotEqual(self.browser.text("number"), number)

    # ---- The section in the solid

    def test_dragging_with_shift_raises_and_lowers_the_section(self):
        self.open("plate.html", "theme=light&layer=10&view=3d")
        left, top, width, height = self.browser.place_of("solid")
        x, y = left + width / 2, top + height / 2
        number = lambda: int(self.browser.text("number").split()[0])
        turned = self.browser.evaluate("[viewer.solid.yaw, viewer.solid.pitch]")
        pixel = self.browser.evaluate("viewer.solid.heightOfPixel()")
        pixels = 0.5 / pixel
        self.browser.drag((x, y), (x, y + pixels), shift=True)
        self.assertAlmostEqual(number(), 5, delta=1)
        self.browser.drag((x, y), (x, y - 2 * pixels), shift=True)
        self.assertAlmostEqual(number(), 15, delta=1)
        self.browser.drag((x, y), (x, y - 900), shift=True)
        self.assertEqual(number(), 20)
        self.browser.drag((x, y), (x, y + 900), shift=True)
        self.assertEqual(number(), 1)
        self.assertEqual(self.browser.evaluate(
            "[viewer.solid.yaw, viewer.solid.pitch]"), turned)

    def test_the_grip_goes_with_the_section(self):
        self.open("plate.html", "theme=light&view=3d")
        number = lambda: int(self.browser.text("number").split()[0])
        grip = lambda: [place + size / 2 for place, size in zip(
            self.browser.place_of("grip")[:2], self.browser.place_of("grip")[2:])]
        # Of the whole solid it is at the top.
        x, y = grip()
        pixels = 1 / self.browser.evaluate("viewer.solid.heightOfPixel()")
        self.browser.drag((x, y), (x, y + pixels))
        self.browser.settle()
        self.assertAlmostEqual(number(), 10, delta=1)
        self.assertFalse(self.browser.evaluate("viewer.isWhole"))
        # The part's near side is larger than its middle.
        self.assertAlmostEqual(grip()[1] - y, pixels, delta=.25 * pixels)

    # ---- For all readers

    def test_every_text_can_be_read(self):
        """4.5 to 1, as WCAG 2 computes it."""
        self.make_held()
        for theme in ("light", "dark"):
            self.open("held.html", f"theme={theme}")
            self.browser.press("m")
            ratios = self.browser.evaluate("""(() => {
              const parse = (text) => {
                const [r, g, b, a = 1] = text.match(/[\\d.]+/g).map(Number);
                return {rgb: [r, g, b], a};
              };
              const over = (top, under) =>
                top.rgb.map((value, i) => value * top.a + under[i] * (1 - top.a));
              const light = (rgb) => rgb.map((v) => v / 255)
                  .map((v) => v <= .04045 ? v / 12.92 : ((v + .055) / 1.055) ** 2.4)
                  .reduce((sum, v, i) => sum + v * [.2126, .7152, .0722][i], 0);
              const ratio = (a, b) => {
                const [low, high] = [light(a), light(b)].sort((x, y) => x - y);
                return (high + .05) / (low + .05);
              };
              const backgroundOf = (element) => {
                if (!element) return [255, 255, 255];
                const own = parse(getComputedStyle(element).backgroundColor);
                return own.a === 1 ? own.rgb : over(own, backgroundOf(element.parentElement));
              };
              const named = (name) => rgbOf(color(name).slice(0, 7)).map((v) => 255 * v);
              // On canvases, and on a card over the part.
              const result = [["faint", "paper"], ["measure", "field"], ["ink", "field"]]
                  .map(([text, under]) => [`${text} on ${under}`, ratio(named(text), named(under))]);
              const card = parse(getComputedStyle(byId("distance")).backgroundColor);
              for (const under of ["solid", "support", "field"]) {
                for (const text of ["measure", "faint"]) {
                  result.push([`${text} on a card on ${under}`,
                    ratio(named(text), over(card, named(under)))]);
                }
              }
              byId("keys").showModal();
              byId("pointer").textContent = "x 1";
              for (const element of document.body.querySelectorAll("*")) {
                const hasText = [...element.childNodes].some(
                    (node) => node.nodeType === 3 && node.textContent.trim());
                if (!hasText || !element.checkVisibility() || element.closest(":disabled")) continue;
                const style = getComputedStyle(element);
                result.push([`${element.tagName} ${element.id} ${element.textContent.slice(0, 20)}`,
                  ratio(parse(style.color).rgb, backgroundOf(element))]);
              }
              return result;
            })()""")
            self.assertGreater(len(ratios), 60)
            for name, ratio in ratios:
                self.assertGreaterEqual(ratio, 4.5, (theme, name))

    def test_every_control_has_a_name_and_its_turn(self):
        self.make_held()
        self.open("held.html", "theme=light")
        order = []
        for _ in range(40):
            self.browser.press("Tab")
            order.append(self.browser.evaluate(
                "document.activeElement.id || document.activeElement.tagName"))
            if order[-1] == "slider":
                break
        buttons = [id for id in order if id not in ("BUTTON", "SUMMARY")]
        self.assertEqual(buttons, [
            "fit", "measure", "thickness", "below", "section", "orbit",
            "supports", "marks", "theme", "help", "solid", "drawing", "play",
            "slider"])
        # The findings are between drawing and play.
        listed = self.browser.evaluate(
            "document.querySelectorAll('#findings > ol button,"
            " #findings summary').length")
        self.assertEqual(len(order), len(buttons) + listed)
        nodes = self.browser.call("Accessibility.getFullAXTree")["nodes"]
        controls = [node for node in nodes if not node["ignored"]
                    and node["role"]["value"] in (
                        "button", "slider", "image", "dialog", "toolbar",
                        "complementary")]
        self.assertGreaterEqual(len(controls), 17)
        for node in controls:
            self.assertTrue(node["name"]["value"].strip(), node)
        self.assertEqual(self.browser.evaluate(
            "document.getElementById('distance').ariaLive"), "polite")

    def test_fields_keep_their_keys(self):
        self.open("plate.html", "layer=3")
        self.browser.evaluate("""(() => {
          const field = document.createElement("input");
          document.querySelector("main").prepend(field);
          field.focus();
        })()""")
        number = self.browser.text("number")
        for key in ("m", "w", "d", "ArrowUp", "PageUp", " "):
            self.browser.press(key)
        self.assertEqual(self.browser.text("number"), number)
        self.assertIsNone(self.browser.evaluate("viewer.measuring.mode"))

    def test_playing_jumps_where_motion_is_to_be_reduced(self):
        seen = {}
        for calm in ("reduce", "no-preference"):
            self.browser.call("Emulation.setEmulatedMedia", features=[
                {"name": "prefers-reduced-motion", "value": calm}])
            self.open("plate.html", "layer=1&view=layer")
            seen[calm] = self.browser.evaluate("""new Promise((resolve) => {
              const seen = new Set();
              viewer.play();
              const begin = performance.now();
              const look = () => {
                seen.add(viewer.state.index);
                if (performance.now() - begin < 600) requestAnimationFrame(look);
                else resolve(seen.size);
              };
              look();
            })""")
        self.browser.call("Emulation.setEmulatedMedia", features=[])
        self.assertEqual(seen["reduce"], 1)
        self.assertGreater(seen["no-preference"], 4)

    def test_all_words_come_from_one_table(self):
        self.make_held()
        with open(self.path("held.html"), encoding="utf-8") as file:
            page = file.read()
        begin = page.index("\nstartPage();\n</script>")
        with open(self.path("words.html"), "w", encoding="utf-8") as file:
            file.write(page[:begin] + """
              window.english = [...document.querySelectorAll("[data-word]")]
                  .map((element) => [element.textContent, word(element.dataset.word)]);
              for (const element of document.querySelectorAll("[data-word-title]")) {
                english.push([element.title, word(element.dataset.wordTitle)]);
              }
              for (const element of document.querySelectorAll("[data-word-label]")) {
                english.push([element.ariaLabel, word(element.dataset.wordLabel)]);
              }
              for (const [key, entry] of Object.entries(kWords)) {
                const marked = (text) => "«" + text.replace(/[A-Za-z]{2,}/g, "") + "»";
                kWords[key] = typeof entry === "string" ? marked(entry) :
                  {one: marked(entry.one), other: marked(entry.other)};
              }
              """ + page[begin:])
        self.open("words.html", "theme=light")
        # The page reads the same without its script.
        for html, table in self.browser.evaluate("english"):
            self.assertEqual(html, table)
        self.browser.press("m")
        x, y = self.on_page(0, 0)
        self.browser.click(x, y)
        self.browser.click(*self.on_page(6, 6))
        left = self.browser.evaluate("""(() => {
          // What the program says of the part is not in the table.
          const told = [viewer.part.title, viewer.part.supports.text,
            viewer.part.estimate, ...viewer.part.found.notes,
            ...viewer.part.found.places.flatMap(({text, origin}) => [text, origin])];
          const texts = [];
          const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
          while (walk.nextNode()) {
            if (walk.currentNode.parentElement.closest("script, noscript")) continue;
            texts.push(walk.currentNode.textContent);
          }
          for (const element of document.body.querySelectorAll("*")) {
            texts.push(element.title || "", element.ariaLabel || "",
                element.getAttribute("aria-valuetext") || "");
          }
          return texts.map((text) => told.filter((known) => known)
              .reduce((rest, known) => rest.replaceAll(known, ""), text))
              .filter((text) => /[A-Za-z]{2,}/.test(text));
        })()""")
        self.assertEqual(left, [])

    def test_it_works_without_inline_script_and_style(self):
        with open(self.path("plate.html"), encoding="utf-8") as file:
            page = file.read()
        style = re.search("<style>(.*)</style>", page, re.DOTALL)[1]
        script = re.search("<script>\n(.*)</script>\n</body>", page,
                           re.DOTALL)[1]
        page = page.replace(f"<style>{style}</style>",
                            '<link rel="stylesheet" href="/style.css">')
        page = page.replace(f"<script>\n{script}</script>",
                            '<script src="/script.js"></script>')
        script = ("window.violations = [];"
                  "document.addEventListener('securitypolicyviolation',"
                  " (event) => violations.push(event.violatedDirective));"
                  + script)
        files = {"/": ("text/html; charset=utf-8", page),
                 "/style.css": ("text/css", style),
                 "/script.js": ("text/javascript; charset=utf-8", script)}

        class Handler(http.server.BaseHTTPRequestHandler):
            def do_GET(self):
                kind, text = files.get(self.path, ("text/plain", ""))
                self.send_response(200)
                self.send_header("Content-Type", kind)
                self.send_header(
                    "Content-Security-Policy",
                    "default-src 'none'; script-src 'self'; style-src 'self'; "
                    "img-src 'self' data: blob:; connect-src 'self'")
                self.end_headers()
                self.wfile.write(text.encode())

            def log_message(self, *_):
                pass

        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        try:
            self.browser.open(f"http://127.0.0.1:{server.server_port}/"
                              "#theme=light&layer=12&view=layer")
            self.browser.press("m")
            self.browser.press("t")
            self.browser.press("t")
            self.browser.press(" ")
            self.browser.press(" ")
            self.browser.press("s")
            self.browser.settle()
            self.assertEqual(self.browser.evaluate("violations"), [])
            self.assertEqual(self.browser.evaluate(
                "getComputedStyle(document.body).display"), "flex")
        finally:
            server.shutdown()
            server.server_close()

    # ---- One part after another, as the studio shows them.

    def part_of(self, design, *options):
        """What a page has of a design: an expression that makes its part."""
        name = f"part{abs(hash((design, options)))}"
        with open(self.path(f"{name}.scad"), "w", encoding="utf-8") as file:
            file.write(design)
        lamina("view", self.path(f"{name}.scad"), "-o",
               self.path(f"{name}.html"), "--layer", "0.1", *options)
        with open(self.path(f"{name}.html"), encoding="utf-8") as file:
            page = file.read()
        facts = re.search('id="facts">(.*)</script>', page)[1]
        contours = re.search('id="contours">(.*)</script>', page)[1]
        return (f"inflate(bytesOf('{contours}')).then("
                f"(bytes) => readPart({facts}, bytes))")

    def set_part(self, *part):
        self.browser.evaluate(
            f"{self.part_of(*part)}.then((part) => viewer.setPart(part))"
            ".then(() => viewer.opened)")
        self.browser.settle()

    def test_another_part_keeps_what_the_reader_has_chosen(self):
        self.open("plate.html", "theme=light&layer=15")
        x, y = self.on_page(13, 23)
        self.browser.wheel(x, y, -300)
        self.browser.press("b")
        self.browser.press("m")
        self.browser.click(*self.on_page(11, 22))
        self.browser.click(*self.on_page(11.25, 22))
        told = self.browser.text("distance")
        self.browser.evaluate("viewer.solid.turn(90, -40); viewer.zoomSolid(1.5)")
        kept = ("[viewer.solid.yaw, viewer.solid.pitch, viewer.solid.zoomed,"
                " viewer.view.scale, viewer.state.below, viewer.measuring.mode]")
        before = self.browser.evaluate(kept)
        x, y = self.on_page(13, 23)
        # A part that is larger to all sides, and has its bed 1 mm lower.
        self.set_part("translate([5, 15, -3]) cube([20, 18, 9]);")
        self.assertEqual(self.browser.evaluate(kept), before)
        after = self.on_page(13, 23)
        self.assertAlmostEqual(after[0], x, delta=1e-6)
        self.assertAlmostEqual(after[1], y, delta=1e-6)
        self.assertEqual(self.browser.text("number"), "15 of 90")
        self.assertEqual(self.browser.text("distance"), told)
        self.assertIn("20.00 × 18.00 × 9.00 mm", self.browser.text("summary"))
        # A low part is shown at its top; a high one again where it was.
        self.set_part("cube([20, 20, 1]);")
        self.assertEqual(self.browser.text("number"), "10 of 10")
        self.set_part("cube([20, 20, 4]);")
        self.assertEqual(self.browser.text("number"), "15 of 40")

    def test_a_fitted_drawing_is_fitted_anew_where_the_size_changes(self):
        self.open("plate.html")
        scale = self.browser.evaluate("viewer.view.scale")
        x, y = self.on_page(15, 25)
        self.set_part("translate([10.5, 20.5, 0]) cube([10, 10, 2]);")
        after = self.on_page(15, 25)
        self.assertAlmostEqual(after[0], x, delta=1e-6)
        self.assertAlmostEqual(after[1], y, delta=1e-6)
        self.set_part("translate([10, 20, 0]) cube([20, 20, 2]);")
        self.assertAlmostEqual(self.browser.evaluate("viewer.view.scale"),
                               scale / 2, delta=1e-9)
        middle = self.on_page(20, 30)
        self.assertAlmostEqual(middle[0], x, delta=1)
        self.assertAlmostEqual(middle[1], y, delta=1)

    def test_a_part_with_findings_or_supports_shows_their_buttons(self):
        self.open("plate.html")
        self.assertFalse(self.is_hidden("findings"))
        bare = ("cube([10, 10, 2]);",)
        self.browser.evaluate(
            f"{self.part_of(*bare)}.then((part) => viewer.setPart("
            "{...part, found: null}))")
        self.assertTrue(self.is_hidden("findings"))
        self.assertTrue(self.is_hidden("marks"))
        self.set_part(HELD)
        self.assertFalse(self.is_hidden("findings"))
        self.assertFalse(self.is_hidden("supports"))
        self.browser.press("u")
        self.browser.press("t")
        self.set_part(HELD + "translate([20, 0, 0]) cube(2);")
        self.assertTrue(self.is_hidden("findings"))
        self.assertFalse(self.browser.evaluate("viewer.state.supports"))

    def test_a_layer_that_comes_early_is_drawn_until_the_part_is_there(self):
        self.open("plate.html", "theme=light&layer=5&view=layer")
        chosen = []
        self.browser.evaluate(
            "window.chosen = []; viewer.onChoose = (z) => chosen.push(z)")
        # A frame of 2 mm around [8, 22] × [18, 34], in steps of 0.5 mm.
        loops = [[(8, 18), (22, 18), (22, 34), (8, 34)],
                 [(10, 20), (10, 32), (20, 32), (20, 20)]]
        numbers = [len(loops)]
        last = (8, 18)
        for loop in loops:
            numbers.append(len(loop))
            for point in loop:
                for now, before in zip(point, last):
                    steps = round((now - before) / 0.5)
                    numbers.append(2 * steps if steps >= 0 else -2 * steps - 1)
                last = point
        contours = base64.b64encode(bytes(numbers)).decode()
        event = {"kind": "layer", "number": 17, "index": 63, "count": 480,
                 "row": [4.175, 4.15, 4.2, 2, 1, 8, 104, 104], "bottom": 1,
                 "low": [8, 18], "high": [22, 34], "step": 0.5,
                 "contours": contours}
        self.browser.evaluate(
            f"viewer.showLayer(readLayer({json.dumps(event)}))")
        self.browser.settle()
        picture = self.browser.screenshot()
        left, top, _, _ = self.browser.place_of("drawing")
        for place, name in [((9.2, 25.3), "solid"), ((21.2, 33.3), "solid"),
                            ((15.3, 19.2), "solid"), ((11.3, 25.3), "field"),
                            ((12.3, 28.3), "field"), ((22.3, 25.3), "field")]:
            x, y = self.browser.evaluate(
                f"viewer.view.toPage([{place[0]} - 8, {place[1]} - 18])")
            self.assertEqual(picture.at(left + x, top + y), LIGHT[name], place)
        self.assertEqual(self.browser.text("number"), "64 of 480")
        self.assertEqual(self.browser.text("height"), "3.175 mm")
        self.assertEqual(self.browser.text("area"), "104.0000 mm²")
        self.assertEqual(self.browser.evaluate(
            "[+document.getElementById('slider').value,"
            " +document.getElementById('slider').max]"), [64, 480])
        self.assertEqual(self.browser.evaluate("chosen"), chosen)
        # The reader goes on in the part that is there, and is heard.
        self.browser.press("ArrowUp")
        number, count = self.browser.text("number").split(" of ")
        self.assertEqual(count, "20")
        self.assertAlmostEqual(self.browser.evaluate("chosen[0]"),
                               (int(number) - 0.5) * 0.1)
        self.browser.evaluate(
            f"viewer.showLayer(readLayer({json.dumps(event)}))")
        self.set_part("cube([10, 10, 2]);")
        self.assertEqual(self.browser.text("number").split(" of ")[1], "20")
        self.assertEqual(self.browser.text("area"), "100.0000 mm²")

    def test_many_parts_leave_nothing_behind(self):
        self.open("plate.html")
        grown = self.browser.evaluate(f"""(async () => {{
          const parts = [await {self.part_of(PLATE)}, await {self.part_of(HELD)}];
          let count = 0;
          const wrap = (owner, name, by) => {{
            const plain = owner[name];
            owner[name] = function(...given) {{
              if (by > 0 || given[0]) count += by;
              return plain.apply(this, given);
            }};
          }};
          const gl = WebGL2RenderingContext.prototype;
          for (const what of ["Buffer", "VertexArray", "Program", "Shader", "Texture"]) {{
            wrap(gl, "create" + what, 1);
            wrap(gl, "delete" + what, -1);
          }}
          wrap(EventTarget.prototype, "addEventListener", 1);
          wrap(ResizeObserver.prototype, "observe", 1);
          viewer.setPart(parts[1]);
          await viewer.opened;
          const first = [count, document.querySelectorAll("*").length];
          for (let i = 0; i < 200; ++i) {{
            viewer.setPart(parts[i % 2]);
            // Some are not waited for.
            if (i % 3) await viewer.opened;
          }}
          await viewer.opened;
          return [count - first[0],
            document.querySelectorAll("*").length - first[1],
            viewer.solid.part === parts[1]];
        }})()""")
        self.assertEqual(grown, [0, 0, True])

    def test_a_solid_that_the_browser_has_lost_is_made_anew(self):
        self.open("plate.html", "theme=light&layer=5&view=3d")
        left, top, width, height = self.browser.place_of("solid")
        picture = self.browser.screenshot()
        self.browser.evaluate("""new Promise((resolve) => {
          const {canvas, gl} = viewer.solid;
          const lost = gl.getExtension("WEBGL_lose_context");
          canvas.addEventListener("webglcontextlost", () => setTimeout(() => lost.restoreContext()));
          canvas.addEventListener("webglcontextrestored", () => resolve());
          lost.loseContext();
        }).then(() => viewer.opened)""")
        self.browser.settle()
        again = self.browser.screenshot()
        for y in range(int(top), int(top + height), 7):
            for x in range(int(left), int(left + width), 7):
                self.assertEqual(picture.at(x, y), again.at(x, y))

    def test_the_solid_before_is_shown_until_the_next_is_made(self):
        self.open("plate.html", "theme=light&view=3d")
        shown = self.browser.evaluate(f"""(async () => {{
          const before = viewer.part;
          const next = await {self.part_of(GEAR)};
          viewer.setPart(next);
          const seen = [viewer.solid.part === before && viewer.solid.bodies.length];
          viewer.draw();
          const first = await viewer.opened;
          seen.push(first, viewer.solid.part === next);
          // One that is not wanted any more is not made.
          viewer.setPart(before);
          const dropped = viewer.opened;
          viewer.setPart(next);
          seen.push(await dropped, await viewer.opened, viewer.solid.part === next);
          return seen;
        }})()""")
        self.assertEqual(shown, [1, True, True, False, True, True])

    def test_names_are_no_markup(self):
        name = "a<b>&amp;</script>.slc".replace("/", "")
        os.link(self.path("plate.slc"), self.path(name))
        lamina("view", self.path(name), "-o", self.path("named.html"))
        self.open("named.html")
        self.assertEqual(self.browser.text("title"), name)
        self.assertEqual(self.browser.evaluate("document.title"), name)

    def test_it_fits_a_phone(self):
        phone = Browser(360, 740, is_phone=True)
        try:
            phone.open(f"file://{self.path('plate.html')}#layer=1")
            # The solid is above the layer; the list is a drawer, shut at first.
            solid = phone.place_of("solid")
            drawing = phone.place_of("drawing")
            self.assertEqual(solid[2], 360)
            self.assertLessEqual(solid[1] + solid[3], drawing[1] + 1)
            drawer = "document.getElementById('findings')"
            self.assertTrue(phone.evaluate(f"{drawer}.hidden"))
            phone.evaluate("document.getElementById('marks').click()")
            x, y, width, height = phone.place_of("findings")
            self.assertEqual((x, width), (0, 360))
            self.assertGreater(y, solid[1] + 60)
            phone.evaluate(f"{drawer}.querySelector('button').click()")
            self.assertTrue(phone.evaluate(f"{drawer}.hidden"))
            phone.press("s")
            self.assertLessEqual(
                phone.evaluate("document.documentElement.scrollWidth"), 360)
            _, top, width, height = phone.place_of("drawing")
            self.assertEqual(width, 360)
            self.assertGreater(height, 400)
            for element in ("fit", "measure", "below", "section", "orbit",
                            "marks", "theme", "play"):
                x, y, w, h = phone.place_of(element)
                self.assertGreaterEqual(min(x, y), 0)
                self.assertLessEqual(x + w, 360)
                self.assertLessEqual(y + h, 740)
                self.assertGreaterEqual(h, 34)
            # Two fingers stretch.
            scale = phone.evaluate("viewer.view.scale")
            y = top + height / 2
            points = lambda reach: [{"x": 180 - reach, "y": y, "id": 0},
                                    {"x": 180 + reach, "y": y, "id": 1}]
            phone.call("Input.dispatchTouchEvent", type="touchStart",
                       touchPoints=points(40))
            for reach in (50, 60, 70, 80):
                phone.call("Input.dispatchTouchEvent", type="touchMove",
                           touchPoints=points(reach))
            phone.call("Input.dispatchTouchEvent", type="touchEnd",
                       touchPoints=[])
            self.assertAlmostEqual(
                phone.evaluate("viewer.view.scale") / scale, 2, delta=.1)
            self.assertEqual(phone.faults, [])
        finally:
            phone.close()


if __name__ == "__main__":
    LAMINA = os.path.abspath(sys.argv.pop(1))
    unittest.main()

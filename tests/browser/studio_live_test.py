"""The studio's page with the program behind it, as a user drives it in Chromium.

usage: studio_live_test.py LAMINA [unittest's arguments]

studio_test.py looks at the page alone; here is what needs both sides.
"""

import json
import os
import re
import subprocess
import sys
import tempfile
import time
import unittest

from browser import Browser

LAMINA = None
EXAMPLES = os.path.join(os.path.dirname(__file__), "..", "..", "examples")

BOX = """/* [Size] */
length = 4;  // [1:0.5:20]
/* [More] */
height = 3;  // [1:1:10]
cube([length, 2, height]);
"""

# Takes some tenths of a second where n is large, and says n by its volume.
SLOW = """n = 1;  // [1:1:200]
a = [for (i = [0 : 2000 * n]) i];
cube([n, 1, 1]);
"""


def area_of(loop):
    """The signed area of a loop of (x, y)."""
    return sum(ax * by - bx * ay for (ax, ay), (bx, by)
               in zip(loop, loop[1:] + loop[:1], strict=True)) / 2


class Studio:
    """The program, and a page that is open in it."""

    def __init__(self, folder, path, *options):
        self.folder = folder
        self.arguments = [LAMINA, "studio", os.path.join(folder, path), *options]
        self.start()
        self.browser = Browser(1300, 850)
        self.browser.open(self.address)
        self.wait("studio.viewer || document.body.classList.contains('stale')")

    def start(self, *options):
        self.process = subprocess.Popen(
            [*self.arguments, *options], stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL, text=True,
            env={**os.environ, "XDG_RUNTIME_DIR": self.folder})
        self.address = self.process.stdout.readline().strip()
        self.port = re.search(r":(\d+)/", self.address).group(1)

    def stop(self):
        self.process.terminate()
        self.process.wait()
        self.process.stdout.close()

    def close(self):
        self.browser.close()
        self.stop()

    def evaluate(self, expression):
        return self.browser.evaluate(expression)

    def wait(self, condition, seconds=20):
        deadline = time.monotonic() + seconds
        while not self.evaluate(f"Boolean({condition})"):
            if time.monotonic() > deadline:
                raise AssertionError(
                    f"in vain: {condition}; the page says "
                    f"{self.browser.text('state')!r}, "
                    f"{self.browser.text('messages')!r}")
            time.sleep(0.02)

    def wait_for_volume(self, volume):
        self.wait("studio.shown && studio.shown.report && "
                  f"Math.abs(studio.shown.report.volume - {volume}) < 1e-6 && "
                  "!studio.wire.isBusy")

    def slide(self, name, value):
        self.evaluate(f"""(() => {{
          const slider = document.querySelector(
              '[data-name="{name}"] input[type=range]');
          slider.value = {value};
          slider.dispatchEvent(new Event("input", {{bubbles: true}}));
          slider.dispatchEvent(new Event("change", {{bubbles: true}}));
        }})()""")

    def field(self, name):
        return self.evaluate(
            f"document.querySelector('[data-name=\"{name}\"] input').value")


class LiveTest(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = self.scratch.name
        os.chmod(self.folder, 0o700)
        self.opened = []

    def tearDown(self):
        for studio in self.opened:
            faults = studio.browser.faults
            studio.close()
            self.assertEqual(faults, [])
        self.scratch.cleanup()

    def write(self, name, text):
        with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
            file.write(text)

    def read(self, name):
        with open(os.path.join(self.folder, name), encoding="utf-8") as file:
            return file.read()

    def open(self, name="box.scad", *options):
        self.opened.append(Studio(self.folder, name, *options))
        return self.opened[-1]

    def test_layers_are_those_of_the_program(self):
        studio = self.open(os.path.join(os.path.abspath(EXAMPLES),
                                        "solitaire.scad"))
        studio.slide("width_back", 4)
        studio.wait("studio.choice.values.get('width_back') === '4' && "
                    "!studio.wire.isBusy")
        output = os.path.join(self.folder, "x.layers.json")
        subprocess.run([LAMINA, os.path.join(EXAMPLES, "solitaire.scad"), "-D",
                        "width_back=4", "-o", output, "-q"], check=True)
        with open(output, encoding="utf-8") as file:
            written = json.load(file)["layers"]
        # Of the contours themselves, too: their steps are 1 um.
        shown = studio.evaluate("""studio.viewer.part.layers.map((layer) => [
            layer.area, layer.contours.map((loop) => Array.from(loop))])""")
        self.assertEqual(len(shown), len(written))
        for (area, loops), layer in zip(shown, written, strict=True):
            exact = sum(area_of(loop["points"])
                        for loop in layer["contours"])
            drawn = sum(area_of(list(zip(loop[::2], loop[1::2], strict=True)))
                        for loop in loops)
            self.assertAlmostEqual(area, exact, delta=1e-5)
            self.assertAlmostEqual(drawn, exact, delta=1e-3 * 200)

    def test_changes_show_at_once_and_never_late(self):
        self.write("slow.scad", SLOW)
        studio = self.open("slow.scad")
        # Of each picture that is painted, what was chosen and what it shows.
        studio.evaluate("""(() => {
          window.pictures = [];
          const {viewer} = studio;
          for (const name of ["showLayer", "setPart"]) {
            const show = viewer[name];
            viewer[name] = (shown) => {
              const area = name === "setPart" ? shown.layers[0].area : shown.layer.area;
              pictures.push([studio.sent.values.get("n") || "1", area]);
              return show.call(viewer, shown);
            };
          }
        })()""")
        for i in range(60):
            studio.slide("n", 1 + (i * 37) % 200)
            time.sleep(0.01 * (i % 3))
        studio.wait("!studio.wire.isBusy")
        last = 1 + (59 * 37) % 200
        studio.wait_for_volume(last)
        pictures = studio.evaluate("pictures")
        self.assertGreater(len(pictures), 1)
        for chosen, area in pictures:
            self.assertAlmostEqual(float(chosen), area, places=6)

    def test_follows_the_file_and_what_it_includes(self):
        self.write("box.scad", "include <size.scad>\n" + BOX.replace(
            "cube([length, 2, height])", "cube([length, 2, height * k])"))
        studio = self.open()
        messages = studio.browser.text("messages")
        self.assertIn("size.scad", messages)
        self.write("size.scad", "k = 2;\n")
        studio.wait_for_volume(4 * 2 * 6)
        self.write("size.scad", "k = 3;\n")
        studio.wait_for_volume(4 * 2 * 9)

    def test_says_what_is_wrong_in_the_file_and_keeps_the_picture(self):
        self.write("box.scad", BOX)
        studio = self.open()
        studio.slide("length", 10)
        studio.wait_for_volume(60)
        self.write("box.scad", BOX.replace("cube([length", "cube(]length"))
        studio.wait("document.body.classList.contains('stale')")
        messages = studio.browser.text("messages")
        self.assertIn("box.scad:5", messages)
        self.assertAlmostEqual(studio.evaluate("studio.viewer.part.volume"), 60,
                               places=6)
        self.assertEqual(studio.field("length"), "10")
        self.write("box.scad", BOX.replace("length, 2", "length, 4"))
        studio.wait_for_volume(10 * 4 * 3)
        self.assertEqual(studio.field("length"), "10")

    def test_two_windows_have_values_of_their_own(self):
        self.write("box.scad", BOX)
        studio = self.open()
        studio.slide("length", 10)
        studio.wait_for_volume(60)
        other = Browser(1000, 700)
        try:
            cookie = studio.browser.call("Network.getCookies",
                                         urls=[studio.address])["cookies"][0]
            other.call("Network.setCookie", name=cookie["name"],
                       value=cookie["value"], url=studio.address)
            other.open(f"http://127.0.0.1:{studio.port}/")
            deadline = time.monotonic() + 20
            while not other.evaluate("Boolean(studio.shown && studio.shown.report)"):
                self.assertLess(time.monotonic(), deadline)
                time.sleep(0.05)
            self.assertAlmostEqual(
                other.evaluate("studio.shown.report.volume"), 24, places=6)
            self.assertAlmostEqual(
                studio.evaluate("studio.viewer.part.volume"), 60, places=6)
            self.assertEqual(other.faults, [])
        finally:
            other.close()

    def test_goes_on_when_the_program_is_started_again(self):
        self.write("box.scad", BOX)
        studio = self.open()
        studio.slide("length", 10)
        studio.wait_for_volume(60)
        studio.stop()
        studio.wait("studio.wire.client === null")
        studio.slide("length", 20)
        self.write("box.scad", BOX.replace("length, 2", "length, 4"))
        studio.start("--port", studio.port)
        studio.wait_for_volume(20 * 4 * 3)

    def test_one_address_opens_one_browser(self):
        self.write("box.scad", BOX)
        studio = self.open()
        other = Browser(600, 400)
        try:
            other.open(studio.address)
            self.assertIn("has been used", other.evaluate("document.body.innerText"))
        finally:
            other.close()

    def test_writes_outputs_and_values(self):
        self.write("box.scad", BOX)
        studio = self.open()
        studio.slide("length", 10)
        studio.wait_for_volume(60)
        made = studio.evaluate("""(async () => {
          const {status, body} = await studio.wire.ask("/output", {format: "slc"});
          const bytes = new Uint8Array(await (await fetch(body.file)).arrayBuffer());
          return [status, body.name, Array.from(bytes)];
        })()""")
        self.assertEqual(made[:2], [200, "box.slc"])
        output = os.path.join(self.folder, "x.slc")
        subprocess.run([LAMINA, os.path.join(self.folder, "box.scad"), "-D",
                        "length=10", "-o", output, "-q"], check=True)
        with open(output, "rb") as file:
            self.assertEqual(bytes(made[2]), file.read())
        key = studio.evaluate("""(async () =>
          (await studio.wire.ask("/source", {})).body.key)()""")
        status = studio.evaluate(f"""(async () =>
          (await studio.wire.ask("/source", {{key: "{key}"}})).status)()""")
        self.assertEqual(status, 200)
        self.assertEqual(self.read("box.scad"), BOX.replace("= 4", "= 10"))
        studio.wait("studio.choice.differing().size === 0 && !studio.wire.isBusy")
        studio.wait_for_volume(60)

    def test_a_folder_has_its_designs(self):
        self.write("a.scad", "cube(1);\n")
        self.write("b.scad", BOX)
        studio = self.open("")
        studio.wait_for_volume(1)
        self.assertEqual(
            studio.evaluate("[...document.querySelectorAll('#design option')]"
                            ".map((o) => o.value)"), ["a.scad", "b.scad"])
        studio.evaluate("""(() => {
          const list = document.getElementById("design");
          list.value = "b.scad";
          list.dispatchEvent(new Event("change"));
        })()""")
        studio.wait_for_volume(24)


if __name__ == "__main__":
    LAMINA = os.path.abspath(sys.argv.pop(1))
    unittest.main()

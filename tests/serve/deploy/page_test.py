"""examples/serve/shop.html in a headless Chromium, before nginx and `lamina serve`.

usage: page_test.py LAMINA [unittest's arguments]
"""

import os
import re
import sys
import time

import web_server
from web_server import SERVE, service

sys.path.insert(0, os.path.join(service.TESTS, "browser"))
from browser import Browser  # noqa: E402

# A parameter of each kind; its volume says what was chosen.
KINDS = """length = 4;  // [1:0.5:20]
count = 2;  // [2:Two, 3:Three]
side = "thin";  // [thin, thick]
double = false;
label = "Ada";  // 5
at = [1, 2];
cube([length, side == "thin" ? 1 : 2, count * (double ? 2 : 1)]);
"""


class PageTest(service.ServiceTest):
    designs = {"kinds.scad": KINDS}

    def setUp(self):
        super().setUp()
        os.chmod(self.folder, 0o755)
        self.copy_examples("solitaire.scad")
        socket, folder = self.path("socket"), self.path("nginx")
        self.running = self.serve("--metal", "sterling-silver", "--price", "1.10 EUR/g",
                                  listen=socket)
        os.chmod(socket, 0o666)
        os.mkdir(folder)
        self.web = web_server.WebServer(folder, socket)
        self.addCleanup(self.web.close)
        self.web.start()
        self.browser = Browser(600, 1200)
        self.addCleanup(self.browser.close)

    def open(self, design):
        self.browser.open(
            f"http://127.0.0.1:{self.web.port}/?design={design}",
            "document.getElementById('quote').textContent !== ''")

    def set(self, name, value, member="value"):
        self.browser.evaluate(f"""(() => {{
          const field = document.querySelector('[name="{name}"]');
          field.{member} = {value};
          field.dispatchEvent(new Event("input", {{bubbles: true}}));
        }})()""")

    def wait_for(self, text):
        deadline = time.monotonic() + 30
        while text not in (seen := self.browser.text("quote")):
            self.assertLess(time.monotonic(), deadline, f"{seen}, not {text}")
            time.sleep(0.02)

    def grams(self, volume):
        return f"{volume * 0.01036:.2f} g of sterling-silver"

    def test_is_short(self):
        lines = 0
        for name in ("shop.html", "shop.css", "shop.js"):
            with open(os.path.join(SERVE, name), encoding="utf-8") as file:
                lines += len(file.readlines())
        self.assertLessEqual(lines, 60)

    def test_each_kind_of_field_changes_the_quote(self):
        self.open("kinds")
        self.wait_for(self.grams(4 * 1 * 2))
        self.wait_for(f"{4 * 1 * 2 * 0.01036 * 1.10:.2f} EUR")
        self.set("length", "20")
        self.wait_for(self.grams(20 * 1 * 2))
        self.set("count", "'3'")
        self.wait_for(self.grams(20 * 1 * 3))
        self.set("side", "JSON.stringify('thick')")
        self.wait_for(self.grams(20 * 2 * 3))
        self.set("double", "true", "checked")
        self.wait_for(self.grams(20 * 2 * 6))
        self.set("label", "'Bo'")
        self.set("at", "'[3, 4]'")
        self.set("length", "10")
        self.wait_for(self.grams(10 * 2 * 6))
        self.assertEqual(self.browser.faults, [])

    def test_says_what_is_wrong(self):
        self.open("kinds")
        self.wait_for("g of")
        self.set("length", "99")
        self.wait_for("length")
        self.assertRegex(self.browser.text("quote"), "20")
        self.set("length", "5")
        self.wait_for(self.grams(5 * 2))

    def test_the_newest_choice_wins(self):
        self.open("solitaire")
        self.browser.requests.clear()
        for i in range(30):
            self.set("carat", f"{0.2 + i * 0.05:.2f}")
            time.sleep(0.02 * (i % 3))
        last = self.running.quote("solitaire", {"carat": 1.65})
        self.wait_for(f"{last['metal']['grams']:.2f} g")
        time.sleep(1)  # what was late would show now
        self.assertIn(f"{last['metal']['grams']:.2f} g", self.browser.text("quote"))
        self.browser.settle()
        quotes = [url for url in self.browser.requests if url.endswith("/quote")]
        self.assertLess(len(quotes), 30)

    def test_shows_a_picture_of_the_choice(self):
        self.open("solitaire")
        self.wait_for("g of")
        self.browser.evaluate("document.getElementById('picture').decode()")
        self.assertGreater(self.browser.evaluate(
            "document.getElementById('picture').naturalWidth"), 100)
        first = self.browser.evaluate("document.getElementById('picture').src")
        self.set("carat", "2")
        deadline = time.monotonic() + 20
        while self.browser.evaluate(
                "document.getElementById('picture').src") == first:
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.02)
        self.browser.evaluate("document.getElementById('picture').decode()")

    def test_the_policy_of_the_site_is_strict(self):
        self.open("kinds")
        answers = self.browser.evaluate("""(async () => {
          const answer = await fetch(location.href);
          return answer.headers.get("Content-Security-Policy");
        })()""")
        self.assertNotRegex(answers, r"unsafe|\*|http")
        self.assertIsNone(re.search(r"<style|style=| on\w+=|<script>",
                                    open(os.path.join(SERVE, "shop.html"),
                                         encoding="utf-8").read()))


if __name__ == "__main__":
    service.main()

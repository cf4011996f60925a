"""What `lamina serve` answers, beside what the program itself says of the same.

usage: answers_test.py LAMINA [unittest's arguments]
"""

import json
import os
import random
import sys

import service
from service import BOX, by_query

sys.path.insert(0, os.path.join(service.TESTS, "browser"))
from browser import Picture  # noqa: E402

CHOICES = [("solitaire", {}),
           ("solitaire", {"carat": 0.5, "prongs": 4, "ring_size": 57.5}),
           ("solitaire", {"size_system": "US", "ring_size": 7, "width_back": 3.3}),
           ("signet", {"face_length": 12, "thickness": 2}),
           ("medal", {"height": 15.5, "rim": 0.9})]


def words_of(values):
    """The values as options of the program."""
    return [word for name, value in values.items()
            for word in ("-D", f"{name}={json.dumps(value)}")]


class AnswersTest(service.ServiceTest):
    def setUp(self):
        super().setUp()
        self.copy_examples()
        self.service = self.serve(
            "--material", "bluecast-x10", "--metal", "sterling-silver", "--price",
            "60 EUR/l,1.10 EUR/g", "--allow-read", "/usr/share/fonts")

    def test_a_quote_is_what_the_program_says(self):
        for design, values in CHOICES:
            with self.subTest(design, values=values):
                quote = self.service.quote(design, values)
                seen = json.loads(self.run_lamina(
                    "inspect", f"{design}.scad", *words_of(values), "--json"))
                self.assertEqual(quote["design"], design)
                self.assertAlmostEqual(quote["volume"], seen["volume_mm3"], places=6)
                box = seen["box_mm"]
                for axis in range(3):
                    self.assertAlmostEqual(quote["low"][axis], box["low"][axis])
                    self.assertAlmostEqual(quote["size"][axis],
                                           box["high"][axis] - box["low"][axis])
                self.assertEqual(quote["layers"], len(seen["layers"]))
                self.assertEqual(
                    {metal["title"]: round(metal["grams"], 9)
                     for metal in quote["metals"]},
                    {title: round(grams, 9) for title, grams
                     in seen["weight_g"].items() if title in
                     {metal["title"] for metal in quote["metals"]}})
                self.assertGreaterEqual(quote["values"].items(), values.items())

    def test_places_of_findings_are_seen_from_the_root(self):
        places = [place for finding in self.service.quote("solitaire")["findings"]
                  for place in finding["source"].split(" from ")]
        # What is small has no line.
        files = {place.split(":")[0] for place in places if place}
        self.assertEqual(files, {"solitaire.scad", "lib/jewelry.scad"})

    def test_prices_are_weights_times_prices(self):
        quote = self.service.quote("solitaire")
        # Sterling silver weighs 10.36 g/cm³.
        self.assertAlmostEqual(quote["metal"]["grams"],
                               quote["volume"] * 0.01036)
        self.assertEqual(quote["metal"]["currency"], "EUR")
        self.assertAlmostEqual(quote["metal"]["price"],
                               1.10 * quote["metal"]["grams"], places=2)
        self.assertAlmostEqual(quote["material"]["millilitres"],
                               quote["printed"] / 1000)
        self.assertAlmostEqual(quote["material"]["price"],
                               60 * quote["printed"] / 1e6, places=2)

    def test_supports_are_printed_and_not_cast(self):
        plain = self.service.quote("solitaire")
        held = self.service.quote("solitaire", supports=True)
        self.assertAlmostEqual(plain["printed"], plain["volume"])
        self.assertAlmostEqual(held["volume"], plain["volume"])
        self.assertGreater(held["printed"], held["volume"])
        report = self.path("report.json")
        self.run_lamina("solitaire.scad", "--supports", "-q", "-o",
                        self.path("x.slc"), "--report", report)
        with open(report, encoding="utf-8") as file:
            self.assertAlmostEqual(held["printed"], json.load(file)["volume_mm3"],
                                   places=6)

    def test_layers_are_the_program_s_own(self):
        for name in ("slc", "cli", "svg", "layers.json"):
            for design, values in CHOICES[:2]:
                with self.subTest(name, design=design, values=values):
                    made = self.service.post(f"/designs/{design}/layers?format={name}",
                                             {"values": values})
                    self.assertEqual(made.status, 200)
                    output = self.path(f"{design}.{name}")
                    self.run_lamina(f"{design}.scad", *words_of(values), "-q",
                                    "-o", output)
                    with open(output, "rb") as file:
                        self.assertEqual(made.body, file.read())

    def test_a_picture_is_one_and_shows_what_is_chosen(self):
        pictures = []
        for carat in (0.2, 3):
            answer = self.service.get(by_query("/designs/solitaire/picture.png",
                                               {"values": {"carat": carat}}))
            self.assertEqual(answer.status, 200)
            self.assertEqual(answer.headers["Content-Type"], "image/png")
            picture = Picture(answer.body)
            self.assertEqual(len(picture.rows), picture.height)
            self.assertGreater(len(set(map(bytes, picture.rows))), 50)
            pictures.append(answer.body)
        self.assertNotEqual(*pictures)

    def test_a_page_is_html(self):
        answer = self.service.post("/designs/solitaire/page")
        self.assertEqual(answer.status, 200)
        self.assertTrue(answer.headers["Content-Type"].startswith("text/html"))
        self.assertIn(b"<!doctype html>", answer.body[:100].lower())

    def test_get_and_post_answer_the_same(self):
        order = {"values": {"carat": 0.7}, "layer": 0.1}
        for kind in ("quote", "layers?format=slc", "page", "picture.png"):
            path = f"/designs/solitaire/{kind}"
            query = by_query(path, order)
            if "format" in kind:
                query = by_query("/designs/solitaire/layers", order) + "&format=slc"
            with self.subTest(kind):
                got, posted = self.service.get(query), self.service.post(path, order)
                self.assertEqual((got.status, got.body), (200, posted.body))
                self.assertEqual(got.headers["ETag"], posted.headers["ETag"])

    def test_designs_are_listed_as_their_files(self):
        self.write("zebra.csg", "cube(1);\n")
        self.write(".hidden.scad", "cube(1);\n")
        self.write("not.txt", "cube(1);\n")
        names = json.loads(self.service.get("/designs").body)
        expected = sorted(name.removesuffix(".scad")
                          for name in os.listdir(self.root)
                          if name.endswith((".scad", ".csg")) and name[0] != ".")
        self.assertEqual(names, expected)
        self.assertEqual(self.service.quote("zebra.csg")["volume"], 1)


class AgainTest(service.ServiceTest):
    """ETags."""

    designs = {"box.scad": "use <lib.scad>\n" + BOX.replace("2, 3", "2, deep()"),
               "lib.scad": "function deep() = 3;\n"}

    def tag(self, service_, **order):
        answer = service_.get(by_query("/designs/box/quote", order))
        self.assertEqual(answer.status, 200)
        return answer.headers["ETag"]

    def test_stay_the_same_also_after_a_restart(self):
        first = self.serve()
        tag = self.tag(first)
        self.assertRegex(tag, r'^(W/)?"[^"]+"$')
        self.assertEqual(self.tag(first), tag)
        first.close()
        again = self.serve()
        self.assertEqual(self.tag(again), tag)
        for sent in (tag, f'"other", {tag}', "*"):
            answer = again.get(by_query("/designs/box/quote", {}),
                               If_None_Match=sent)
            self.assertEqual((answer.status, answer.body), (304, b""), sent)
            self.assertEqual(answer.headers["ETag"], tag)
        self.assertEqual(again.get(by_query("/designs/box/quote", {}),
                                   If_None_Match='"other"').status, 200)

    def test_change_with_all_that_an_answer_hangs_on(self):
        running = self.serve()
        tags = [self.tag(running), self.tag(running, values={"length": 5}),
                self.tag(running, layer=0.1), self.tag(running, metal="sterling-silver")]
        picture = running.get(by_query("/designs/box/picture.png", {}))
        tags.append(picture.headers["ETag"])
        self.write("lib.scad", "function deep() = 5;\n")
        running.wait_for_volume("box", 40)
        tags.append(self.tag(running))
        self.write("box.scad", self.designs["box.scad"] + "translate([9, 9, 0]) cube();")
        running.wait_for_volume("box", 41)
        tags.append(self.tag(running))
        self.assertEqual(len(set(tags)), len(tags), tags)
        self.write("lib.scad", self.designs["lib.scad"])
        self.write("box.scad", self.designs["box.scad"])
        running.wait_for_volume("box", 24)
        self.assertEqual(self.tag(running), tags[0])
        running.close()

    def test_answers_are_right_whatever_was_asked_before(self):
        running = self.serve()
        generator = random.Random(5)
        for _ in range(200):
            length = generator.randint(2, 40) / 2
            quote = running.quote("box", {"length": length})
            self.assertAlmostEqual(quote["volume"], 6 * length)


if __name__ == "__main__":
    service.main()

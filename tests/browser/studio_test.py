"""The studio's page, as Chromium shows it, before a program that is played.

usage: studio_test.py [unittest's arguments]
"""

import copy
import json
import os
import random
import re
import subprocess
import tempfile
import time
import unittest

import studio_server
from browser import Browser


class StudioTest(unittest.TestCase):
    """Each test has a program and a page of its own."""

    size = (1200, 800)
    is_phone = False

    @classmethod
    def setUpClass(cls):
        cls.browser = Browser(*cls.size, is_phone=cls.is_phone)
        cls.folder = tempfile.TemporaryDirectory()
        cls.browser.call("Browser.setDownloadBehavior", behavior="allow",
                         downloadPath=cls.folder.name)

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.folder.cleanup()

    def setUp(self):
        self.studio = studio_server.Studio()
        self.address = self.studio.start()

    def tearDown(self):
        self.assertEqual(self.browser.faults, [])
        self.browser.call("Page.navigate", url="about:blank")
        self.studio.stop()

    def open(self, link=""):
        self.browser.open(f"{self.address}#{link}")
        self.wait_until_idle()

    def js(self, expression):
        return self.browser.evaluate(expression)

    def wait_until(self, condition, what="", seconds=15):
        """Waits for a condition of the page, or of ours."""
        deadline = time.monotonic() + seconds
        while not (condition() if callable(condition) else self.js(condition)):
            if time.monotonic() > deadline:
                self.fail(f"{what or condition} does not come")
            time.sleep(0.01)

    def wait_until_idle(self):
        self.wait_until("studio.wire.client !== null && !studio.wire.isBusy")

    def last(self):
        """The last choice that the program got."""
        self.wait_until_idle()
        return self.studio.changes[-1]

    def values(self):
        return self.last()["values"]

    def field(self, name, selector):
        return f"document.querySelector('[data-name=\"{name}\"] {selector}')"

    def enter(self, name, value, selector="input", ends=True):
        """As a user does who types or moves: `input`, and at last `change`."""
        self.js(f"(() => {{const e = {self.field(name, selector)}; e.focus();"
                f" e.value = {json.dumps(value)};"
                " e.dispatchEvent(new Event('input', {bubbles: true}));"
                + ("e.dispatchEvent(new Event('change', {bubbles: true}));"
                   if ends else "") + "})()")

    def shown(self, name, selector="input"):
        return self.js(f"{self.field(name, selector)}.value")

    def click(self, element):
        self.js(f"document.getElementById('{element}').click()")

    def type(self, text):
        for letter in text:
            self.browser.call("Input.dispatchKeyEvent", type="char", text=letter)

    def press(self, key, modifiers=0):
        code = {"key": key, "code": f"Key{key.upper()}" if len(key) == 1 else key,
                "modifiers": modifiers,
                "windowsVirtualKeyCode": ord(key.upper()) if len(key) == 1 else
                {"Enter": 13, "Escape": 27, "ArrowRight": 39}[key]}
        self.browser.call("Input.dispatchKeyEvent", type="rawKeyDown", **code)
        self.browser.call("Input.dispatchKeyEvent", type="keyUp", **code)

    def notice(self, text):
        self.wait_until(lambda: text in self.browser.text("notice"), text)


class FormTest(StudioTest):
    def test_the_form_has_groups_captions_and_the_design_s_own_values(self):
        self.open()
        self.assertEqual(self.js(
            "[...document.querySelectorAll('#form summary')].map("
            "(e) => e.firstChild.textContent)"),
            ["Global", "Size", "Stone", "Engraving"])
        self.assertEqual(self.shown("size"), "54")
        self.assertEqual(self.js(self.field("size", "label") + ".textContent"),
                         "ring size")
        self.assertEqual(self.js(self.field("prongs", "label") + ".textContent"),
                         "prongs")
        self.assertEqual(self.js(self.field("size", "label") + ".title"), "size")
        self.assertEqual(self.values(), {})

    def test_each_control_changes_what_is_sent(self):
        self.open()
        wanted = {}
        for name, selector, value, text in [
                ("size", "input[type=range]", "60", "60"),
                ("size", "input[type=number]", "61.25", "61.25"),
                ("width", "input", "-3.5", "-3.5"),
                ("shape", "select", "knife", "knife"),
                ("prongs", "select", "4", "4"),
                ("holes", "input:nth-of-type(2)", "7.25", "[1, 7.25, 4]"),
                ("initials", "input", "AB", "AB"),
                ("face", "input", "DejaVu Sans", "DejaVu Sans"),
                ("metal_color", "input[type=text]", "silver", "silver"),
                ("metal_color", "input[type=color]", "#102030", "#102030"),
                ("finish", "input", "say \"so\" \\", "say \"so\" \\")]:
            with self.subTest(name=name, selector=selector):
                self.enter(name, value, selector)
                wanted[name] = text
                self.assertEqual(self.values(), wanted)
        self.js(self.field("has_stone", "input") + ".click()")
        wanted["has_stone"] = "true"
        self.assertEqual(self.values(), wanted)

    def test_slider_and_number_follow_each_other(self):
        self.open()
        self.enter("size", "47", "input[type=range]", ends=False)
        self.assertEqual(self.shown("size", "input[type=number]"), "47")
        self.enter("size", "48", "input[type=number]", ends=False)
        self.assertEqual(self.shown("size", "input[type=range]"), "48")

    def test_what_is_not_a_number_in_its_limits_waits(self):
        self.open()
        count = len(self.studio.changes)
        for text in ["", "5", "95"]:
            self.enter("size", text, "input[type=number]", ends=False)
            self.assertEqual(self.shown("size", "input[type=number]"), text)
            self.assertEqual(self.js(self.field(
                "size", "input[aria-invalid=true]") + "!== null"), True)
        self.wait_until_idle()
        self.assertEqual(len(self.studio.changes), count)
        # Where the field is left, the nearest value counts.
        self.enter("size", "95", "input[type=number]")
        self.assertEqual(self.values(), {"size": "90"})
        self.assertEqual(self.shown("size", "input[type=number]"), "90")
        self.enter("size", "", "input[type=number]")
        self.assertEqual(self.shown("size", "input[type=number]"), "90")

    def test_texts_have_their_length(self):
        self.open()
        self.js(self.field("initials", "input") + ".select()")
        self.type("WXYZ")
        self.assertEqual(self.values(), {"initials": "WXY"})

    def test_one_or_all_values_go_back(self):
        self.open()
        self.assertTrue(self.js("byId('reset-all').disabled"))
        self.enter("size", "60")
        self.enter("width", "21")
        self.assertEqual(self.values(), {"size": "60", "width": "21"})
        self.js(self.field("size", ".reset") + ".click()")
        self.assertEqual(self.values(), {"width": "21"})
        self.assertEqual(self.shown("size"), "54")
        self.enter("size", "61")
        self.click("reset-all")
        self.assertEqual(self.values(), {})
        self.assertEqual(self.shown("width"), "20")

    def test_hidden_parameters_are_shown_on_demand(self):
        self.open()
        self.assertTrue(self.js("document.querySelector('[data-name=secret]').hidden"))
        self.click("show-hidden")
        self.assertFalse(self.js("document.querySelector('[data-name=secret]').hidden"))

    def test_names_of_javascript_s_own_are_parameters_as_any(self):
        for name in ["constructor", "toString", "__proto__"]:
            self.studio.parameters.append({
                "name": name, "group": "Odd", "type": "number", "initial": 1.0})
        self.open()
        self.assertEqual(self.shown("constructor"), "1")
        for name in ["constructor", "toString", "__proto__"]:
            self.enter(name, "2")
        self.assertEqual(self.values(), {
            "constructor": "2", "toString": "2", "__proto__": "2"})

    def test_settings_are_sent(self):
        self.open()
        for name, selector, value in [("layer", "input", "0.25"),
                                      ("minFeature", "input", "0.3"),
                                      ("printer", "select", "mars3"),
                                      ("material", "select", "castable"),
                                      ("metal", "select", "gold-750")]:
            self.enter(name, value, selector)
        self.js(self.field("supports", "input") + ".click()")
        self.assertEqual(self.last()["settings"], {
            "layer": 0.25, "minFeature": 0.3, "supports": True, "printer": "mars3",
            "material": "castable", "metal": "gold-750"})
        self.assertEqual(self.js("viewer.part.layers.length"), 40)

    def test_undo_and_redo_go_by_gestures(self):
        self.open()
        for value in range(55, 66):
            self.enter("size", str(value), "input[type=range]", ends=False)
        self.enter("size", "66", "input[type=range]")
        self.enter("width", "25")
        self.press("z", modifiers=2)
        self.assertEqual(self.values(), {"size": "66"})
        self.press("z", modifiers=2)
        self.assertEqual(self.values(), {})
        self.assertTrue(self.js("byId('undo').disabled"))
        self.press("z", modifiers=2 | 8)
        self.assertEqual(self.values(), {"size": "66"})
        self.click("redo")
        self.assertEqual(self.values(), {"size": "66", "width": "25"})
        self.assertTrue(self.js("byId('redo').disabled"))
        self.click("undo")
        self.assertEqual(self.shown("width"), "20")

    def test_an_arrow_key_that_is_held_is_one_gesture(self):
        self.open()
        self.js(self.field("size", "input[type=range]") + ".focus()")
        for _ in range(5):
            self.press("ArrowRight")
        self.assertEqual(self.values(), {"size": "59"})
        self.press("z", modifiers=2)
        self.assertEqual(self.values(), {})

    def test_undo_gives_up_what_is_half_typed(self):
        self.open()
        self.enter("size", "60", "input[type=number]")
        self.enter("size", "6", "input[type=number]", ends=False)
        self.press("z", modifiers=2)
        self.assertEqual(self.values(), {})
        self.assertEqual(self.shown("size", "input[type=number]"), "54")

    def test_keys_of_the_view_are_letters_in_fields(self):
        self.open()
        self.js("viewer.choose(3)")
        self.js(self.field("finish", "input") + ".select()")
        for letter in "mbf":
            self.browser.call("Input.dispatchKeyEvent", type="keyDown", key=letter,
                              text=letter)
        self.assertEqual(self.values(), {"finish": "mbf"})
        self.assertFalse(self.js("viewer.measuring.mode !== null || viewer.state.below"))
        # Arrows move the slider that has the focus, not the layer.
        self.js(self.field("size", "input[type=range]") + ".focus()")
        self.press("ArrowRight")
        self.assertEqual(self.values()["size"], "55")
        self.assertEqual(self.js("viewer.state.index"), 3)


class FileTest(StudioTest):
    """The file changes while the page shows it."""

    def edit(self, **initial):
        parameters = copy.deepcopy(self.studio.parameters)
        for parameter in parameters:
            parameter["initial"] = initial.get(parameter["name"], parameter["initial"])
        self.studio.edit(parameters)
        self.wait_until(lambda: self.studio.changes[-1]["form"] != "" and
                        self.js(f"studio.choice.formKey") == self.studio.key())
        self.wait_until_idle()

    def test_typed_values_stay_and_others_follow_the_file(self):
        self.open()
        self.enter("size", "60")
        self.edit(size=50.0, width=33.0)
        self.assertEqual(self.shown("size"), "60")
        self.assertEqual(self.shown("width"), "33")
        self.assertEqual(self.values(), {"size": "60"})
        self.assertEqual(self.js("viewer.part.size.slice(0, 2)"), [60, 33])

    def test_a_value_that_was_the_file_s_own_stays_when_it_was_typed(self):
        self.open()
        self.enter("size", "60")
        self.enter("size", "54")
        self.assertEqual(self.values(), {})
        self.edit(size=50.0)
        self.assertEqual(self.values(), {"size": "54"})
        self.assertEqual(self.js("viewer.part.size[0]"), 54)

    def test_the_field_with_the_focus_keeps_text_and_caret(self):
        self.open()
        self.js(f"(() => {{const e = {self.field('face', 'input')}; e.focus();"
                " e.value = 'polished'; e.setSelectionRange(3, 3);"
                " e.dispatchEvent(new Event('input', {bubbles: true}));})()")
        parameters = [{"name": "first", "group": "Global", "type": "number",
                       "initial": 1.0}] + copy.deepcopy(self.studio.parameters)
        parameters = [p for p in reversed(parameters) if p["name"] != "prongs"]
        self.studio.edit(parameters)
        self.wait_until("studio.choice.parameters.some(({name}) => name === 'first')")
        self.assertEqual(self.js(
            "[document.activeElement.value, document.activeElement.selectionStart]"),
            ["polished", 3])
        self.assertIsNone(self.js("document.querySelector('[data-name=prongs]')"))
        self.type("x")
        self.assertEqual(self.values(), {"face": "polxished"})

    def test_a_number_half_typed_stays(self):
        self.open()
        self.enter("size", "6", "input[type=number]", ends=False)
        self.edit(size=50.0)
        self.assertEqual(self.shown("size", "input[type=number]"), "6")
        self.type("3")
        self.assertEqual(self.values(), {"size": "63"})

    def test_values_come_back_with_their_parameter(self):
        self.open()
        self.enter("size", "60")
        self.enter("width", "30")
        parameters = copy.deepcopy(self.studio.parameters)
        self.studio.edit([p for p in parameters if p["name"] != "size"])
        self.wait_until("studio.choice.parameters.every(({name}) => name !== 'size')")
        self.assertEqual(self.values(), {"width": "30"})
        self.studio.edit(parameters)
        self.wait_until("studio.choice.parameters.some(({name}) => name === 'size')")
        self.assertEqual(self.values(), {"size": "60", "width": "30"})

    def test_errors_come_first_and_the_picture_stays(self):
        self.open()
        self.studio.fails = True
        self.studio.messages = [
            {"severity": "warning", "message": "Ignoring unknown module 'shpere'",
             "file": "ring.scad", "line": 12, "column": 22,
             "text": "ring.scad:12:22: warning: Ignoring unknown module 'shpere'\n"
                     "   12 |   shpere(r = 3);\n      |   ^~~~~~\n"},
            {"severity": "error", "message": "Expected <b>;</b>", "file": "ring.scad",
             "line": 3, "text": ""}]
        self.edit(size=50.0)
        items = self.js("[...document.querySelectorAll('.message')].map("
                        "(e) => e.innerText)")
        self.assertIn("Expected <b>;</b>", items[0])
        self.assertIn("ring.scad:3", items[0])
        self.assertIn("ring.scad:12:22", items[1])
        self.assertIn("   12 |   shpere(r = 3);\n      |   ^~~~~~", items[1])
        self.assertEqual(self.browser.text("badge"), "1 error, 1 warning")
        self.assertTrue(self.js("byId('messages').open"))
        self.assertTrue(self.js("document.body.classList.contains('stale')"))
        self.assertEqual(self.js("viewer.part.size[0]"), 54)
        self.studio.fails = False
        self.studio.messages = []
        self.edit(size=51.0)
        self.assertTrue(self.js("byId('messages').hidden && byId('badge').hidden"))
        self.assertEqual(self.js("viewer.part.size[0]"), 51)

    def test_a_design_that_fails_from_the_start_says_why(self):
        self.studio.fails = True
        self.studio.messages = [{"severity": "error", "message": "no", "text": "no"}]
        self.open()
        self.assertIn("no", self.js("byId('message-list').innerText"))
        self.assertEqual(self.js("byId('state').dataset.state"), "failed")
        self.studio.fails = False
        self.studio.messages = []
        self.edit(size=51.0)
        self.assertEqual(self.js("viewer.part.size[0]"), 51)


class WireTest(StudioTest):
    def follow(self):
        """Notes what is shown at each layer and part, and what was sent then."""
        self.js("""(() => {
          window.seen = [];
          const note = (kind, size) => seen.push(
              [kind, size, +(studio.sent.values.get('size') ?? 54)]);
          const {showLayer, setPart} = viewer;
          viewer.showLayer = function (layer) {
            note('layer', layer.size[0]);
            showLayer.call(this, layer);
          };
          viewer.setPart = function (part) {
            note('part', part.size[0]);
            setPart.call(this, part);
          };
        })()""")

    def drag(self, count, pause):
        """Moves the slider so often, with a pause of up to so many ms."""
        return self.js(f"""new Promise(async (resolve) => {{
          const slider = {self.field('size', 'input[type=range]')};
          for (let i = 0; i < {count}; ++i) {{
            slider.value = 10 + (i * 37) % 80;
            slider.dispatchEvent(new Event('input', {{bubbles: true}}));
            await new Promise((next) => setTimeout(next, Math.random() * {pause}));
          }}
          slider.dispatchEvent(new Event('change', {{bubbles: true}}));
          resolve(+slider.value);
        }})""")

    def check(self, count, pause):
        last = self.drag(count, pause)
        self.wait_until_idle()
        time.sleep(2 * self.studio.delays[1] + 0.1)  # what is late comes still
        seen = self.js("seen")
        self.assertTrue(all(size == sent for _, size, sent in seen), seen)
        self.assertEqual(self.js("viewer.part.size[0]"), last)
        self.assertEqual(self.values()["size"], str(last))
        self.assertIsNone(self.js("viewer.state.early"))
        return seen

    def test_never_an_old_picture_after_a_new_value(self):
        random.seed(7)
        self.open()
        self.follow()
        self.studio.ends_runs = False  # so that late answers do come
        self.studio.delays = (0, 0.12)
        seen = self.check(200, 20)
        self.assertGreater(len(seen), 10)
        # Choices are not sent for each tick.
        self.assertLess(len(self.studio.changes), 150)

    def test_layers_and_parts_come_while_the_slider_moves(self):
        self.open()
        self.follow()
        self.studio.delays = (0.03, 0.06)
        seen = self.check(200, 20)
        kinds = [kind for kind, _, _ in seen]
        self.assertGreater(kinds.count("layer"), 15)
        self.assertGreater(kinds.count("part"), 3)

    def test_layers_of_a_slow_program_come_while_the_slider_moves(self):
        self.open()
        self.follow()
        self.studio.delays = (0.2, 0.3)
        seen = self.check(200, 30)
        self.assertGreater(len(seen), 4)

    def test_a_slow_program_does_not_keep_back_the_newest_choice(self):
        self.open()
        self.studio.delays = (10, 10)
        self.enter("size", "60")
        begin = time.monotonic()
        self.enter("size", "70")
        self.wait_until(lambda: self.studio.changes[-1]["values"] == {"size": "70"})
        # Before the first is answered.
        self.assertLess(time.monotonic() - begin, 10)

    def test_numbers_count_up_and_the_layer_in_view_is_told(self):
        self.open()
        self.js("viewer.choose(3)")
        self.enter("size", "60")
        self.assertAlmostEqual(self.last()["z"], 1.75)
        numbers = [choice["number"] for choice in self.studio.changes]
        self.assertEqual(numbers, sorted(set(numbers)))
        self.assertEqual(self.js("viewer.state.index"), 3)

    def test_nothing_is_lost_while_the_program_is_away(self):
        self.open()
        self.enter("size", "60")
        self.last()
        self.studio.stop()
        self.wait_until("byId('state').dataset.state === 'lost'")
        self.assertIn("Not connected", self.browser.text("state"))
        self.enter("width", "31")
        self.enter("layer", "0.25")
        self.studio.start()
        self.wait_until("byId('state').dataset.state === 'ready'")
        self.assertEqual(self.values(), {"size": "60", "width": "31"})
        self.assertEqual(self.last()["settings"]["layer"], 0.25)
        self.assertEqual(self.js("viewer.part.size.slice(0, 2)"), [60, 31])

    def test_a_program_that_forgot_the_page_is_asked_anew(self):
        self.open()
        forgotten = self.js("studio.wire.client")
        client = self.studio.clients.pop(forgotten)
        self.enter("size", "60")
        self.wait_until(f"studio.wire.client !== null && studio.wire.client !== '{forgotten}'")
        self.assertEqual(self.values(), {"size": "60"})
        client.events.put(None)

    def test_two_windows_do_not_disturb_each_other(self):
        self.open()
        other = Browser(900, 700)
        try:
            other.open(self.address)
            self.enter("size", "60")
            self.last()
            self.assertEqual(other.evaluate("viewer.part.size[0]"), 54)
            other.evaluate("studio.choice.set('size', '70')")
            self.wait_until(lambda: other.evaluate("viewer.part.size[0]") == 70)
            self.assertEqual(self.js("viewer.part.size[0]"), 60)
            self.assertEqual(other.faults, [])
        finally:
            other.close()

    def test_nothing_is_asked_of_others(self):
        self.open()
        self.enter("size", "60")
        self.last()
        self.assertTrue(self.browser.requests)
        for address in self.browser.requests:
            self.assertTrue(address.startswith((self.address, "data:", "about:")), address)


class UseTest(StudioTest):
    """What is done with values."""

    def downloaded(self, name):
        path = os.path.join(self.folder.name, name)
        self.wait_until(lambda: os.path.exists(path), path)
        with open(path, encoding="utf-8") as file:
            text = file.read()
        os.remove(path)
        return text

    def test_the_link_holds_all_that_was_chosen(self):
        self.open()
        self.enter("size", "60")
        self.enter("finish", "a&b=c d+é#")
        self.enter("layer", "0.25")
        last = self.last()
        self.wait_until("location.hash.includes('layer=0.25')")
        link = self.js("location.hash").lstrip("#")
        self.assertIn("design=ring.scad", link)
        self.assertIn("p.size=60", link)
        other = Browser(900, 700)
        try:
            other.open(f"{self.address}#{link}")
            self.wait_until(lambda: other.evaluate("viewer.part.size[0]") == 60)
            self.wait_until(lambda: self.studio.changes[-1]["client"] != last["client"])
            self.assertEqual(self.studio.changes[-1]["values"], last["values"])
            self.assertEqual(self.studio.changes[-1]["settings"], last["settings"])
        finally:
            other.close()

    def test_a_changed_link_is_followed_and_can_be_undone(self):
        self.open("design=ring.scad&p.size=60")
        self.assertEqual(self.values(), {"size": "60"})
        self.js("location.hash = '#design=ring.scad&p.width=12&p.gone=1'")
        self.wait_until("viewer.part.size[1] === 12")
        self.assertEqual(self.values(), {"width": "12"})
        self.click("undo")
        self.assertEqual(self.values(), {"size": "60"})

    def test_designs_of_a_folder_keep_their_values(self):
        self.open("design=hoop.scad")
        self.assertEqual(self.last()["design"], "hoop.scad")
        self.enter("size", "60")
        self.js("byId('design').value = 'ring.scad';"
                "byId('design').dispatchEvent(new Event('change'))")
        self.assertEqual(self.last()["design"], "ring.scad")
        self.assertEqual(self.values(), {})
        self.assertTrue(self.js("byId('undo').disabled"))
        self.js("byId('design').value = 'hoop.scad';"
                "byId('design').dispatchEvent(new Event('change'))")
        self.assertEqual(self.values(), {"size": "60"})

    def test_sets_of_the_file_and_saved_ones(self):
        self.open()
        names = ("[...document.querySelectorAll('#set-list .set')]"
                 ".map((e) => e.textContent)")
        self.assertEqual(self.js(names), ["wide"])
        self.js("document.querySelector('#set-list .set').click()")
        self.assertEqual(self.values(), {"size": "60", "width": "30"})
        self.assertEqual(self.js("document.querySelector('#set-list .set')"
                                 ".getAttribute('aria-pressed')"), "true")
        self.enter("size", "70")
        self.js("byId('set-name').value = 'my <own>'; byId('save-set').requestSubmit()")
        self.assertEqual(self.js(names), ["wide", "my <own>"])
        self.click("reset-all")
        self.assertEqual(self.values(), {})
        self.js("document.querySelectorAll('#set-list .set')[1].click()")
        self.assertEqual(self.values(), {"size": "70", "width": "30"})

    def test_openscad_reads_the_sets_that_are_saved(self):
        self.open()
        self.enter("size", "61.5")
        self.enter("finish", "say \"so\"")
        self.enter("holes", "7", "input:nth-of-type(2)")
        self.js(self.field("has_stone", "input") + ".click()")
        self.js("byId('set-name').value = 'mine'; byId('save-set').requestSubmit()")
        self.click("download-sets")
        sets = self.downloaded("ring.json")
        self.assertEqual(json.loads(sets)["fileFormatVersion"], "1")
        with tempfile.TemporaryDirectory() as folder:
            def path(name):
                return os.path.join(folder, name)
            with open(path("ring.json"), "w", encoding="utf-8") as file:
                file.write(sets)
            with open(path("ring.scad"), "w", encoding="utf-8") as file:
                file.writelines(self.studio.source(self.studio.parameters))
                file.write("echo(size, width, holes, finish, has_stone);\n")
            subprocess.run(
                ["openscad", "-p", path("ring.json"), "-P", "mine",
                 "-o", path("ring.echo"), path("ring.scad")],
                check=True, capture_output=True)
            with open(path("ring.echo"), encoding="utf-8") as file:
                self.assertIn('ECHO: 61.5, 20, [1, 7, 4], "say "so"", true',
                              file.read())

    def drop(self, name, text):
        self.js(f"""(() => {{
          const dataTransfer = new DataTransfer();
          dataTransfer.items.add(new File([{json.dumps(text)}], '{name}'));
          document.body.dispatchEvent(new DragEvent('drop',
              {{dataTransfer, bubbles: true, cancelable: true}}));
        }})()""")

    def test_a_dropped_set_is_applied(self):
        self.open()
        self.drop("a.json", json.dumps({"parameterSets": {"a": {
            "size": "62", "holes": "[3,3,3]", "has_stone": "true", "gone": "1"}},
            "fileFormatVersion": "1"}))
        self.notice("Read 1 set")
        self.assertEqual(self.values(), {
            "size": "62", "holes": "[3, 3, 3]", "has_stone": "true"})
        self.click("undo")
        self.assertEqual(self.values(), {})
        self.drop("b.json", "{]")
        self.notice("b.json is not a file of parameter sets")

    def test_comparison_shows_what_only_one_has(self):
        self.open()
        self.click("keep")
        self.assertFalse(self.js("byId('kept-pane').hidden"))
        self.assertTrue(self.js("byId('solid-pane').hidden"))
        self.enter("size", "60")
        self.enter("width", "10")
        self.last()
        self.wait_until("viewer.part.size[1] === 10")
        self.browser.settle()
        rows = dict((name, (a, b)) for name, a, b in self.js(
            "[...byId('difference-rows').rows].map("
            "(row) => [...row.cells].map((cell) => cell.textContent))"))
        self.assertEqual(rows["ring size"], ("54", "60"))
        self.assertEqual(rows["Volume"], ("10800.00 mm³", "6000.00 mm³"))
        self.assertEqual(rows["Silver 925"], ("111.9 g", "62.16 g"))
        self.assertNotIn("shape of the band", rows)
        picture = self.browser.screenshot()
        left, top, _, _ = self.browser.place_of("drawing")

        def at(x, y):
            px, py = self.js(f"viewer.view.toPage([{x} - viewer.view.low[0],"
                             f" {y} - viewer.view.low[1]])")
            return picture.at(left + px, top + py)
        colors = {name: tuple(int(self.js(f"color('{name}')").strip()[i:i + 2], 16)
                              for i in (1, 3, 5))
                  for name in ("only-a", "only-b", "solid", "field")}
        self.assertEqual(at(1, 7.5), colors["only-a"])
        self.assertEqual(at(28.5, 1), colors["only-b"])
        self.assertEqual(at(1, 1), colors["solid"])
        self.assertEqual(at(28.5, 7.5), colors["field"])
        # A moves with what is shown: the same place on both panes.
        left, top, _, _ = self.browser.place_of("kept-drawing")
        self.assertEqual(at(1, 7.5), colors["solid"])
        self.assertEqual(at(26, 1), colors["solid"])
        self.assertEqual(at(28.5, 1), colors["field"])
        self.click("apply-kept")
        self.assertEqual(self.values(), {})
        self.wait_until("!byId('no-differences').hidden")
        self.click("end-comparison")
        self.assertTrue(self.js("byId('kept-pane').hidden"))

    def test_values_are_written_after_a_look_at_the_difference(self):
        self.open()
        self.enter("size", "60")
        self.click("write-source")
        self.wait_until("byId('source-dialog').open")
        self.assertIn("-size = 54.0;\n+size = 60;", self.browser.text("source-diff"))
        self.click("cancel-source")
        self.assertEqual(self.studio.parameters[0]["initial"], 54)
        self.click("write-source")
        self.wait_until("byId('source-dialog').open")
        self.click("confirm-source")
        self.notice("Wrote ring.scad")
        self.wait_until(f"studio.choice.formKey === '{self.studio.key()}'")
        self.assertEqual(self.studio.parameters[0]["initial"], 60)
        self.assertEqual(self.values(), {})
        self.assertEqual(self.shown("size"), "60")
        self.click("write-source")
        self.notice("All values are those of the file")

    def test_a_file_that_changed_meanwhile_is_not_written(self):
        self.open()
        self.enter("size", "60")
        self.click("write-source")
        self.wait_until("byId('source-dialog').open")
        parameters = copy.deepcopy(self.studio.parameters)
        parameters[1]["initial"] = 22.0
        self.studio.edit(parameters)
        self.click("confirm-source")
        self.notice("has changed meanwhile")
        self.assertEqual(self.studio.parameters[0]["initial"], 54)
        self.assertEqual(self.shown("size"), "60")

    def test_files_of_each_format_are_made_of_the_values(self):
        self.open()
        self.enter("size", "60")
        self.last()
        self.assertEqual(self.js("[...byId('formats').children].map("
                                 "(e) => e.textContent)")[1], "STL")
        self.js("byId('formats').children[1].click()")
        choice = json.loads(self.downloaded("ring.stl"))
        self.assertEqual((choice["format"], choice["values"]), ("stl", {"size": "60"}))
        self.js("byId('formats').children[2].click()")
        self.notice("could not be made")
        self.assertIn("This format cannot hold it",
                      self.js("byId('message-list').innerText"))

    def test_figures_are_those_of_the_part(self):
        self.open()
        self.enter("size", "60")
        self.last()
        self.wait_until("byId('figure-volume').textContent === '12000.00 mm³'")
        self.assertEqual(self.js(
            "[...byId('figure-metals').rows].map((row) => row.innerText)")[2],
            "Gold 750\t184.8 g")
        self.assertEqual(self.browser.text("weight"), "")
        self.enter("metal", "silver-925", "select")
        self.wait_until("byId('weight').textContent === '124.3 g'")
        self.assertEqual(self.browser.text("figure-size"), "60.00 × 20.00 × 10.00 mm")


class LookTest(StudioTest):
    """Labels, contrast and room."""

    def contrasts(self):
        """Text and its contrast with what is behind it, of all that is seen."""
        return self.js("""(() => {
          const rgb = (text) => (text.match(/[\\d.]+/g) || []).map(Number);
          const light = (color) => color.slice(0, 3).map((c) => c / 255)
              .map((c) => c <= .04045 ? c / 12.92 : ((c + .055) / 1.055) ** 2.4)
              .reduce((sum, c, i) => sum + c * [.2126, .7152, .0722][i], 0);
          const behind = (element) => {
            for (; element; element = element.parentElement) {
              const color = rgb(getComputedStyle(element).backgroundColor);
              if (color.length === 3 || color[3] > .5) return color;
            }
            return [255, 255, 255];
          };
          const found = [];
          for (const element of document.querySelectorAll('header *, aside *, dialog *')) {
            const text = [...element.childNodes].filter(({nodeType}) => nodeType === 3)
                .map(({data}) => data.trim()).join('');
            if (!text || element.disabled || element.closest(':disabled') ||
                !element.checkVisibility()) continue;
            const [a, b] = [light(rgb(getComputedStyle(element).color)), light(behind(element))];
            found.push([text, (Math.max(a, b) + .05) / (Math.min(a, b) + .05)]);
          }
          return found;
        })()""")

    def test_words_can_be_read(self):
        self.studio.messages = [
            {"severity": severity, "message": severity, "text": severity}
            for severity in ("error", "warning", "note")]
        for theme in ("light", "dark"):
            self.browser.call("Page.navigate", url="about:blank")
            self.open(f"theme={theme}")
            self.enter("size", "60")
            self.js("byId('messages').open = true; byId('keep').click()")
            self.enter("size", "61")
            self.click("write-source")
            self.wait_until("byId('source-dialog').open")
            found = self.contrasts()
            self.assertGreater(len(found), 50)
            self.assertEqual([(text, ratio) for text, ratio in found if ratio < 4.5], [])

    def test_each_field_has_a_name(self):
        self.open()
        tree = self.browser.call("Accessibility.getFullAXTree")["nodes"]
        controls = {"textbox", "spinbutton", "slider", "checkbox", "combobox",
                    "button", "ColorWell", "searchbox"}
        nameless = [node["role"]["value"] for node in tree
                    if not node.get("ignored") and node["role"]["value"] in controls and
                    not node.get("name", {}).get("value")]
        self.assertEqual(nameless, [])

    def test_all_words_are_in_the_table(self):
        self.open()
        self.assertEqual(self.js(
            "[...document.querySelectorAll('[data-word], [data-word-title], [data-word-label]')]"
            ".flatMap(({dataset: {word, wordTitle, wordLabel}}) => [word, wordTitle, wordLabel])"
            ".filter((key) => key && !(key in kWords))"), [])
        page = self.js("Object.keys(kStudioWords).length")
        with open(os.path.join(studio_server.VIEWER, "words.js"), encoding="utf-8") as file:
            viewer = re.findall(r'^  "?([\w ]+)"?:', file.read(), re.MULTILINE)
        self.assertEqual(self.js("Object.keys(kWords).length"), len(viewer) + page)

    def test_nothing_is_wider_than_the_page(self):
        self.open()
        self.assertEqual(self.js(
            "[...document.querySelectorAll('#panel *')].filter((e) => e.checkVisibility() &&"
            " !e.closest('pre') &&"
            " e.getBoundingClientRect().right > byId('panel').getBoundingClientRect().right + 1)"
            ".map((e) => e.outerHTML)"), [])


class PhoneTest(StudioTest):
    size = (390, 844)
    is_phone = True

    def test_the_form_is_a_drawer(self):
        self.open()
        self.assertTrue(self.js("byId('panel').hidden"))
        self.click("panel-button")
        left, top, width, height = self.browser.place_of("panel")
        self.assertEqual((left, width), (0, 390))
        # Part of the picture is seen above it.
        _, pane_top, _, _ = self.browser.place_of("solid-pane")
        self.assertGreater(top - pane_top, 150)
        self.enter("size", "60")
        self.assertEqual(self.values(), {"size": "60"})
        self.assertEqual(self.js("document.documentElement.scrollWidth"), 390)
        self.click("panel-button")
        self.assertTrue(self.js("byId('panel').hidden"))


if __name__ == "__main__":
    unittest.main()

"""`lamina studio` from the side of a page: docs/studio.md over HTTP.

usage: protocol_test.py LAMINA [unittest's arguments]
"""

import http.client
import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
from server_process import ServerProcess  # noqa: E402

LAMINA = None

BOX = "length = 4;  // [1:0.5:20]\ncube([length, 2, 3]);\n"


class Page:
    """A page's connections: one for events, one for requests."""

    def __init__(self, studio):
        self.studio = studio
        self.requests = http.client.HTTPConnection(studio.host, timeout=30)
        self.events = http.client.HTTPConnection(studio.host, timeout=30)
        self.events.request("GET", "/events", headers={"Cookie": studio.cookie})
        self.stream = self.events.getresponse()
        self.hello = self.take() if self.stream.status == 200 else None
        self.number = 0

    def close(self):
        self.requests.close()
        self.stream.close()
        self.events.close()

    def take(self):
        while True:
            line = self.stream.readline()
            if not line:
                raise EOFError
            if line.startswith(b"data: "):
                return json.loads(line[6:])

    def choice(self, values=None, **more):
        return {"client": self.hello["client"], "number": self.number,
                "design": self.hello["design"], "values": values or {},
                "settings": self.hello["settings"], **more}

    def post(self, path, body, **headers):
        self.requests.request(
            "POST", path, body if isinstance(body, bytes) else json.dumps(body),
            {"Cookie": self.studio.cookie, "Origin": f"http://{self.studio.host}",
             "Content-Type": "application/json", **headers})
        answer = self.requests.getresponse()
        return answer.status, answer.read()

    def change(self, values=None, **more):
        self.number += 1
        return self.post("/change", self.choice(values, **more))[0]

    def show(self, values=None, **more):
        """The events of a change by their kind."""
        if self.change(values, **more) != 202:
            raise AssertionError("not taken")
        events = {}
        while "end" not in events:
            event = self.take()
            if event["kind"] == "changed":  # a file that has just been written
                return self.show(values, **more)
            if event["number"] == self.number:
                events[event["kind"]] = event
        return events


class Studio(ServerProcess):
    def __init__(self, path, *options):
        self.process = subprocess.Popen(
            [LAMINA, "studio", path, *options], stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL, text=True,
            env={**os.environ, "XDG_RUNTIME_DIR": ""})
        address = self.process.stdout.readline().strip()
        self.host = address.split("/")[2]
        connection = http.client.HTTPConnection(self.host)
        connection.request("GET", "/" + address.rsplit("/", 1)[1])
        answer = connection.getresponse()
        answer.read()
        self.cookie = answer.getheader("Set-Cookie").split(";")[0]
        connection.close()


class ProtocolTest(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.write("box.scad", BOX)
        self.studio = Studio(self.path("box.scad"))
        self.page = Page(self.studio)

    def tearDown(self):
        self.page.close()
        self.studio.close()
        self.scratch.cleanup()

    def path(self, name):
        return os.path.join(self.scratch.name, name)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def test_every_change_of_many_comes_to_its_end(self):
        for i in range(150):
            length = 1 + i % 20
            events = self.page.show({"length": str(length)})
            self.assertAlmostEqual(events["report"]["volume"], 6 * length)
            self.assertAlmostEqual(events["layer"]["row"][6], 2 * length)
        self.assertLess(self.studio.memory(), 40)

    def test_only_the_last_of_a_rush_is_sure_to_come(self):
        for _ in range(5):
            for i in range(40):
                self.assertEqual(self.page.change({"length": str(1 + i % 20)}), 202)
            while True:
                event = self.page.take()
                if event["kind"] == "end" and event["number"] == self.page.number:
                    break
        self.assertTrue(event["isWell"])

    def test_a_page_that_leaves_takes_its_processes_with_it(self):
        self.page.show()
        self.studio.wait_for_processes(1)
        others = [Page(self.studio) for _ in range(3)]
        for page in others:
            page.show()
        self.studio.wait_for_processes(4)
        for page in others:
            page.close()
        self.studio.wait_for_processes(1)

    def test_a_run_that_never_ends_is_ended(self):
        self.write("endless.scad", "n = 1;\ncube(1 + len([for (i = [0 : n], "
                   "j = [0 : n], k = [0 : n]) if (i < 0) 0]));\n")
        studio = Studio(self.path("endless.scad"))
        page = Page(studio)
        self.assertTrue(page.show()["end"]["isWell"])
        studio.wait_for_processes(1)
        self.assertEqual(page.change({"n": "9000"}), 202)
        studio.wait_for_processes(2)
        self.assertTrue(page.show()["end"]["isWell"])
        studio.wait_for_processes(1)
        page.close()
        studio.close()

    def test_a_process_that_is_killed_is_told_of(self):
        self.page.show()
        self.write("endless.scad", "cube(1 + len([for (i = [0 : 9000], "
                   "j = [0 : 9000], k = [0 : 9000]) if (i < 0) 0]));\n")
        studio = Studio(self.path("endless.scad"))
        page = Page(studio)
        self.assertEqual(page.change(), 202)
        studio.wait_for_processes(2)
        os.kill(studio.processes()[0], signal.SIGKILL)
        while (event := page.take())["kind"] != "messages":
            pass
        self.assertIn("ended by the system", event["messages"][0]["message"])
        self.assertFalse(page.take()["isWell"])
        self.assertEqual(page.change(), 202)
        studio.wait_for_processes(2)
        page.close()
        studio.close()

    def test_so_many_windows_and_no_more(self):
        pages = [Page(self.studio) for _ in range(20)]
        self.assertEqual([page.stream.status for page in pages],
                         15 * [200] + 5 * [503])
        for page in pages:
            page.close()

    def test_nobody_without_the_cookie(self):
        cookie = self.studio.cookie
        for other in ("", cookie[:-1], cookie + "0", cookie.upper()):
            for method, path in (("GET", "/"), ("GET", "/studio.js"),
                                 ("GET", "/events"), ("GET", "/file/1"),
                                 ("POST", "/change"), ("POST", "/source")):
                connection = http.client.HTTPConnection(self.studio.host)
                connection.request(
                    method, path, b"{}" if method == "POST" else None,
                    {"Cookie": other, "Content-Type": "application/json",
                     "Origin": f"http://{self.studio.host}"})
                self.assertEqual(connection.getresponse().status, 403)
                connection.close()

    def test_what_is_not_a_choice_is_refused(self):
        page = self.page
        self.assertEqual(page.post("/change", b"{")[0], 400)
        self.assertEqual(page.post("/change", b"[" * 60000)[0], 400)
        self.assertEqual(page.post("/change", {"client": 5})[0], 400)
        self.assertEqual(page.post("/change", {"client": "other"})[0], 404)
        self.assertEqual(page.post("/change", page.choice(
            **{"design": "../box.scad"}))[0], 404)
        self.assertEqual(page.post("/change", page.choice(
            settings={"layer": -1}))[0], 400)
        self.assertEqual(page.post("/change", page.choice(
            settings={"layer": 0.05, "printer": "/etc/passwd"}))[0], 400)
        self.assertEqual(page.post("/output", page.choice())[0], 400)
        self.assertEqual(page.post("/output", page.choice(
            format="../x"))[0], 400)
        self.assertEqual(page.post("/change", page.choice(), **{
            "Content-Type": "text/plain"})[0], 415)
        self.assertEqual(page.post("/elsewhere", page.choice())[0], 404)
        self.assertEqual(page.show()["end"]["isWell"], True)

    def test_outputs_can_be_fetched_by_one_who_waits(self):
        status, body = self.page.post("/output", self.page.choice(format="slc"))
        self.assertEqual(status, 200)
        made = json.loads(body)
        self.page.requests.request("GET", made["file"],
                                   headers={"Cookie": self.studio.cookie})
        answer = self.page.requests.getresponse()
        self.assertEqual(answer.getheader("Content-Disposition"),
                         'attachment; filename="box.slc"')
        subprocess.run([LAMINA, self.path("box.scad"), "-q"], check=True)
        with open(self.path("box.slc"), "rb") as file:
            self.assertEqual(answer.read(), file.read())

    def test_what_fails_says_why(self):
        self.write("box.scad", "cube(]);\n")
        status, body = self.page.post("/output", self.page.choice(format="slc"))
        self.assertEqual(status, 422)
        self.assertEqual(json.loads(body)["messages"][0]["line"], 1)

    def test_a_change_of_the_file_is_said_once_to_each(self):
        other = Page(self.studio)
        self.page.show()
        other.show()
        self.write("box.scad", BOX.replace("2, 3", "2, 5"))
        for page in (self.page, other):
            self.assertEqual(page.take()["kind"], "changed")
            self.assertAlmostEqual(page.show()["report"]["volume"], 40)
        other.close()

    def test_follows_the_sets_beside_the_design(self):
        form = self.page.show()["form"]
        self.assertEqual(form["sets"], [])
        self.write("box.json", '{"parameterSets": {"long": {"length": "20"}}, '
                   '"fileFormatVersion": "1"}')
        self.assertEqual(self.page.take()["kind"], "changed")
        self.assertEqual(self.page.show(form=form["key"])["form"]["sets"],
                         [{"name": "long", "values": {"length": "20"}}])

    def test_slow_readers_do_not_stop_others(self):
        slow = Page(self.studio)
        thread = threading.Thread(target=lambda: [
            slow.change({"length": str(1 + i % 20)}) or time.sleep(0.01)
            for i in range(100)])
        thread.start()
        for i in range(20):
            events = self.page.show({"length": str(1 + i)})
            self.assertTrue(events["end"]["isWell"])
        thread.join()
        slow.close()
        self.assertLess(self.studio.memory(), 40)


if __name__ == "__main__":
    LAMINA = os.path.abspath(sys.argv.pop(1))
    unittest.main()

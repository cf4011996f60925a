"""The attacks of tests/serve/http on `lamina studio` itself.

usage: attacks_test.py LAMINA [unittest's arguments]
"""

import os
import sys
import tempfile
import unittest

import protocol_test

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "http"))
import attacks  # noqa: E402


class Attacks(unittest.TestCase):

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        path = os.path.join(self.folder.name, "box.scad")
        with open(path, "w", encoding="ascii") as file:
            file.write(protocol_test.BOX)
        self.studio = protocol_test.Studio(path)
        self.addCleanup(self.studio.close)

    def test_each_gets_its_status_and_the_studio_goes_on(self):
        server = attacks.Server(
            int(self.studio.host.split(":")[1]), self.studio.process.pid,
            path="/", post="/change", stream="/events",
            cookie=self.studio.cookie)
        rows = attacks.run(server)
        print(attacks.table(rows, server))
        for row in rows:
            with self.subTest(row.name):
                self.assertTrue(attacks.is_well(row, server), row)
        page = protocol_test.Page(self.studio)
        self.assertTrue(page.show({"length": "7"})["end"]["isWell"])
        page.close()


if __name__ == "__main__":
    protocol_test.LAMINA = os.path.abspath(sys.argv.pop(1))
    unittest.main()

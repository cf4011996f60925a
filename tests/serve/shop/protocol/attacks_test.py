"""The attacks of tests/serve/http on `lamina serve` itself.

usage: attacks_test.py LAMINA [unittest's arguments]
"""

import os
import sys

import service

sys.path.insert(0, os.path.join(service.TESTS, "serve", "http"))
import attacks  # noqa: E402


class Attacks(service.ServiceTest):
    def test_each_gets_its_status_and_the_service_goes_on(self):
        running = self.serve()
        server = attacks.Server(
            running.port, running.process.pid, path="/designs",
            post="/designs/box/quote", programs=True)
        rows = attacks.run(server)
        print(attacks.table(rows, server))
        for row in rows:
            with self.subTest(row.name):
                self.assertTrue(attacks.is_well(row, server), row)
        self.assertAlmostEqual(running.quote("box", {"length": 7})["volume"], 42)


if __name__ == "__main__":
    service.main()

"""Attacks on a server that is made of the room serve/http.

usage: attacks_test.py HTTP_TEST_SERVER [unittest's arguments]
"""

import subprocess
import sys
import time
import unittest

import attacks

PROGRAM = None


class Attacks(unittest.TestCase):
    ARGUMENTS = []

    def setUp(self):
        self.process = subprocess.Popen(
            [PROGRAM, *self.ARGUMENTS],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.addCleanup(self.end)
        port = int(self.process.stdout.readline())
        self.server = attacks.Server(port, self.process.pid, stream="/stream",
                                     programs=bool(self.ARGUMENTS))

    def end(self):
        self.process.stdin.close()
        self.process.stdout.close()
        self.assertEqual(self.process.wait(timeout=10), 0)

    def test_each_gets_its_status_and_the_server_goes_on(self):
        before = attacks.memory(self.server)[1]
        begin = time.time()
        rows = attacks.run(self.server)
        print(attacks.table(rows, self.server))
        print(f"memory before: {before:.1f} MB, time: "
              f"{time.time() - begin:.1f} s")
        for row in rows:
            with self.subTest(row.name):
                self.assertTrue(attacks.is_well(row, self.server), row)


class AttacksOfPrograms(Attacks):
    ARGUMENTS = ["--programs"]


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()

"""docs/interfaces.md names what each interface offers, and all of it."""

import json
import os
import re
import subprocess
import sys
import unittest

import lamina

LAMINA = sys.argv.pop(1)
ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")


def read(*path):
    with open(os.path.join(ROOT, *path), encoding="utf-8") as file:
        return file.read()


def table():
    """The names in each column of the table."""
    columns = [set(), set(), set(), set()]
    for line in read("docs", "interfaces.md").splitlines():
        if not line.startswith("| ") or line.startswith("| |"):
            continue
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        assert len(cells) == 5, line
        for names, cell in zip(columns, cells[1:]):
            names.update(re.findall("`([^`]+)`", cell))
    return columns


PROGRAM, SERVICE, CPP, PYTHON = table()


class Interfaces(unittest.TestCase):
    def test_the_program_has_what_the_table_says(self):
        words = subprocess.run(
            [LAMINA, "--help-all"], capture_output=True, text=True, check=True
        ).stdout
        commands = set(re.findall(r"^  lamina ([a-z]+) ", words, re.M))
        for name in PROGRAM:
            self.assertIn(name, words)
        self.assertEqual(commands - PROGRAM, set())

    def test_the_service_has_what_the_table_says(self):
        routes = set(
            re.findall(r'"(/[^"]*)", "[a-zA-Z]+"', read("serve", "shop", "routes.cpp"))
        )
        self.assertGreater(len(routes), 5)
        schemas = json.loads(read("serve", "shop", "description", "schemas.json"))
        members = set(schemas["Order"]["properties"])
        self.assertEqual((routes | members) - SERVICE, set())
        known = routes | members | set(schemas["Quote"]["properties"])
        self.assertEqual(SERVICE - known, set())

    def test_the_header_has_what_the_table_says(self):
        header = re.sub(r"//.*", "", read("api", "lamina", "design.h"))
        design = header[header.index("class Design {") :]
        methods = set(re.findall(r"^  (?:static )?[\w:<>&,\s]*?(?<![<\w])(\w+)\(", design, re.M))
        for name in CPP:
            self.assertRegex(header, r"\b%s\b" % name.removeprefix("Design::"))
        offered = {"Design::" + name for name in methods}
        offered -= {"Design::Design", "Design::operator"}
        types = re.findall(r"^(?:struct|class|using) (\w+)", header, re.M)
        offered |= set(types) - {"Design"}
        self.assertEqual(offered - CPP, set())

    def test_python_has_what_the_table_says(self):
        for name in PYTHON:
            place = lamina
            for part in name.split("."):
                place = getattr(place, part)
        offered = set(lamina.__all__) | {
            "Design." + name for name in vars(lamina.Design) if name[0] != "_"
        }
        self.assertEqual(offered - PYTHON, set())


if __name__ == "__main__":
    unittest.main()

"""Errors: what is raised, with which place, and in the program's words."""

import os
import pickle
import subprocess
import tempfile
import unittest
from pathlib import Path

import lamina

PROGRAM = os.environ["LAMINA_PROGRAM"]

NESTED = """\
module inner(n) {
  assert(n < 3, "too many");
  cube(n);
}
module outer() inner(4);
outer();
"""


class Errors(unittest.TestCase):
    def raised(self, call):
        with self.assertRaises(lamina.Error) as caught:
            call()
        return caught.exception

    def test_have_place_and_calls(self):
        error = self.raised(lambda: lamina.Design.from_text(NESTED, name="a.scad"))
        self.assertIn("too many", error.message)
        self.assertEqual((error.file, error.line, error.column), ("a.scad", 2, 3))
        calls = [(call.message, call.file, call.line) for call in error.calls]
        self.assertIn(("called by 'inner'", "a.scad", 5), calls)
        self.assertIn(("called by 'outer'", "a.scad", 6), calls)

    def test_are_what_the_program_prints(self):
        with tempfile.TemporaryDirectory() as folder:
            for text in [NESTED, "cube(1", "cube(1);\nx = ;\ny = ;", "echo(1);"]:
                path = Path(folder) / "a.scad"
                path.write_text(text)
                done = subprocess.run(
                    [PROGRAM, path, "-q", "-o", Path(folder) / "a.slc"],
                    capture_output=True,
                    text=True,
                )
                error = self.raised(lambda: lamina.Design(path))
                self.assertEqual(str(error), done.stderr.rstrip("\n"))

    def test_of_syntax_have_a_place(self):
        error = self.raised(lambda: lamina.Design.from_text("cube(1)\nsphere(;"))
        self.assertEqual((error.file, error.line), ("design.scad", 2))
        self.assertEqual(error.calls, [])

    def test_of_files_and_options_have_words(self):
        self.assertIn(
            "missing.scad", str(self.raised(lambda: lamina.Design("missing.scad")))
        )
        cube = lamina.Design.from_text("cube(1);")
        error = self.raised(lambda: cube.slice(layer=0))
        self.assertIn("must be more than 0 mm", error.message)
        self.assertEqual((error.file, error.line), ("", 0))
        self.raised(lambda: cube.write("cube.stl"))
        self.raised(lambda: lamina.Design.from_text("cube(1);", supports="huge"))
        self.raised(lambda: lamina.Design.from_text("cube(1);", material="cheese"))
        self.raised(lambda: lamina.inspect("missing.slc"))

    def test_of_types_are_those_of_python(self):
        cube = lamina.Design.from_text("cube(1);")
        with self.assertRaises(TypeError):
            cube.slice(layer="thin")
        with self.assertRaises(TypeError):
            lamina.Design("a.scad", unknown=1)
        with self.assertRaises(TypeError):
            lamina.Design(3)

    def test_can_be_pickled(self):
        error = self.raised(lambda: lamina.Design.from_text(NESTED, name="a.scad"))
        other = pickle.loads(pickle.dumps(error))
        self.assertEqual((str(other), other.calls), (str(error), error.calls))

    def test_endless_recursion_is_one(self):
        for text in ["module a() a(); a();", "function f(x) = 1 + f(x); cube(f(1));"]:
            self.raised(lambda: lamina.Design.from_text(text))


if __name__ == "__main__":
    unittest.main()

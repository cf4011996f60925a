"""Types: mypy is content with the package and with the examples, and the stubs
are what the extension has."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import lamina

PACKAGE = Path(lamina.__file__).parent
EXAMPLES = Path(os.environ["LAMINA_SOURCE"]) / "examples" / "python"

USE = """
import lamina
import numpy as np
layers = lamina.Design("a.scad").with_(size=54).slice(layer=0.05)
reveal_type(layers[0].loops[0])
reveal_type(lamina.Design.from_text("cube(1);").check()[0].kind)
layers[0].area = 3
"""


class Types(unittest.TestCase):
    def run_mypy(self, *words, module="mypy"):
        with tempfile.TemporaryDirectory() as folder:
            return subprocess.run(
                [sys.executable, "-m", module, *map(str, words)],
                cwd=folder,
                capture_output=True,
                text=True,
                env={
                    **os.environ,
                    "MYPY_CACHE_DIR": folder,
                    "MYPYPATH": str(PACKAGE.parent),
                },
            )

    def test_package_and_examples_are_strict(self):
        done = self.run_mypy("--strict", "-p", "lamina")
        self.assertEqual(done.returncode, 0, done.stdout)
        done = self.run_mypy("--strict", *sorted(EXAMPLES.glob("*.py")))
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_users_see_types(self):
        done = self.run_mypy("--strict", "-c", USE)
        self.assertIn(
            "ndarray[Any, numpy.dtype[numpy.floating[numpy._typing._64Bit]]]",
            done.stdout,
        )
        self.assertIn('"builtins.str"', done.stdout)
        self.assertIn('Property "area" defined in "Layer" is read-only', done.stdout)

    def test_stubs_are_what_the_extension_has(self):
        # pybind11's classes have a metaclass, and take any arguments where none
        # make one.
        with tempfile.NamedTemporaryFile("w") as allowed:
            for name in ["Layer", "Layer.__init__", "SliceOptions", "Solid"]:
                allowed.write(f"lamina._lamina.{name}\n")
            allowed.flush()
            done = self.run_mypy(
                "--allowlist", allowed.name, "lamina._lamina", module="mypy.stubtest"
            )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()

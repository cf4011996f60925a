"""The examples run, and say what they promise."""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import lamina
import matplotlib.image

EXAMPLES = Path(os.environ["LAMINA_SOURCE"]) / "examples" / "python"


def run(name, *words):
    return subprocess.run(
        [sys.executable, EXAMPLES / name, *map(str, words)],
        check=True,
        capture_output=True,
        text=True,
        env={**os.environ, "MPLBACKEND": "agg"},
    ).stdout


class Examples(unittest.TestCase):
    def test_rings_have_a_row_for_each_size(self):
        table = [line.split() for line in run("rings.py").splitlines()]
        sizes = [row for row in table if row and row[0].isdigit()]
        self.assertEqual(len(sizes), 8)
        weights = [float(row[-1]) for row in sizes]
        self.assertEqual(weights, sorted(weights))

    def test_area_is_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            picture = Path(folder) / "area.png"
            run("area.py", picture)
            pixels = matplotlib.image.imread(picture)
        self.assertGreater(len(set(map(tuple, pixels[:, :, :3].reshape(-1, 3)))), 10)

    def test_cells_of_the_notebook_run(self):
        notebook = json.loads((EXAMPLES / "rings.ipynb").read_text())
        self.assertEqual(notebook["nbformat"], 4)
        names = {}
        folder = os.getcwd()
        os.chdir(EXAMPLES)
        try:
            for cell in notebook["cells"]:
                if cell["cell_type"] != "code":
                    continue
                *lines, last = "".join(cell["source"]).splitlines()
                exec("\n".join(lines), names)
                shown = eval(last, names)
        finally:
            os.chdir(folder)
        self.assertIsInstance(shown, lamina.Page)
        self.assertIn("<iframe", shown._repr_html_())


if __name__ == "__main__":
    unittest.main()

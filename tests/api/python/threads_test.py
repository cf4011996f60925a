"""Threads: Python goes on while lamina works, on stacks of any size."""

import os
import threading
import unittest
from pathlib import Path

import lamina

EXAMPLES = Path(os.environ["LAMINA_SOURCE"]) / "examples"


def beside(work):
    """How often another thread came to count while `work` ran."""
    is_done = threading.Event()
    counts = [0]

    def count():
        while not is_done.wait(0.001):
            counts[0] += 1

    thread = threading.Thread(target=count)
    thread.start()
    work()
    is_done.set()
    thread.join()
    return counts[0]


def points_of(layers):
    return [[loop.tolist() for loop in layer.loops] for layer in layers]


class Threads(unittest.TestCase):
    def test_others_run_during_long_calls(self):
        ring = lamina.Design(EXAMPLES / "solitaire.scad")
        works = {
            "slice": lambda: ring.slice(layer=0.005),
            "check": lambda: ring.check(layer=0.01),
            "report": lambda: ring.report(layer=0.01),
            "page": lambda: ring.page(layer=0.02),
            "thin_places": lambda: ring.thin_places(0.3, layer=0.02),
            "design": lambda: lamina.Design.from_text(
                "function f(n) = n < 2 ? n : f(n - 1) + f(n - 2); cube(f(24));"
            ),
        }
        for name, work in works.items():
            with self.subTest(name):
                self.assertGreater(beside(work), 5)

    def test_slice_one_design_together(self):
        ring = lamina.Design(EXAMPLES / "solitaire.scad")
        expected = points_of(ring.slice(layer=0.5))
        results = []
        threads = [
            threading.Thread(
                target=lambda: results.append(points_of(ring.slice(layer=0.5)))
            )
            for _ in range(8)
        ]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(results, [expected] * 8)

    def test_small_stacks_hold_deep_designs(self):
        threading.stack_size(256 << 10)
        outcomes = []

        def work():
            try:
                lamina.Design.from_text("module a() a(); a();")
            except lamina.Error as error:
                outcomes.append(error.message)
            deep = "function f(n) = n == 0 ? 0 : 1 + f(n - 1); cube(f(100000));"
            design = lamina.Design.from_text(deep)
            outcomes.append(design.slice(heights=[1])[0].area)
            outcomes.append(design.report(layer=50000)["layers"])
            ring = lamina.Design(EXAMPLES / "solitaire.scad", supports=True)
            outcomes.append(len(ring.slice(layer=1)) > 20)

        thread = threading.Thread(target=work)
        thread.start()
        thread.join()
        threading.stack_size(0)
        self.assertIn("Recursion detected", outcomes[0])
        self.assertEqual(outcomes[1:], [1e10, 2, True])


if __name__ == "__main__":
    unittest.main()

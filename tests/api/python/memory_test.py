"""Memory: 10,000 slicings in one process leave nothing behind."""

import gc
import unittest

import lamina

# Of malloc's trimming and of Python's own: a leak of 30 bytes for each of 9,000
# slicings would be more.
SLACK = 256 << 10


def resident():
    gc.collect()
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * 4096


class Memory(unittest.TestCase):
    def grown(self, work):
        for _ in range(1000):
            work()
        before = resident()
        for _ in range(9000):
            work()
        return resident() - before

    def test_slicings_leave_nothing(self):
        design = lamina.Design.from_text(
            "difference() { cylinder(r = 5, h = 2); cylinder(r = 3, h = 9); }"
        )

        def work():
            for layer in design.slice(layer=0.5):
                self.assertEqual(len(layer.loops), 2)

        self.assertLess(self.grown(work), SLACK)

    def test_designs_and_errors_leave_nothing(self):
        # Ten times as dear as a slicing; each leaves the memory of its stack.
        def work():
            lamina.Design.from_text("cube(1); cube(nothing);").slice(layer=1)
            try:
                lamina.Design.from_text("cube(")
            except lamina.Error:
                pass

        self.assertLess(self.grown(work), SLACK)


if __name__ == "__main__":
    unittest.main()

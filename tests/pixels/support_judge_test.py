#!/usr/bin/env python3
"""Tests of support_judge.py: boxes of pixels whose faults are known."""
import unittest

from support_judge import Judgement

PANEL = 80  # pixels, on both sides
PIXEL, RISE = 0.1, 0.1  # [mm]
TIP = 0.3  # [mm]; holds 24 pixels far, and one more


class Boxes:
    """A stack of boxes: ((left, top), (width, height), (bottom, layers)), in pixels."""

    def __init__(self, *boxes):
        self.boxes = boxes
        self.count = max(bottom + layers for _, _, (bottom, layers) in boxes)
        self.pixel = PIXEL
        self.heights = [(i * RISE, (i + 1) * RISE) for i in range(self.count)]

    def images(self, numbers=None):
        for layer in range(self.count) if numbers is None else numbers:
            pixels = bytearray(PANEL * PANEL)
            for (left, top), (width, height), (bottom, layers) in self.boxes:
                if bottom <= layer < bottom + layers:
                    for row in range(top, top + height):
                        at = row * PANEL + left
                        pixels[at:at + width] = b"\xff" * width
            yield PANEL, PANEL, bytes(pixels)


def raised(box, lift=10, shift=(0, 0)):
    (left, top), size, (bottom, layers) = box
    return (left + shift[0], top + shift[1]), size, (bottom + lift, layers)


PLATE = (20, 20), (30, 30), (0, 3)
# A tip that holds the plate's middle.
PILLAR = (34, 34), (3, 3), (0, 10)


def judged(part, *supports, shift=(0, 0)):
    return Judgement(Boxes(*part),
                     Boxes(*(raised(box, shift=shift) for box in part), *supports),
                     TIP, 4).json()


class SupportJudge(unittest.TestCase):
    def test_a_pillar_is_one_contact(self):
        print_ = judged([PLATE], PILLAR)
        self.assertEqual([c["area_mm2"] for c in print_["contacts"]],
                         [9 * PIXEL ** 2])
        self.assertAlmostEqual(print_["support_mm3"], 90 * PIXEL ** 2 * RISE)
        for kind in ("sides", "islands", "unheld"):
            self.assertEqual(print_[kind], [])

    def test_a_shift_is_found(self):
        print_ = judged([PLATE], ((37, 32), (3, 3), (0, 10)), shift=(3, -2))
        self.assertEqual(print_["shift_pixels"], [3, -2])
        self.assertEqual(print_["lost_share"], 0)
        self.assertEqual(len(print_["contacts"]), 1)

    def test_a_plate_that_nothing_holds_is_an_island(self):
        print_ = judged([PLATE], ((10, 10), (3, 3), (0, 10)))
        self.assertEqual([place["layer"] for place in print_["islands"]], [11])
        self.assertEqual(print_["contacts"], [])

    def test_a_support_that_begins_in_the_air_is_an_island(self):
        print_ = judged([PLATE], PILLAR, ((40, 40), (3, 3), (5, 5)))
        self.assertEqual([place["layer"] for place in print_["islands"]], [6])

    def test_corners_farther_than_a_tip_holds_are_unheld(self):
        print_ = judged([((20, 20), (45, 45), (0, 3))], ((20, 20), (3, 3), (0, 10)))
        self.assertEqual([place["layer"] for place in print_["unheld"]], [11])

    def test_a_pillar_along_the_part_is_a_side(self):
        leg = (49, 34), (1, 3), (0, 30)
        print_ = judged([PLATE, leg], PILLAR, ((50, 34), (3, 3), (0, 25)))
        self.assertEqual([place["layers"] for place in print_["sides"]], [[11, 25]])

    def test_a_support_may_stand_on_the_part(self):
        roof = (20, 20), (30, 30), (20, 3)
        wall = (20, 20), (2, 30), (3, 17)
        print_ = judged([PLATE, wall, roof], PILLAR, ((40, 34), (3, 3), (13, 17)))
        self.assertEqual(print_["stands"], 1)
        self.assertEqual(len(print_["contacts"]), 3)

    def test_a_tip_that_pierces_the_part_stands_over_its_top(self):
        print_ = judged([PLATE], PILLAR, ((34, 34), (2, 2), (13, 2)))
        self.assertEqual(print_["lift_layers"], 10)
        self.assertEqual(print_["lost_share"], 0)
        self.assertEqual([contact["is_stand"] for contact in print_["contacts"]],
                         [False, True])

    def test_the_part_may_be_shifted_to_the_rim(self):
        far = (0, 20), (10, 30), (0, 3)
        print_ = Judgement(Boxes(far), Boxes(
            raised(far, shift=(68, 0)), ((70, 34), (3, 3), (0, 10)),
            ((5, 34), (3, 3), (0, 10))), TIP, 4).json()
        self.assertEqual(print_["shift_pixels"], [68, 0])
        self.assertEqual(print_["lost_share"], 0)

    def test_seams_of_a_shift_by_less_than_a_pixel_are_no_supports(self):
        for size, loses in ((31, 29), True), ((31, 31), False):
            moved = (20, 20), size, (10, 3)
            print_ = Judgement(Boxes(PLATE), Boxes(moved, PILLAR), TIP, 4).json()
            self.assertEqual(print_["lost_share"] > 0, loses)
            self.assertEqual(len(print_["contacts"]), 1)
            self.assertEqual(print_["sides"], [])


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
"""Tests of distances.py, with pictures whose distances are known."""

import unittest

try:
    import numpy as np

    import distances
except ImportError:
    np = None


@unittest.skipUnless(np, "needs NumPy")
class Distances(unittest.TestCase):
    def setUp(self):
        self.all = np.ones((40, 50), bool)
        self.noise = np.random.default_rng(1).uniform(0, 1, (40, 50, 3))

    def test_a_picture_has_no_distance_to_itself(self):
        found = distances.distance(self.noise, self.noise, self.all)
        self.assertEqual((found["difference"], found["light"]), (0, 1))
        self.assertAlmostEqual(found["ssim"], 1)

    def test_half_the_light_is_half_of_the_mean_away(self):
        found = distances.distance(self.noise, self.noise / 2, self.all)
        self.assertAlmostEqual(found["share"], 0.5)
        self.assertAlmostEqual(found["light"], 0.5)
        self.assertLess(found["ssim"], 0.95)

    def test_other_noise_has_no_structure_in_common(self):
        other = np.random.default_rng(2).uniform(0, 1, self.noise.shape)
        self.assertLess(distances.distance(self.noise, other, self.all)["ssim"], 0.3)

    def test_of_flat_greys_ssim_compares_the_means_alone(self):
        a, b = np.full(self.all.shape, 0.5), np.full(self.all.shape, 0.25)
        self.assertAlmostEqual(distances.ssim(a, b, self.all), (2 * 0.125 + 1e-4) / (0.3125 + 1e-4))

    def test_nothing_at_the_edge_of_the_model_counts(self):
        cover = np.zeros((9, 9))
        cover[2:7, 2:7] = 1
        cover[4, 4] = 0.5
        found = distances.inside(cover)
        self.assertTrue(found[3, 3] and found[5, 5])
        self.assertFalse(found[2:7, 2].any() or found[2, 2:7].any() or found[4, 4] or found[4, 3] or found[5, 4])

    def test_noise_counts_less_in_means_over_squares_of_pixels(self):
        grey = np.full(self.noise.shape, 0.5)
        found = distances.distance(grey, grey + 0.2 * (self.noise - 0.5), self.all)
        self.assertLess(found["blocks"], found["share"] / 3)

    def test_a_highlight_counts_no_more_than_what_is_as_bright_as_seen(self):
        bright = self.noise.copy()
        bright[0, 0] = 1e6
        other = self.noise.copy()
        other[0, 0] = 1e3
        self.assertEqual(distances.distance(bright, other, self.all)["difference"], 0)


if __name__ == "__main__":
    unittest.main()

"""The ring that the simulation of many replicas uses. That the real haproxy has the same places: fleet_check.py."""

import unittest
from collections import Counter
from hashlib import sha256

from haproxy_ring import Ring, key_of, most_requests

KEYS = [key_of(sha256(b"%d" % each).hexdigest()) for each in range(3000)]


def homes(ring):
    return [ring.owners[point] for point in ring.nearest(KEYS)]


class HaproxyRing(unittest.TestCase):
    def test_places_of_the_real_program(self):
        """As HAProxy 2.6 served them, with three replicas of weight 100."""
        ring = Ring({1: 100, 2: 100, 3: 100})
        counts = Counter(homes(ring)[:1000])
        self.assertEqual((counts[1], counts[2], counts[3]), (330, 334, 336))

    def test_shares_are_nearly_equal(self):
        counts = Counter(homes(Ring({each: 100 for each in range(1, 11)})))
        self.assertLess(max(counts.values()), 300 * 1.25)
        self.assertGreater(min(counts.values()), 300 * 0.75)

    def test_one_more_takes_its_part_and_moves_no_other(self):
        before, after = (homes(Ring({each: 100 for each in range(1, count + 1)})) for count in (4, 5))
        moved = [new for old, new in zip(before, after) if old != new]
        self.assertEqual(set(moved), {5})
        self.assertAlmostEqual(len(moved) / 3000, 1 / 5, delta=0.03)

    def test_a_full_replica_passes_on_to_the_same_one_each_time(self):
        ring = Ring({1: 100, 2: 100, 3: 100})
        for point in ring.nearest(KEYS[:50]):
            first = ring.place(point, lambda owner: True)
            self.assertEqual(first, ring.owners[point])
            second = {ring.place(point, lambda owner: owner != first) for _ in range(3)}
            self.assertEqual(len(second - {first}), 1)
            self.assertEqual(ring.place(point, lambda owner: False), first)

    def test_bounds_add_up_to_the_factor(self):
        for replicas in (1, 3, 7):
            for total in (10, 99, 1000):
                most = [most_requests(index, replicas, total, 150) for index in range(replicas)]
                self.assertEqual(sum(most), ((total + 1) * 150 + 99) // 100)
                self.assertLessEqual(max(most) - min(most), 1)
        self.assertEqual(most_requests(0, 100, 0, 150), 1)


if __name__ == "__main__":
    unittest.main()

"""The simulation of many replicas beside what is known without it."""

import unittest

try:
    from fleet_model import Autoscaler, Fleet, Model, Services

    MISSING = ""
except ImportError as error:
    MISSING = f"{error}: apt-get install python3-simpy python3-numpy"


def ten_ms(**more):
    return Services(**({"frame": [10.0], "load": [30.0], "first": [5.0], "http": [0.0]} | more))


def mean(values):
    return sum(values) / len(values)


@unittest.skipIf(MISSING, MISSING)
class FleetModel(unittest.TestCase):
    def test_one_replica_is_the_queue_of_the_textbook(self):
        """M/D/1 at half its load: the mean wait is half a frame's time."""
        outcome = Model(Fleet(1, 5, 50.0, 400.0, ten_ms(), held=5)).run()
        self.assertEqual(outcome.hit_rate(), 1)
        self.assertAlmostEqual(mean(outcome.seconds), 0.015, delta=0.0006)

    def test_a_scene_that_is_not_there_is_loaded_once(self):
        trace = [(0.0, 0), (0.001, 0), (1.0, 0), (2.0, 1), (3.0, 0)]
        outcome = Model(Fleet(1, 2, 0, 0, ten_ms(), held=1, warm=False, trace=trace)).run()
        rounded = [round(1000 * each) for each in outcome.seconds]
        self.assertEqual((outcome.loads, outcome.hits), (3, 1))
        self.assertEqual(rounded, [45, 54, 10, 45, 45])  # the second waits for the same load, and for the first frame

    def test_the_store_does_one_thing_at_a_time(self):
        trace = [(0.0, each) for each in range(8)]
        outcome = Model(Fleet(4, 8, 0, 0, ten_ms(store=100.0), held=9, factor=0, warm=False, trace=trace)).run()
        self.assertAlmostEqual(max(outcome.seconds), 0.8 + 0.045, delta=0.02)

    def test_by_scene_memories_add_up_and_in_turn_they_do_not(self):
        rates = {factor: Model(Fleet(5, 500, 100.0, 60.0, ten_ms(), held=120, factor=factor, ignore=10.0)).run()
                 for factor in (0, 400)}  # fmt: skip
        hit = {factor: outcome.hit_rate() for factor, outcome in rates.items()}
        self.assertGreater(hit[400], 0.95)
        self.assertLess(hit[0], 0.75)

    def test_no_frame_is_lost_with_a_replica(self):
        fleet = Fleet(5, 100, 200.0, 120.0, ten_ms(), held=100, mean_life=100.0)
        outcome = Model(fleet).run()
        self.assertGreater(outcome.retried, 0)
        self.assertGreater(len(outcome.seconds), 0.99 * outcome.asked)
        self.assertLess(min(count for _, count in outcome.counts), 5)

    def test_the_autoscaler_follows_the_load(self):
        fleet = Fleet(2, 50, lambda second: 240.0 if 100 < second < 300 else 60.0, 600.0, ten_ms(), held=50,
                      autoscaler=Autoscaler(20.0, least=2, most=30, calm=60.0))  # fmt: skip
        outcome = Model(fleet).run()
        self.assertGreaterEqual(max(count for second, count in outcome.counts if 100 < second < 300), 3)
        self.assertEqual(outcome.counts[-1][1], 2)

    def test_without_a_replica_frames_are_refused(self):
        outcome = Model(Fleet(1, 5, 20.0, 60.0, ten_ms(), held=5, mean_life=20.0)).run()
        self.assertGreater(outcome.refused, 50)
        self.assertLessEqual(outcome.refused + len(outcome.seconds), outcome.asked)


if __name__ == "__main__":
    unittest.main()

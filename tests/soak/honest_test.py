"""What the soak counts of clients whose attempts fail: the client goes on, and only one that was never served is a fault."""

import sys
import threading
import time
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
from honest import Client, Program, Tally, never_served  # noqa: E402


def program(tally, stop, *command):
    return Program("page", tally, stop, 0.01, [sys.executable, "-c", *command], patience=1)


def run_until(client, stop, is_done):
    """Lets a client try again and again until it is done; False where that takes too long."""
    client.start()
    end = time.monotonic() + 30
    while not is_done() and time.monotonic() < end:
        time.sleep(0.01)
    stop.set()
    client.join(30)
    return is_done() and not client.is_alive()


class Attempts(unittest.TestCase):
    def setUp(self):
        self.tally, self.stop = Tally(), threading.Event()

    def count(self, outcome):
        return self.tally.outcomes.get(("page", outcome), 0)

    def test_a_program_that_does_not_end_is_counted_and_tried_again(self):
        page = program(self.tally, self.stop, "import time; time.sleep(600)")
        self.assertTrue(run_until(page, self.stop, lambda: self.count("not done within 1 s") >= 2))
        self.assertEqual(never_served(self.tally, [page]), ["page was never served"])
        self.assertEqual(self.tally.broken, [])

    def test_what_a_program_started_ends_with_it(self):
        started = "import subprocess, sys; subprocess.run([sys.executable, '-c', 'import time; time.sleep(600)'])"
        begun = time.monotonic()
        program(self.tally, self.stop, started).step()
        self.assertLess(time.monotonic() - begun, 30)  # the pipes that both hold are closed
        self.assertEqual(self.count("not done within 1 s"), 1)

    def test_one_served_attempt_among_failed_ones_is_enough(self):
        here = str(Path(__file__).resolve())
        for command in ("import time; time.sleep(600)", f"open({here!r})", "raise SystemExit('no')"):
            page = program(self.tally, self.stop, command)
            page.step()
        self.assertEqual((self.count("not done within 1 s"), self.count("served")), (1, 1))
        self.assertEqual(self.count("ended with 1: no"), 1)
        self.assertEqual(never_served(self.tally, [page]), [])

    def test_a_client_goes_on_after_a_reply_that_it_cannot_read(self):
        class Confused(Client):
            def step(self):
                raise ValueError("no JSON")

        client = Confused("page", self.tally, self.stop, 0.01)
        self.assertTrue(run_until(client, self.stop, lambda: len(self.tally.broken) >= 2))
        self.assertIn("no JSON", self.tally.broken[0][1])


if __name__ == "__main__":
    unittest.main()

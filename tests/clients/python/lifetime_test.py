"""A server that Python starts ends with it, however it ends, and not before."""

import os
import signal
import subprocess
import sys
import tempfile
import textwrap
import time
import unittest
from pathlib import Path

import numpy as np
from shipped_server import SCENES, SLOW, TIMEOUT, await_end, started_by, still_running

import gnomon

BOX = SCENES / "box_on_plane.glb"
SMALL = {"width": 64, "height": 48}
SECONDS = 2 * SLOW  # until nothing of a server is left

# What programs begin with: a server that has drawn a frame; then they say so.
BEGIN = f"""
import os, signal, subprocess, sys, threading, time
import gnomon
session = gnomon.Session(flags=["--device", "cpu"])
session.frame({str(BOX)!r}, width=64, height=48)
def ready(): print("ready", flush=True)
"""
LONG = """
light = {"sun": {}, "angularDiameterDegrees": 60}
shadow = {"technique": "rayTraced", "raySamples": 1024}
threading.Thread(target=session.frame, args=(%r,), kwargs=dict(width=4096, height=4096, lights=[light] * 20, shadow=shadow)).start()
time.sleep(1)
""" % str(BOX)


def words_of(process):
    return Path(f"/proc/{process[0]}/cmdline").read_bytes().split(b"\0")


class Python:
    """A Python program with a server of its own, once it says that it is ready."""

    def __init__(self, *arguments):
        self.process = subprocess.Popen([sys.executable, "-B", *arguments], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True)
        if not any(line.strip().endswith("ready") for line in self.process.stdout):
            raise AssertionError(self.process.stderr.read())
        started = started_by(self.process.pid)
        self.server = {each for each in started if {b"serve", b"worker"}.intersection(words_of(each))}
        self.others = started - self.server

    def go_on(self):
        self.process.stdin.write("\n")
        self.process.stdin.flush()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait(TIMEOUT)
        for pid, _ in still_running(self.others | self.server):
            os.kill(pid, signal.SIGKILL)
        for each in (self.process.stdin, self.process.stdout, self.process.stderr):
            each.close()


def program(text):
    return Python("-c", BEGIN + textwrap.dedent(text))


class LifetimeTest(unittest.TestCase):
    def assert_gone(self, python):
        self.assertGreater(len(python.server), 2, "a server and its workers")
        self.assertEqual(await_end(python.server, SECONDS), set())


class WithPython(LifetimeTest):
    def test_python_is_killed(self):
        for case, text in {
            "while it does nothing": "ready(); time.sleep(600)",
            "while it waits for a long frame": LONG + "ready(); time.sleep(600)",
            "and the thread that started the server has ended": """
                more = []
                thread = threading.Thread(target=lambda: more.append(gnomon.LocalServer("--device", "cpu")))
                thread.start(); thread.join(); time.sleep(0.5); ready(); time.sleep(600)""",
            "with a process that it has forked": """
                if os.fork() == 0: time.sleep(600)
                ready(); time.sleep(600)""",
            "with a program that it has started": """
                subprocess.Popen(["sleep", "600"], close_fds=False); ready(); time.sleep(600)""",
            "with a pool of processes": """
                import multiprocessing
                pool = multiprocessing.get_context("fork").Pool(2); pool.map(abs, range(4)); ready(); time.sleep(600)""",
        }.items():
            with self.subTest(case), program(text) as python:
                self.assertEqual(still_running(python.server), python.server)
                python.process.kill()
                self.assert_gone(python)
                if "pool" not in case:  # which ends with its master
                    self.assertEqual(still_running(python.others), python.others)

    def test_python_ends_by_itself(self):
        for case, text in {
            "at the end of the program": "",
            "by an exception": "raise SystemExit(3)",
            "without any clean-up": "os._exit(3)",
            "by an abort": "os.abort()",
            "by an exception while it ends": """
                class Last:
                    def __del__(self): raise ValueError
                last = Last(); import atexit; atexit.register(lambda: 1 / 0); raise KeyError("x")""",
            "and becomes another program": 'os.execvp("sleep", ["sleep", "600"])',
            "with threads that go on": """
                threading.Thread(target=lambda: [session.frame(%r, width=64, height=48) for _ in range(9)]).start()""" % str(BOX),
        }.items():
            with self.subTest(case), program("ready(); sys.stdin.readline()\n" + textwrap.dedent(text)) as python:
                python.go_on()
                if "another program" not in case:
                    python.process.wait(TIMEOUT)
                self.assert_gone(python)

    def test_a_session_that_is_forgotten(self):
        with program("ready(); sys.stdin.readline(); del session; time.sleep(600)") as python:
            python.go_on()
            self.assert_gone(python)
            self.assertIsNone(python.process.poll())

    def test_pytest_is_killed(self):
        with tempfile.TemporaryDirectory() as folder:
            test = Path(folder) / "test_it.py"
            test.write_text(f"""
import time
def test_it(gnomon_session):
    gnomon_session.frame({str(BOX)!r}, width=64, height=48)
    print("ready", flush=True)
    time.sleep(600)
""")
            pytest = ("-m", "pytest", "-s", "-q", "-p", "no:cacheprovider", "-p", "gnomon.pytest_plugin")
            with Python(*pytest, test) as python:
                python.process.kill()
                self.assert_gone(python)


class WithoutPython(LifetimeTest):
    def test_a_front_that_is_killed_takes_its_workers_along(self):
        for case, text in {"while they do nothing": "ready(); time.sleep(600)",
                           "while they draw": LONG + "ready(); time.sleep(600)"}.items():
            with self.subTest(case), program(text) as python:
                front, = (pid for pid, begun in python.server if b"serve" in words_of((pid, begun)))
                os.kill(front, signal.SIGKILL)
                self.assert_gone(python)


class InTime(unittest.TestCase):
    def test_a_forked_process_draws_and_leaves_the_server_to_its_parent(self):
        with gnomon.Session(flags=["--device", "cpu"]) as session:
            expected = session.frame(BOX, **SMALL).color
            for _ in range(3):
                child = os.fork()
                if child == 0:
                    status = 1
                    try:
                        same = all(np.array_equal(session.frame(BOX, **SMALL).color, expected) for _ in range(3))
                        session.close()
                        status = 0 if same else 2
                    finally:
                        os._exit(status)
                np.testing.assert_array_equal(session.frame(BOX, **SMALL).color, expected)
                self.assertEqual(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), 0)
            np.testing.assert_array_equal(session.frame(BOX, **SMALL).color, expected)

    def test_a_server_ends_in_time_where_nothing_holds_its_standard_input(self):
        begun = time.monotonic()
        ended = subprocess.run([os.environ["GNOMON_BINARY"], "serve", "--until-stdin-closes", "--port", "0", "--device", "cpu"],
                               stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=TIMEOUT,
                               env={"PATH": os.environ["PATH"]})
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertIn("Standard input was closed", ended.stderr)
        self.assertLess(time.monotonic() - begun, 5 * SLOW)


if __name__ == "__main__":
    unittest.main()

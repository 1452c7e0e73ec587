"""Rights that a system may refuse, as containers do even to root. What takes one begins with a call of these, in a subTest
of its own where the rest of the test needs none: it is skipped, with the name of the right that is missing."""

import unittest
from pathlib import Path

SYS_PTRACE = 19  # the bit of CAP_SYS_PTRACE


def has_capability(number):
    """Whether this process may use one of capabilities(7)."""
    lines = Path("/proc/self/status").read_text().splitlines()
    (effective,) = [line.split()[1] for line in lines if line.startswith("CapEff:")]
    return bool(int(effective, 16) >> number & 1)


def needs_to_see_closed_processes():
    """Variables, descriptors and maps in /proc of processes that are not dumpable, as servers and their workers are."""
    if not has_capability(SYS_PTRACE):
        raise unittest.SkipTest("CAP_SYS_PTRACE is missing, which looking into the server's processes takes")

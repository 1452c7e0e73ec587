"""Memory limits of control groups (cgroups(7), version 1 or 2), as containers have them."""

import os
import time
from pathlib import Path

ROOT = Path("/sys/fs/cgroup")


def folder_of(pid):
    """The group that limits the memory of a process."""
    groups = dict(line.split(":", 2)[1:] for line in Path(f"/proc/{pid}/cgroup").read_text().splitlines())
    if "memory" in groups:
        return ROOT / "memory" / groups["memory"].lstrip("/")
    return ROOT / groups[""].lstrip("/")


def killed(pid):
    """How many processes the kernel has killed, for want of memory, in the group of a process."""
    for name in ("memory.events", "memory.oom_control"):
        file = folder_of(pid) / name
        if file.is_file():
            return int(dict(line.split() for line in file.read_text().splitlines()).get("oom_kill", 0))
    return 0


class MemoryGroup:
    """A group for processes that are started with `enter`; OSError, with the reason, where the system has none to give."""

    def __init__(self, name, limit):
        first = (ROOT / "memory").is_dir()
        self.folder = (ROOT / "memory" if first else ROOT) / f"{name}-{os.getpid()}"
        self.folder.mkdir()
        try:
            setting = self.folder / ("memory.limit_in_bytes" if first else "memory.max")
            if not setting.exists():
                raise FileNotFoundError(f"{setting.parent.parent} gives its groups no limit of memory")
            setting.write_text(str(limit))
        except OSError:
            self.folder.rmdir()
            raise

    def enter(self):
        (self.folder / "cgroup.procs").write_text(str(os.getpid()))

    def close(self):
        """Once all its processes are gone, which may take a moment."""
        for _ in range(100):
            try:
                return self.folder.rmdir()
            except OSError:
                time.sleep(0.1)
        raise TimeoutError(f"{self.folder} has processes still")

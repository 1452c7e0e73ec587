"""The server under test: a process of this machine or a container, with its store on a disk of its own."""

import http.client
import json
import os
import signal
import socket
import subprocess
import tempfile
import time
import urllib.request
from pathlib import Path

from memory_group import MemoryGroup, killed

DISK_BYTES = 96 << 20
MEMORY_BYTES = 1 << 30  # of the front and its workers together
PATIENCE = 30  # seconds, for the front to end
DESCRIPTORS = 1024  # of the front: fewer than the connections that hostile clients open


def free_port():
    with socket.create_server(("127.0.0.1", 0)) as taken:
        return taken.getsockname()[1]


PORT = free_port()  # the same over a restart, so that clients find the server again


def pss_bytes(pid):
    """What a process has in memory, shared pages counted in parts; 0 once it is gone."""
    try:
        for line in Path(f"/proc/{pid}/smaps_rollup").read_text().splitlines():
            if line.startswith("Pss:"):
                return int(line.split()[1]) * 1024
    except OSError:
        pass
    return 0


def memory_group():
    """None, and a line, where this system lets us limit no memory."""
    try:
        return MemoryGroup("gnomon-soak", MEMORY_BYTES)
    except OSError as error:
        print(f"the server's memory is not limited: {error}")
        return None


def children(pid):
    """Those of all its threads."""
    found = []
    for task in Path(f"/proc/{pid}/task").glob("*/children"):
        try:
            found += [int(child) for child in task.read_text().split()]
        except OSError:
            pass  # the thread has ended
    return found


class Service:
    """`gnomon serve` on one port. `image`: in a container of 1 GiB, with the network of this machine."""

    def __init__(self, binary, image=None):
        self.binary, self.image = binary, image
        self.url = f"http://127.0.0.1:{PORT}"
        self.folder = tempfile.TemporaryDirectory()
        self.store = Path(self.folder.name) / "store"
        self.store.mkdir()
        self.has_disk = os.getuid() == 0 and self.mount()
        os.chown(self.store, 65532, 65532) if image else None
        self.log = open(Path(self.folder.name) / "log", "ab")
        self.container = None
        self.pid = 0
        self.starved = 0  # processes that the kernel killed for want of memory
        self.group = None if image else memory_group()
        self.is_limited = image is not None or self.group is not None

    def mount(self):
        done = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={DISK_BYTES}", "none", str(self.store)], check=False)
        return done.returncode == 0

    def start(self):
        flags = ["--port", str(PORT), "--workers", "2", "--request-timeout", "20", "--reply-cache-bytes", "32MB"]
        if self.image:
            command = ["podman", "run", "-d", "--network", "host", "--read-only", "--tmpfs", "/tmp:rw,size=64m,mode=1777",
                       "--cap-drop=ALL", "--security-opt=no-new-privileges", "--pids-limit", "1024", "--memory", str(MEMORY_BYTES),
                       "--memory-swap", str(MEMORY_BYTES), "--ulimit", f"nofile={DESCRIPTORS}:{DESCRIPTORS}",
                       "--ulimit", "nproc=4096:4096", "-v", f"{self.store}:/var/lib/gnomon", self.image, "serve",
                       "--store", "/var/lib/gnomon", *flags]  # fmt: skip
            self.container = subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()
            self.pid = int(self.inspected("{{.State.Pid}}"))
        else:
            liar = Path(self.binary).with_name("gnomon_faulty_worker")
            flags += ["--worker-program", str(liar)] if liar.exists() else []
            command = ["prlimit", f"--nofile={DESCRIPTORS}", self.binary, "serve", "--store", str(self.store), *flags]
            self.process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=self.log,
                                            preexec_fn=self.group and self.group.enter)  # fmt: skip
            self.pid = self.process.pid
        self.await_ready()

    def inspected(self, form):
        return subprocess.run(["podman", "inspect", self.container, "--format", form],
                              check=True, capture_output=True, text=True).stdout.strip()  # fmt: skip

    def await_ready(self):
        for _ in range(300):
            try:
                with urllib.request.urlopen(self.url + "/readyz", timeout=2):
                    return
            except (OSError, http.client.HTTPException):
                time.sleep(0.1)
        raise SystemExit("soak: the server does not become ready")

    def memory(self):
        return sum(pss_bytes(pid) for pid in [self.pid, *children(self.pid)])

    def kill_workers(self):
        """How many were killed."""
        workers = children(self.pid)
        for pid in workers:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        return len(workers)

    def status_by(self, patience):
        """The exit status; TimeoutExpired where there is none by then."""
        if not self.image:
            return self.process.wait(patience)
        subprocess.run(["podman", "wait", self.container], check=True, capture_output=True, timeout=patience)
        return int(self.inspected("{{.State.ExitCode}}"))

    def end(self, number):
        """The exit status of the front after a signal, None where it has to be killed; what it left is gone, too."""
        if self.is_limited:
            self.starved += killed(self.pid)
        os.kill(self.pid, number)
        try:
            status = self.status_by(PATIENCE)
        except subprocess.TimeoutExpired:
            os.kill(self.pid, signal.SIGKILL)
            self.status_by(None)
            status = None
        if not self.image:
            return status
        self.log.write(subprocess.run(["podman", "logs", self.container], check=False, capture_output=True).stderr)
        subprocess.run(["podman", "rm", "-f", self.container], check=True, capture_output=True)
        return status

    def close(self):
        self.log.close()
        if self.group:
            self.group.close()
        if self.has_disk:
            subprocess.run(["umount", str(self.store)], check=True)
        self.folder.cleanup()

    def log_events(self):
        """How often the log tells of each kind of event."""
        counts = {}
        self.log.flush()
        with open(self.log.name, "rb") as lines:
            for line in lines:
                if line.startswith(b'{"event"') or b'"event":' in line[:200]:
                    event = json.loads(line).get("event")
                    counts[event] = counts.get(event, 0) + 1
        return counts

    def fill_disk(self):
        """Takes all that is left of the store's disk; gives the file."""
        filler = self.store / "filler"
        with open(filler, "wb") as file:
            try:
                while True:
                    file.write(bytes(1 << 20))
                    file.flush()
            except OSError:
                pass
        return filler

"""What systemd gets over a real NOTIFY_SOCKET, and what it says of the unit and does with it."""

import hashlib
import http.client
import os
import re
import shutil
import signal
import socket
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from shipped_server import SLOW, TIMEOUT, Server



def until(holds, seconds):
    """Whether it holds within so many seconds."""
    end = time.monotonic() + seconds
    while not holds():
        if time.monotonic() > end:
            return False
        time.sleep(0.05)
    return True


UNIT = Path(__file__).resolve().parents[2] / "server" / "deploy" / "gnomon.service"


class Notifications(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self.addCleanup(self.socket.close)
        self.socket.bind(str(self.folder / "notify"))
        self.socket.settimeout(TIMEOUT)

    def server(self, *flags, **variables):
        return Server("--device", "cpu", *flags, variables={"NOTIFY_SOCKET": str(self.folder / "notify")} | variables)

    def await_line(self, wanted):
        """Waits for a notification that has this line; its lines."""
        while True:
            lines = self.socket.recv(4096).decode().splitlines()
            if wanted in lines:
                return lines

    def drained(self, seconds):
        """How many pings come in this time."""
        end, count = time.monotonic() + seconds, 0
        while (left := end - time.monotonic()) > 0:
            self.socket.settimeout(left)
            try:
                count += self.socket.recv(4096) == b"WATCHDOG=1"
            except TimeoutError:
                break
        self.socket.settimeout(TIMEOUT)
        return count

    def test_ready_comes_when_it_serves_and_stopping_when_it_ends(self):
        with self.server() as server:
            lines = self.await_line("READY=1")
            self.assertTrue(any(line.startswith("STATUS=listening on http://127.0.0.1:") for line in lines), lines)
            self.assertEqual(server.get("/readyz").status, 200)
            server.process.send_signal(signal.SIGTERM)
            lines = self.await_line("STOPPING=1")
            extended = next(line for line in lines if line.startswith("EXTEND_TIMEOUT_USEC="))
            self.assertEqual(int(extended.split("=")[1]), 10_000_000)
            self.assertEqual(server.process.wait(TIMEOUT), 0)

    def test_hangup_reloads_with_keys_and_without(self):
        keys = self.folder / "keys"
        keys.write_text(f"name=a sha256={'0' * 64} scopes=read\n")
        for flags in ((), ("--keys", str(keys))):
            with self.server(*flags) as server:
                self.await_line("READY=1")
                server.process.send_signal(signal.SIGHUP)
                lines = self.await_line("RELOADING=1")
                at = next(line for line in lines if line.startswith("MONOTONIC_USEC="))
                self.assertLess(abs(time.monotonic() - int(at.split("=")[1]) / 1e6), 5 * SLOW)
                self.await_line("READY=1")
                self.assertEqual(server.get("/livez").status, 200)
                self.assertEqual(server.end(), 0)

    def test_the_watchdog_hears_of_it_while_it_answers_and_no_longer(self):
        with self.server(WATCHDOG_USEC="600000") as server:
            self.await_line("READY=1")
            self.assertGreaterEqual(self.drained(2 * SLOW), 4)
            server.process.send_signal(signal.SIGTERM)
            self.await_line("STOPPING=1")
            self.assertEqual(server.process.wait(TIMEOUT), 0)

    @unittest.skipIf(SLOW > 1, "sanitizers want to be loaded first")
    def test_a_server_whose_listener_is_stuck_is_not_well(self):
        compiler = shutil.which("cc")
        self.assertIsNotNone(compiler, "a C compiler makes the library that lets accept() hang")
        source, library, stuck = self.folder / "hang.c", self.folder / "hang.so", self.folder / "stuck"
        source.write_text("""
            #define _GNU_SOURCE
            #include <dlfcn.h>
            #include <stdlib.h>
            #include <sys/socket.h>
            #include <unistd.h>
            int accept4(int fd, struct sockaddr *address, socklen_t *length, int flags) {
              int (*real)(int, struct sockaddr *, socklen_t *, int) = dlsym(RTLD_NEXT, "accept4");
              while (access(getenv("STUCK"), F_OK) == 0) usleep(50000);
              return real(fd, address, length, flags);
            }
            """)
        subprocess.run([compiler, "-shared", "-fPIC", "-o", library, source, "-ldl"], check=True)
        with self.server(WATCHDOG_USEC="600000", LD_PRELOAD=str(library), STUCK=str(stuck)) as server:
            self.await_line("READY=1")
            self.assertGreaterEqual(self.drained(2), 4)
            stuck.touch()
            self.drained(1)  # a ping that was on its way
            self.assertEqual(self.drained(2), 0)
            stuck.unlink()
            self.assertGreaterEqual(self.drained(2), 2)
            self.assertEqual(server.end(), 0)

    def test_without_a_watchdog_nothing_pings(self):
        with self.server() as server:
            self.await_line("READY=1")
            self.assertEqual(self.drained(1), 0)
            self.assertEqual(server.end(), 0)


class Unit(unittest.TestCase):
    @unittest.skipUnless(shutil.which("systemd-analyze"), "systemd is not installed")
    def test_its_exposure_is_low(self):
        done = subprocess.run(["systemd-analyze", "security", "--offline=true", "--no-pager", "--threshold=25", str(UNIT)],
                              capture_output=True, text=True, timeout=TIMEOUT)  # fmt: skip
        self.assertEqual(done.returncode, 0, done.stdout[-6000:] + done.stderr)
        exposure = float(re.search(r"Overall exposure level for .*: ([0-9.]+)", done.stdout)[1])
        self.assertLess(exposure, 2.5)

    @unittest.skipUnless(shutil.which("systemd-analyze"), "systemd is not installed")
    def test_systemd_understands_every_line(self):
        with tempfile.TemporaryDirectory() as folder:
            copy = Path(folder) / "gnomon.service"
            binary = os.environ["GNOMON_BINARY"]
            copy.write_text(UNIT.read_text().replace("/usr/bin/gnomon", binary))
            done = subprocess.run(["systemd-analyze", "verify", "--man=no", str(copy)], capture_output=True, text=True,
                                  timeout=TIMEOUT)  # fmt: skip
            faults = [line for line in done.stderr.splitlines() if "gnomon.service" in line]
            self.assertEqual(faults, [])

    def test_it_gives_the_server_the_time_that_it_takes_to_stop(self):
        unit = UNIT.read_text()
        self.assertIn("Type=notify\n", unit)
        self.assertGreater(int(re.search(r"^TimeoutStopSec=(\d+)$", unit, re.MULTILINE)[1]), 10)



# systemd in namespaces of its own: with this machine's network and programs, and copies of whatever it writes to.
BOOT = """
set -e
mount --make-rprivate /
mount --make-rshared /
mount -t tmpfs -o mode=755 tmpfs /run
mkdir -p /run/units
for each in default sysinit basic shutdown; do
  printf '[Unit]\\nDefaultDependencies=no\\n' > /run/units/$each.target
done
install "$1" /run/gnomon
sed 's#/usr/bin/gnomon#/run/gnomon#' "$2" > /run/units/gnomon.service
cp -a /etc /run/etc
mount --bind /run/etc /etc
mount -t tmpfs tmpfs /tmp
mount -t tmpfs tmpfs /var
mkdir /var/lib /var/tmp
export container=other SYSTEMD_UNIT_PATH=/run/units
exec /lib/systemd/systemd --system --log-target=null
"""


@unittest.skipUnless(os.geteuid() == 0 and Path("/lib/systemd/systemd").exists(), "this takes root and systemd")
@unittest.skipIf(SLOW > 1, "sanitizers want more than the unit allows")
class UnderSystemd(unittest.TestCase):
    """The unit as it is, under a systemd of its own."""

    def setUp(self):
        spaces = ["unshare", "--pid", "--mount", "--uts", "--ipc", "--fork", "--mount-proc", "--kill-child=KILL"]
        self.outer = subprocess.Popen([*spaces, "sh", "-c", BOOT, "boot", os.environ["GNOMON_BINARY"], UNIT],
                                      stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # fmt: skip
        self.addCleanup(self.end)
        if not until(lambda: self.inside("systemctl", "show", "-p", "Version").returncode == 0, 10):
            self.skipTest("systemd does not run here")
        with socket.create_server(("127.0.0.1", 0)) as free:
            self.port = free.getsockname()[1]
        self.configure("")

    def end(self):
        self.outer.kill()
        self.outer.wait(TIMEOUT)

    def inside(self, *command, text=None):
        children = Path(f"/proc/{self.outer.pid}/task/{self.outer.pid}/children").read_text().split()
        if not children:
            return subprocess.CompletedProcess(command, 1)
        return subprocess.run(["nsenter", "-t", children[0], "--mount", "--pid", *command], input=text, capture_output=True,
                              text=True, timeout=TIMEOUT)  # fmt: skip

    def write(self, path, text, mode="644"):
        done = self.inside("sh", "-c", f"mkdir -p $(dirname {path}) && umask 077 && cat > {path} && chmod {mode} {path}", text=text)
        self.assertEqual(done.returncode, 0, done.stderr)

    def configure(self, more):
        self.write("/etc/gnomon/gnomon.conf", f"port = {self.port}\nstore = '/var/lib/gnomon'\ndevice = 'cpu'\n{more}")

    def write_keys(self, *names, mode="600"):
        digest = lambda name: hashlib.sha256(name.encode()).hexdigest()  # noqa: E731
        self.write("/etc/gnomon/keys", "".join(f"name={name} sha256={digest(name)} scopes=read\n" for name in names), mode)

    def add(self, *lines):
        """A drop-in."""
        self.write("/run/units/gnomon.service.d/own.conf", "\n".join(["[Service]", *lines]) + "\n")
        self.systemctl("daemon-reload")

    def systemctl(self, *command):
        done = self.inside("systemctl", *command)
        self.assertEqual(done.returncode, 0, (command, done.stderr, self.shown()))

    def shown(self):
        text = self.inside("systemctl", "show", "gnomon", "-p", "NRestarts,ExecMainStatus,ActiveState,SubState,MainPID").stdout
        return dict(line.split("=", 1) for line in text.splitlines())

    def status_for(self, secret):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=TIMEOUT)
        connection.request("GET", "/v1/scenes", headers={"Authorization": f"Bearer {secret}"})
        status = connection.getresponse().status
        connection.close()
        return status

    def test_keys_that_root_alone_may_read_are_handed_over(self):
        self.write_keys("old")
        self.add("LoadCredential=keys:/etc/gnomon/keys", "Environment=GNOMON_KEYS=%d/keys")
        self.systemctl("start", "gnomon")
        self.assertEqual([self.status_for(name) for name in ("old", "new")], [200, 401])
        self.write_keys("new")
        self.systemctl("reload", "gnomon")
        self.assertEqual([self.status_for(name) for name in ("old", "new")], [200, 401], "it is the copy of the start")
        self.systemctl("restart", "gnomon")
        self.assertEqual([self.status_for(name) for name in ("old", "new")], [401, 200])
        self.systemctl("stop", "gnomon")
        self.assertEqual((self.shown()["ActiveState"], self.shown()["ExecMainStatus"]), ("inactive", "0"))

    def test_keys_of_a_group_are_read_again(self):
        self.assertEqual(self.inside("groupadd", "--system", "gnomon-keys").returncode, 0)
        self.write_keys("old", mode="640")
        self.assertEqual(self.inside("chgrp", "gnomon-keys", "/etc/gnomon/keys").returncode, 0)
        self.add("SupplementaryGroups=gnomon-keys", "Environment=GNOMON_KEYS=/etc/gnomon/keys")
        self.systemctl("start", "gnomon")
        self.assertEqual([self.status_for(name) for name in ("old", "new")], [200, 401])
        self.write_keys("new", mode="640")
        self.systemctl("reload", "gnomon")
        self.assertTrue(until(lambda: [self.status_for(name) for name in ("old", "new")] == [401, 200], TIMEOUT))

    def test_a_reload_without_keys_ends_nothing(self):
        self.systemctl("start", "gnomon")
        before = self.shown()["MainPID"]
        self.systemctl("reload", "gnomon")
        self.assertEqual(self.status_for("any"), 200)
        self.assertEqual((self.shown()["MainPID"], self.shown()["NRestarts"]), (before, "0"))

    def test_a_server_that_says_nothing_is_started_again(self):
        self.add("WatchdogSec=2")
        self.systemctl("start", "gnomon")
        before = self.shown()["MainPID"]
        self.assertEqual(self.inside("kill", "-STOP", before).returncode, 0)
        self.assertTrue(until(lambda: self.shown()["NRestarts"] == "1" and self.shown()["SubState"] == "running", TIMEOUT))
        self.assertNotEqual(self.shown()["MainPID"], before)
        self.assertEqual(self.status_for("any"), 200)

    def test_wrong_options_start_nothing_again_but_a_taken_port_does(self):
        for wrong in ("trusted-proxies = 'foo'", "keys = '/nowhere'", "max-scene-bytes = -1", "admin-bind = '0.0.0.0'"):
            self.configure(wrong)
            self.assertNotEqual(self.inside("systemctl", "start", "gnomon").returncode, 0, wrong)
            time.sleep(0.5)  # RestartSec= is 0.1 s
            shown = self.shown()
            self.assertEqual((shown["ExecMainStatus"], shown["ActiveState"], shown["NRestarts"]), ("2", "failed", "0"), wrong)
        self.configure("")
        with socket.create_server(("127.0.0.1", self.port)):
            self.assertNotEqual(self.inside("systemctl", "start", "gnomon").returncode, 0)
            self.assertTrue(until(lambda: int(self.shown()["NRestarts"]) > 0, TIMEOUT))
            self.assertEqual(self.shown()["ExecMainStatus"], "1")


if __name__ == "__main__":
    unittest.main()

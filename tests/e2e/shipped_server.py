"""The shipped binary as a test meets it: started on a free port, spoken to over HTTP, ended by a signal."""

import http.client
import json
import os
import signal
import socket
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

BINARY = os.environ["GNOMON_BINARY"]
SCENES = Path(os.environ["GNOMON_TEST_SCENES"])
SLOW = int(os.environ.get("GNOMON_SLOWNESS", "1"))  # sanitizers: how many times longer everything may take
TIMEOUT = 60 * SLOW  # seconds


def environment(**more):
    """That of the tests without their own GNOMON_ variables, of which the server would know none, without what a user
    has configured, and with further ones."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith("GNOMON_")}
    return kept | {"XDG_CONFIG_HOME": "/nonexistent"} | more


def written(file):
    """The text so far of a file that a program writes. A seek would move the place where the program writes next, since
    both have the same offset: lines were lost so."""
    descriptor = file.fileno()
    return os.pread(descriptor, os.fstat(descriptor).st_size, 0).decode("utf-8", "replace")


class Reply:
    def __init__(self, status, headers, body):
        lists = {"Vary"}  # which may come in several lines (RFC 9110, 5.3)
        twice = {name for name in headers.keys() if len(headers.get_all(name)) > 1} - lists
        assert not twice, f"headers that came twice: {twice}"
        self.status = status
        self.headers = headers  # email.message.Message: names in any case
        self.body = body

    def json(self):
        return json.loads(self.body)

    def pointers(self):
        return [problem["pointer"] for problem in self.json()["problems"]]


class Server:
    """`gnomon serve` with further flags, on any free port unless one is given, with further variables in its
    environment, no more than `descriptors` where that is given, and by a program that executes it if `by` has one. Use it
    in a `with` statement."""

    def __init__(self, *flags, port=0, variables=None, descriptors=None, by=()):
        self.log = tempfile.TemporaryFile()
        limited = [] if descriptors is None else ["prlimit", f"--nofile={descriptors}"]
        self.process = subprocess.Popen(
            [*by, *limited, BINARY, "serve", "--until-stdin-closes", "--port", str(port), *flags],
            stdin=subprocess.PIPE,  # open until the tests end, however they end
            stdout=subprocess.PIPE,
            stderr=self.log,
            text=True,
            env=environment(**(variables or {})),
        )
        line = self.process.stdout.readline()  # printed once requests are taken
        if not line.startswith("listening on http://"):
            self.process.wait(TIMEOUT)
            log = self.log_text()
            self.__exit__()
            raise AssertionError(f"the server did not start: {line!r}\n{log}")
        host, port = line.removeprefix("listening on http://").strip().rsplit(":", 1)
        self.address = (host, int(port))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait(TIMEOUT)
        self.process.stdin.close()
        self.process.stdout.close()
        self.log.close()

    def end(self, number=signal.SIGTERM):
        """The exit status after a signal."""
        self.process.send_signal(number)
        return self.process.wait(TIMEOUT)

    def log_text(self):
        return written(self.log)

    def log_has(self, words):
        """Waits until the log has the words: it is written beside the replies."""
        end = time.monotonic() + TIMEOUT
        while words not in self.log_text():
            if time.monotonic() > end:
                raise AssertionError(f"the log has no {words!r}:\n" + self.log_text())
            time.sleep(0.01)
        return True

    def settled_log(self):
        """The log once it holds all that came before: lines are gathered for a moment."""
        marker = f"settled-{time.monotonic_ns()}"
        self.get("/livez", X_Request_ID=marker)
        self.request_line(marker)
        return self.log_text()

    def log_lines(self):
        return [json.loads(line) for line in self.log_text().splitlines() if line.startswith("{")]

    def request_line(self, request_id):
        """The log's line of a request, which is written after its reply is sent."""
        end = time.monotonic() + TIMEOUT
        while time.monotonic() < end:
            for line in self.log_lines():
                if line.get("id") == request_id:
                    return line
            time.sleep(0.01)
        raise AssertionError("the log has no line of this request:\n" + self.log_text())

    def resident_bytes(self):
        for line in Path(f"/proc/{self.process.pid}/status").read_text().splitlines():
            if line.startswith("VmRSS:"):
                return int(line.split()[1]) * 1024
        raise AssertionError("the server is gone")

    def connect(self, client=None):
        """A connection for several requests, from an address of this machine."""
        return http.client.HTTPConnection(*self.address, timeout=TIMEOUT, source_address=client and (client, 0))

    def socket(self):
        """A bare connection, for what no HTTP client would send."""
        return socket.create_connection(self.address, timeout=TIMEOUT)

    def ask(self, method, path, body=None, headers=None, connection=None, client=None):
        own = connection or self.connect(client)
        try:
            own.request(method, path, body, headers or {})
            reply = own.getresponse()
            return Reply(reply.status, reply.headers, reply.read())
        finally:
            if connection is None:
                own.close()

    def get(self, path, **headers):
        return self.ask("GET", path, headers={name.replace("_", "-"): value for name, value in headers.items()})

    def upload(self, name):
        """The id of a scene of tests/scenes."""
        body = (SCENES / f"{name}.glb").read_bytes()
        reply = self.ask("POST", "/v1/scenes", body, {"Content-Type": "model/gltf-binary"})
        assert reply.status in (200, 201), reply.body
        return reply.json()["id"]

    def frame(self, scene, spec, accept="*/*", client=None, **headers):
        headers = {name.replace("_", "-"): value for name, value in headers.items()}
        headers.update({"Content-Type": "application/json", "Accept": accept})
        return self.ask("POST", f"/v1/scenes/{scene}/frames", json.dumps(spec), headers, client=client)


def workers_of(server):
    """The process ids of a server's workers."""
    found = set()
    for task in Path(f"/proc/{server.process.pid}/task").iterdir():
        try:
            found.update(int(pid) for pid in (task / "children").read_text().split())
        except OSError:
            pass  # the thread has ended
    return found


def started_by(pid):
    """(process id, time of its start) of the processes below one, and below those; zombies left out."""
    parents = {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            state, parent, *rest = stat.read_text().rpartition(")")[2].split()
        except OSError:
            continue  # it has ended
        if state not in "ZX":
            parents[int(stat.parent.name), rest[17]] = int(parent)
    found, next_ones = set(), {pid}
    while next_ones:
        below = {each for each, parent in parents.items() if parent in next_ones} - found
        found |= below
        next_ones = {each for each, _ in below}
    return found


def still_running(processes):
    """Those of `started_by` that have not ended; zombies have."""
    running = set()
    for pid, begun in processes:
        try:
            state, *rest = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if state not in "ZX" and rest[18] == begun:
            running.add((pid, begun))
    return running


def await_end(processes, seconds):
    """Those that still run after so many seconds."""
    end = time.monotonic() + seconds
    while still_running(processes) and time.monotonic() < end:
        time.sleep(0.02)
    return still_running(processes)


class ServerTest(unittest.TestCase):
    """A server for all tests of the class; it must still live after each of them."""

    flags = ()
    variables = {}

    @classmethod
    def setUpClass(cls):
        cls.server = Server(*cls.flags, variables=cls.variables)
        cls.addClassCleanup(cls.server.__exit__)

    def tearDown(self):
        self.assertIsNone(self.server.process.poll(), "the server ended:\n" + self.server.log_text())

    def assert_problem(self, reply, status, pointer=None):
        self.assertEqual(reply.status, status, reply.body[:500])
        self.assertEqual(reply.headers["Content-Type"], "application/problem+json")
        self.assertEqual(reply.headers["Cache-Control"], "no-store")
        problem = reply.json()
        self.assertEqual(problem["status"], status)
        self.assertEqual(problem["instance"], reply.headers["X-Request-ID"])
        self.assertTrue(problem["problems"])
        if pointer is not None:
            self.assertIn(pointer, reply.pointers())


def receive_all(connection, at_reset=b""):
    """What comes until the server closes; a reset after the reply counts as the end, and leaves `at_reset` there."""
    received = b""
    try:
        while piece := connection.recv(65536):
            received += piece
    except ConnectionResetError:
        received += at_reset
    return received


def form(parts):
    """(body, Content-Type) of multipart/form-data; parts are (name, file name or None, bytes)."""
    boundary = "a-boundary-of-the-tests"
    body = b""
    for name, file_name, content in parts:
        body += f'--{boundary}\r\nContent-Disposition: form-data; name="{name}"'.encode()
        if file_name is not None:
            body += f'; filename="{file_name}"'.encode()
        body += b"\r\n\r\n" + content + b"\r\n"
    return body + f"--{boundary}--\r\n".encode(), f"multipart/form-data; boundary={boundary}"


def png_size(data):
    """(width, height) of a PNG."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n" and data[12:16] == b"IHDR", data[:16]
    return int.from_bytes(data[16:20]), int.from_bytes(data[20:24])


EXR_MAGIC = b"\x76\x2f\x31\x01"
SMALL = {"width": 64, "height": 48}

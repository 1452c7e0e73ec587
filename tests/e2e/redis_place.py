"""A redis-server of a test's own, on a free port, and scenes in it as a test meets them."""

import json
import shutil
import socket
import subprocess
import tempfile
import unittest
from pathlib import Path

from shipped_server import TIMEOUT


needs_redis = unittest.skipUnless(
    shutil.which("redis-server") and shutil.which("redis-cli"), "redis-server is not installed"
)


def free_port():
    with socket.create_server(("127.0.0.1", 0)) as listening:
        return listening.getsockname()[1]


class RedisServer:
    """Keeps its data over kill() and start(): each write is on the disk before its reply. `tls`: speaks nothing else,
    with a certificate for 127.0.0.1 of an authority of its own. Use it in a `with` statement."""

    def __init__(self, *flags, tls=False):
        self.folder = tempfile.TemporaryDirectory()
        self.path = Path(self.folder.name)
        self.flags = flags
        self.tls = tls
        self.port = free_port()
        self.process = None
        if tls:
            self._make_certificates()
        self.start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.kill()
        self.folder.cleanup()

    @property
    def url(self):
        return f"{'rediss' if self.tls else 'redis'}://127.0.0.1:{self.port}"

    @property
    def authorities(self):
        return self.path / "ca.pem"

    def start(self):
        flags = ["--tls-port" if self.tls else "--port", str(self.port)]
        if self.tls:
            flags += ["--port", "0", "--tls-cert-file", "server.pem", "--tls-key-file", "server.key",
                      "--tls-ca-cert-file", "ca.pem", "--tls-auth-clients", "no"]  # fmt: skip
        self.process = subprocess.Popen(
            ["redis-server", *flags, "--bind", "127.0.0.1", "--appendonly", "yes", "--appendfsync", "always", "--save", "",
             *self.flags],
            cwd=self.path, stdout=subprocess.PIPE, text=True)  # fmt: skip
        for line in self.process.stdout:
            if "Ready to accept connections" in line:
                self.process.stdout.close()  # it goes on without a log
                return
        raise AssertionError("redis-server did not start")

    def kill(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait(TIMEOUT)

    def ask(self, *words):
        """The reply to a command: a string, a list, or a number."""
        tls = ["--tls", "--cacert", str(self.authorities)] if self.tls else []
        done = subprocess.run(["redis-cli", "--json", "-p", str(self.port), *tls, *map(str, words)], capture_output=True,
                              text=True, timeout=TIMEOUT, check=True)  # fmt: skip
        return json.loads(done.stdout)

    def _make_certificates(self):
        key = "-newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes"
        for command in (
            f"openssl req -x509 {key} -keyout ca.key -out ca.pem -days 2 -subj /CN=authority",
            f"openssl req {key} -keyout server.key -out server.csr -subj /CN=redis",
            "openssl x509 -req -in server.csr -CA ca.pem -CAkey ca.key -CAcreateserial -days 2 -extfile names -out server.pem",
        ):
            (self.path / "names").write_text("subjectAltName=IP:127.0.0.1\n")
            subprocess.run(command.split(), cwd=self.path, check=True, capture_output=True)


@needs_redis
class OnRedis:
    """Beside a StoreCase: its scenes are in Redis."""

    def setUp(self):
        self.redis = RedisServer()
        self.addCleanup(self.redis.__exit__)
        self.flags = ("--device", "cpu", "--workers", "1", "--store", self.redis.url)

    def ids(self):
        return self.redis.ask("ZRANGE", "gnomon:scenes", 0, -1)

    def stored_bytes(self):
        return int(self.redis.ask("GET", "gnomon:bytes") or 0)

    def touch(self, scene):
        now = int(self.redis.ask("TIME")[0])
        self.redis.ask("ZADD", "gnomon:used", now * 1000, scene)

    def last_use(self, scene):
        return float(self.redis.ask("ZSCORE", "gnomon:used", scene)) / 1000

    def make_old(self, scene):
        self.redis.ask("ZADD", "gnomon:used", 1, scene)

    def assert_holds_only(self, scenes):
        """Nothing but these scenes is there: no parts of others, nothing unfinished, no summary."""
        self.assertEqual(sorted(self.ids()), sorted(scenes))
        keys = self.redis.ask("KEYS", "gnomon:*")
        self.assertEqual(sorted(key.removeprefix("gnomon:scene:") for key in keys if ":scene:" in key), sorted(scenes))
        self.assertEqual(sorted(key.removeprefix("gnomon:summary:") for key in keys if ":summary:" in key), sorted(scenes))
        self.assertEqual(self.redis.ask("ZCARD", "gnomon:writing"), 0)
        parts = {key for key in keys if ":part:" in key}
        whole = set()
        for scene in scenes:
            fields = self.redis.ask("HMGET", f"gnomon:scene:{scene}", "parts", "count")
            whole |= {f"gnomon:part:{fields[0]}:{number}" for number in range(int(fields[1]))}
        self.assertEqual(parts, whole)

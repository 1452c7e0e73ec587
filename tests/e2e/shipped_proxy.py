"""The real haproxy with the shipped files, as tests meet it: TLS before one server, or plain HTTP before many replicas."""

import http.client
import os
import shutil
import signal
import socket
import socketserver
import ssl
import struct
import subprocess
import tempfile
import threading
import time
from pathlib import Path

from shipped_server import TIMEOUT, Reply, Server, written

DOCKER = Path(__file__).resolve().parents[2] / "docker"
HAPROXY = shutil.which("haproxy", path=os.environ.get("PATH", "") + ":/usr/sbin")
CLIENT = "127.0.0.5"  # another address than the proxy's own, 127.0.0.1


def make_certificate(folder):
    """A file with a key and a certificate for localhost, signed by itself."""
    key, certificate = folder / "key.pem", folder / "certificate.pem"
    subprocess.run(["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "1", "-subj", "/CN=localhost",
                    "-addext", "subjectAltName=DNS:localhost", "-keyout", key, "-out", certificate],
                   check=True, capture_output=True)  # fmt: skip
    both = folder / "both.pem"
    both.write_bytes(key.read_bytes() + certificate.read_bytes())
    return both


class Haproxy:
    """haproxy with some files and variables, on a port of its own, which the variable `bind` names."""

    def __init__(self, files, bind, variables):
        listening = socket.create_server(("127.0.0.1", 0))  # inherited, so that no other program gets the port
        self.port = listening.getsockname()[1]
        self.log = tempfile.TemporaryFile()
        arguments = [each for file in files for each in ("-f", file)]
        self.process = subprocess.Popen([HAPROXY, "-db", *arguments],
                                        env=os.environ | variables | {bind: f"fd@{listening.fileno()}"},
                                        pass_fds=[listening.fileno()], stdout=self.log, stderr=self.log)  # fmt: skip
        listening.close()

    def ask(self, method, path, body=None, headers=None, connection=None):
        own = connection or self.connect()
        try:
            own.request(method, path, body, headers or {})
            reply = own.getresponse()
            return Reply(reply.status, reply.headers, reply.read())
        finally:
            if connection is None:
                own.close()

    def log_text(self):
        return written(self.log)

    def end(self):
        self.process.kill()
        self.process.wait(TIMEOUT)
        self.log.close()


class Proxy(Haproxy):
    """TLS before a server."""

    def __init__(self, server, certificate):
        super().__init__([DOCKER / "haproxy.cfg"], "GNOMON_PROXY_BIND",
                         {"GNOMON_PROXY_CERTIFICATE": str(certificate),
                          "GNOMON_PROXY_SERVER": "{}:{}".format(*server.address)})  # fmt: skip
        self.context = ssl.create_default_context(cafile=certificate)

    def connect(self, context=None):
        connection = http.client.HTTPSConnection("localhost", self.port, timeout=TIMEOUT, context=context or self.context,
                                                 source_address=(CLIENT, 0))  # fmt: skip
        raw = socket.create_connection(("127.0.0.1", self.port), TIMEOUT, (CLIENT, 0))
        connection.sock = (context or self.context).wrap_socket(raw, server_hostname="localhost")
        return connection


class Names(socketserver.ThreadingUDPServer):
    """A DNS server that has the addresses of `listed`, which may change, for every name."""

    daemon_threads = True

    class Answer(socketserver.BaseRequestHandler):
        def handle(self):
            query, line = self.request
            end = query.index(b"\0", 12) + 5  # behind the one question
            (kind,) = struct.unpack(">H", query[end - 4:end - 2])
            listed = self.server.listed if kind == 1 else []  # A, not AAAA
            records = [struct.pack(">HHHIH4s", 0xC00C, 1, 1, 1, 4, socket.inet_aton(each)) for each in listed]
            head = query[:2] + struct.pack(">HHHHH", 0x8580, 1, len(records), 0, 0)
            line.sendto(head + query[12:end] + b"".join(records), self.client_address)

    def __init__(self, listed):
        super().__init__(("127.0.0.1", 0), Names.Answer)
        self.listed = listed
        self.thread = threading.Thread(target=self.serve_forever, daemon=True)
        self.thread.start()

    def end(self):
        self.shutdown()
        self.thread.join()
        self.server_close()


class Replicas(Haproxy):
    """haproxy before replicas with one store, each at an address of its own, which the DNS tells. Use it in a `with`
    statement."""

    def __init__(self, count, store, *flags, limit=16, slow_start="20s", files=("haproxy.cfg", "haproxy_replicas.cfg")):
        self.flags = ["--store", str(store), "--trusted-proxies", "127.0.0.1", *flags]
        self.servers = {}  # address -> Server
        self.server_port = 0  # the same for all
        self.names = Names([])
        for i in range(count):
            self.start(f"127.0.0.{11 + i}")
        super().__init__([file if Path(file).is_absolute() else DOCKER / file for file in files], "GNOMON_PROXY_PLAIN_BIND",
                         {"GNOMON_PROXY_REPLICAS": f"replicas.test:{self.server_port}",
                          "GNOMON_PROXY_MOST_REPLICAS": str(limit),
                          "GNOMON_PROXY_SLOW_START": slow_start,
                          "GNOMON_PROXY_RESOLVER": "{}:{}".format(*self.names.server_address)})  # fmt: skip

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.end()
        self.names.end()
        for server in self.servers.values():
            server.__exit__()

    def start(self, address):
        """A replica at an address, told to the DNS once it listens."""
        self.servers[address] = Server("--bind", address, *self.flags, port=self.server_port)
        self.server_port = self.servers[address].address[1]
        if address not in self.names.listed:
            self.names.listed = [*self.names.listed, address]

    def kill(self, address):
        self.servers[address].end(signal.SIGKILL)

    def restart(self, address):
        self.servers.pop(address).__exit__()
        self.start(address)

    def connect(self):
        return http.client.HTTPConnection("127.0.0.1", self.port, timeout=TIMEOUT, source_address=(CLIENT, 0))

    def serving(self):
        """The names of all replicas that now answer what names no scene, which goes to each in turn."""
        replies = [self.ask("GET", "/livez") for _ in range(2 * len(self.servers))]
        return {reply.headers["X-Served-By"] for reply in replies if reply.status == 200}

    def wait_for(self, count):
        end = time.monotonic() + TIMEOUT
        while len(self.serving()) != count:
            if time.monotonic() > end or self.process.poll() is not None:
                raise AssertionError(f"{self.serving()} serve, not {count}:\n" + self.log_text())
            time.sleep(0.05)

"""Clients that take replies and send bodies slowly: steady ones get all of it, and none crowds out the others."""

import io
import json
import socket
import tempfile
import threading
import time
import unittest
import zipfile
from pathlib import Path

from shipped_proxy import HAPROXY, Proxy, make_certificate
from shipped_server import SLOW, TIMEOUT, ServerTest, receive_all

KIB = 1024
SIDE = 1024
EXR = {"format": "exr", "exrPixelType": "float", "exrCompression": "none"}  # 12 bytes a pixel, however simple its scene
PICTURE_BYTES = SIDE * SIDE * 12


def post(path, body, **headers):
    lines = [f"POST {path} HTTP/1.1", "Host: localhost", "Connection: close", f"Content-Length: {len(body)}"]
    lines += [f"{name.replace('_', '-')}: {value}" for name, value in headers.items()]
    return ("\r\n".join(lines) + "\r\n\r\n").encode() + body


def picture(scene, **headers):
    body = json.dumps({"width": SIDE, "height": SIDE, "output": EXR}).encode()
    return post(f"/v1/scenes/{scene}/frames", body, Content_Type="application/json", **headers)


def sequence(scene, accept, **headers):
    body = {"spec": {"width": SIDE, "height": SIDE, "output": EXR}, "frames": [{}, {"exposure": 2}]}
    return post(f"/v1/scenes/{scene}/sequences", json.dumps(body).encode(), Content_Type="application/json",
                Accept=accept, **headers)  # fmt: skip


def connect(server, buffer=None, source="127.0.0.1"):
    connection = socket.socket()
    if buffer:
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, buffer)
    connection.settimeout(TIMEOUT)
    connection.bind((source, 0))
    connection.connect(server.address)
    return connection


class Reader(threading.Thread):
    """Takes a reply at a steady speed for some seconds, and then what is left of it."""

    def __init__(self, connection, request, bytes_per_second, seconds):
        super().__init__(daemon=True)
        self.connection, self.speed, self.seconds = connection, bytes_per_second, seconds
        self.received = b""
        connection.sendall(request)
        self.start()

    def run(self):
        pieces, count, start = [], 0, time.monotonic()
        try:
            while time.monotonic() < start + self.seconds and (piece := self.connection.recv(self.speed // 20)):
                pieces.append(piece)
                count += len(piece)
                time.sleep(max(0, start + count / self.speed - time.monotonic()))
            while piece := self.connection.recv(1 << 20):
                pieces.append(piece)
        except ConnectionResetError:
            pieces.append(b" <reset>")
        self.received = b"".join(pieces)
        self.connection.close()

    def head_and_body(self):
        self.join(TIMEOUT)
        return self.received.split(b"\r\n\r\n", 1)


class SteadyReaders(ServerTest):
    """All of them at the same time, so that they wait together."""

    flags = ("--device", "cpu", "--trusted-proxies", "127.0.0.1", "--reply-memory-bytes", "1GB", "--max-sequences", "8")
    seconds = 14  # a server that goes by what its kernel took ends them after 5 s
    speeds = [each * KIB for each in (20, 50, 100, 128, 200, 256, 1000)]

    def reader(self, connection, request, speed):
        self.readers[request[1]] = (Reader(connection, request[0], speed, self.seconds), request[2])

    def start_readers(self, via, connect_by, buffers):
        for speed in self.speeds:
            for buffer in buffers:
                name = f"{via}-{speed}-{buffer}"
                self.reader(connect_by(buffer), (picture(self.scene, X_Request_ID=name), name, "picture"), speed)
        for speed in (20 * KIB, 100 * KIB):
            for accept in ("application/zip", "multipart/mixed"):
                name = f"{via}-{speed}-{accept.split('/')[1]}"
                self.reader(connect_by(None), (sequence(self.scene, accept, X_Request_ID=name), name, accept), speed)

    def assert_whole(self, name, reader, kind):
        head, body = reader.head_and_body()
        self.assertTrue(head.startswith(b"HTTP/1.1 200 "), (name, head[:300]))
        if kind == "picture":
            announced = next(line for line in head.lower().split(b"\r\n") if line.startswith(b"content-length: "))
            self.assertEqual(len(body), int(announced.split()[1]), name)
            self.assertGreater(len(body), PICTURE_BYTES)
        else:
            self.assertGreater(len(body), 2 * PICTURE_BYTES, name)
        if kind == "application/zip" and b"chunked" not in head.lower():
            self.assertIsNone(zipfile.ZipFile(io.BytesIO(body)).testzip(), name)
        elif kind == "multipart/mixed":
            self.assertIn(b"report.json", body[-4096:], name)
        self.assertNotIn("undelivered", self.server.request_line(name), name)

    def test_each_gets_its_whole_reply(self):
        self.scene = self.server.upload("box_on_plane")
        self.readers = {}
        self.start_readers("direct", lambda buffer: connect(self.server, buffer), (None, 64 * KIB))
        if HAPROXY:
            folder = tempfile.TemporaryDirectory()
            self.addCleanup(folder.cleanup)
            proxy = Proxy(self.server, make_certificate(Path(folder.name)))
            self.addCleanup(proxy.end)
            while proxy.ask("GET", "/readyz").status != 200:
                time.sleep(0.05)
            self.start_readers("proxied", lambda _: proxy.connect().sock, (None,))
        for name, (reader, kind) in self.readers.items():
            with self.subTest(name):
                self.assert_whole(name, reader, kind)


class ReadersWhoStop(ServerTest):
    flags = ("--device", "cpu")

    def test_the_log_tells_slow_from_gone(self):
        scene = self.server.upload("box_on_plane")
        with connect(self.server, 4 * KIB) as stalled:
            stalled.sendall(picture(scene, X_Request_ID="stalled"))
            leaving = connect(self.server)
            leaving.sendall(picture(scene, X_Request_ID="leaving"))
            leaving.recv(1)
            leaving.close()
            self.assertEqual(self.server.request_line("leaving")["undelivered"], "clientLeft")
            self.assertEqual(self.server.request_line("stalled")["undelivered"], "tooSlow")
            self.assertTrue(receive_all(stalled, at_reset=b" <reset>").endswith(b" <reset>"), "no end of a whole reply")


class CrowdedServer(ServerTest):
    def await_use(self, of, least):
        """Waits until clients hold so many bytes of the memory for uploads or replies."""
        end = time.monotonic() + TIMEOUT
        while True:
            text = self.server.get("/metrics").body.decode()
            line = next(each for each in text.splitlines() if each.startswith(f"gnomon_{of}_memory_bytes "))
            if float(line.split()[1]) >= least:
                return
            self.assertLess(time.monotonic(), end, line)
            time.sleep(0.05)


class CrowdingReaders(CrowdedServer):
    """Room for three pictures."""

    flags = ("--device", "cpu", "--reply-memory-bytes", "40000000")

    def hold(self, source, name):
        """A client that takes the picture at 20 KiB a second."""
        Reader(connect(self.server, 64 * KIB, source), picture(self.scene, X_Request_ID=name), 20 * KIB, 60 * SLOW)

    def ask(self, source):
        with connect(self.server, source=source) as connection:
            connection.sendall(picture(self.scene))
            return receive_all(connection)

    def test_others_are_served(self):
        self.scene = self.server.upload("box_on_plane")
        self.ask("127.0.0.3")
        self.hold("127.0.0.2", "many-0")
        self.hold("127.0.0.2", "many-1")
        self.await_use("reply", 2 * PICTURE_BYTES)
        self.assertTrue(self.ask("127.0.0.2").startswith(b"HTTP/1.1 503 "), "its third would be more than its share")
        self.assertTrue(self.ask("127.0.0.3").startswith(b"HTTP/1.1 200 "), "what is left, others may have")
        self.hold("127.0.0.4", "one")
        self.await_use("reply", 3 * PICTURE_BYTES)
        begun = time.monotonic()
        self.assertTrue(self.ask("127.0.0.3").startswith(b"HTTP/1.1 200 "), "the slowest of who holds most is ended")
        self.assertLess(time.monotonic() - begun, 6 * SLOW)
        ended = [line for line in self.server.log_lines() if line.get("undelivered")]
        self.assertEqual([line["undelivered"] for line in ended], ["othersWaited"])
        self.assertIn(ended[0]["id"], ("many-0", "many-1"))


class CrowdingUploads(CrowdedServer):
    flags = ("--device", "cpu", "--upload-memory-bytes", "64MB", "--max-scene-bytes", "32MB")
    bytes = 31_900_000

    def drip(self, source):
        """A client that sends most of a body at once, and then 18 KB a second."""
        connection = connect(self.server, source=source)
        self.addCleanup(connection.close)
        head = (f"POST /v1/scenes HTTP/1.1\r\nHost: localhost\r\nContent-Type: model/gltf-binary\r\n"
                f"Content-Length: {self.bytes + 1_000_000}\r\n\r\n")  # fmt: skip
        connection.sendall(head.encode() + bytes(self.bytes))

        def dripping():
            try:
                while True:
                    connection.sendall(bytes(1800))
                    time.sleep(0.1)
            except OSError:
                pass  # it was refused

        threading.Thread(target=dripping, daemon=True).start()
        return connection

    def upload(self, source):
        with connect(self.server, source=source) as connection:
            connection.sendall(post("/v1/scenes", bytes(3_500_000), Content_Type="model/gltf-binary"))
            return receive_all(connection)

    def test_others_may_upload(self):
        self.drip("127.0.0.2")
        own = self.drip("127.0.0.2")
        self.assertTrue(receive_all(own).startswith(b"HTTP/1.1 429 "), "two of one client are more than its share")
        self.assertTrue(self.upload("127.0.0.3").startswith(b"HTTP/1.1 400 "), "it is no scene, but all of it was read")
        self.drip("127.0.0.4")
        self.await_use("upload", 2 * self.bytes)
        refused = self.upload("127.0.0.3")
        self.assertTrue(refused.startswith(b"HTTP/1.1 429 "), refused[:100])
        comes = int(refused.lower().split(b"retry-after: ")[1].split(b"\r\n")[0])
        self.assertLessEqual(comes, 10)
        time.sleep(comes)
        self.assertTrue(self.upload("127.0.0.3").startswith(b"HTTP/1.1 400 "), "one of the two was ended meanwhile")
        statuses = [line["status"] for line in self.server.log_lines() if line.get("problem", "").startswith("The body arr")]
        self.assertEqual(statuses, [408])


class BodiesThatNeverFit(ServerTest):
    flags = ("--device", "cpu", "--upload-memory-bytes", "8MB", "--max-scene-bytes", "8MB")

    def test_are_too_large_and_not_early(self):
        reply = self.server.ask("POST", "/v1/scenes", bytes(9_000_000), {"Content-Type": "model/gltf-binary"})
        self.assert_problem(reply, 413)
        problem = reply.json()["problems"][0]
        self.assertIn("--upload-memory-bytes", problem["detail"])
        self.assertEqual(problem["limit"], f"{8 << 20} bytes")
        self.assertEqual(self.server.get("/v1/capabilities").json()["limits"]["maxSceneBytes"], 8 << 20)


if __name__ == "__main__":
    unittest.main()

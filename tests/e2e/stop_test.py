"""SIGTERM while clients are slow: the process ends in time and in order, what was finished is whole, nobody hangs."""

import http.client
import json
import signal
import threading
import time
import unittest

from shipped_server import SLOW, SMALL, TIMEOUT, Server, receive_all

UPLOAD = (
    b"POST /v1/scenes HTTP/1.1\r\nHost: localhost\r\nContent-Type: model/gltf-binary\r\nContent-Length: 8000000\r\n\r\n"
)
# Several of them take much longer than the grace.
LONG = {"width": 1920, "height": 1080, "antialiasing": "none", "shadow": {"technique": "rayTraced", "raySamples": 1024},
        "lights": [{"sun": {"azimuthDegrees": number, "elevationDegrees": 45}, "angularDiameterDegrees": 60}
                   for number in range(120)]}  # fmt: skip


def post_frame(scene, spec):
    body = json.dumps(spec).encode()
    return (f"POST /v1/scenes/{scene}/frames HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
            f"Content-Length: {len(body)}\r\n\r\n").encode() + body  # fmt: skip


class Dripping:
    """An upload that sends a byte every half second, until the server ends it."""

    def __init__(self, server, head=UPLOAD + bytes(7_000_000), piece=b"\0"):
        self.socket = server.socket()
        self.socket.sendall(head)
        self.piece, self.stop = piece, threading.Event()
        self.thread = threading.Thread(target=self.drip)
        self.thread.start()

    def drip(self):
        while not self.stop.wait(0.5):
            try:
                self.socket.sendall(self.piece)
            except OSError:
                return

    def reply(self):
        received = receive_all(self.socket)
        self.stop.set()
        self.thread.join()
        self.socket.close()
        return received


def slow_reader(server, scene):
    """A connection that has asked for some 50 MB and takes none of it."""
    connection = server.socket()
    spec = {"width": 2048, "height": 2048, "output": {"format": "exr", "exrPixelType": "float", "exrCompression": "none"}}
    connection.sendall(post_frame(scene, spec))
    connection.recv(1000)  # the reply has begun
    return connection


class Stop(unittest.TestCase):
    def setUp(self):
        self.server = Server("--device", "cpu", "--workers", "2", "--request-timeout", "3600")
        self.addCleanup(self.server.__exit__)
        self.scene = self.server.upload("box_on_plane")

    def seconds_to_end(self):
        begin = time.monotonic()
        self.server.process.send_signal(signal.SIGTERM)
        self.assertEqual(self.server.process.wait(TIMEOUT), 0, self.server.log_text()[-2000:])
        return time.monotonic() - begin

    @unittest.skipIf(SLOW > 1, "sanitizers are slower than ten seconds allow")
    def test_ten_seconds_are_enough_for_the_slowest_clients(self):
        idle = self.server.socket()
        uploads = [Dripping(self.server), Dripping(self.server, b"GET /livez HTTP/1.1\r\nHost: localhost\r\nX: ", b"x")]
        reader = slow_reader(self.server, self.scene)
        long = [self.server.socket() for _ in range(6)]
        for number, connection in enumerate(long):
            connection.sendall(post_frame(self.scene, LONG | {"exposure": number / 10}))
        time.sleep(0.5)
        whole = []
        for number in range(4):  # in hand when the signal comes
            connection = http.client.HTTPConnection(*self.server.address, timeout=TIMEOUT)
            spec = json.dumps(SMALL | {"width": 640, "height": 480, "exposure": number / 10})
            connection.request("POST", f"/v1/scenes/{self.scene}/frames", spec, {"Content-Type": "application/json"})
            whole.append(connection)
        time.sleep(0.05)
        self.assertLess(self.seconds_to_end(), 10)
        self.assertEqual(idle.recv(1), b"")
        self.assertRegex(uploads[0].reply()[:1000], b"^HTTP/1.1 503 ")
        self.assertRegex(uploads[1].reply(), b"^HTTP/1.1 (503|408) ")
        statuses = [receive_all(connection)[:12] for connection in long]
        self.assertIn(b"HTTP/1.1 503", statuses)
        self.assertLessEqual(set(statuses), {b"HTTP/1.1 503", b"HTTP/1.1 200"})
        for connection in whole:
            reply = connection.getresponse()
            body = reply.read()  # raises where it is shorter than its length
            self.assertEqual(reply.status, 200, body[:300])
            self.assertEqual((body[:4], body[-8:-4]), (b"\x89PNG", b"IEND"))
            connection.close()
        for connection in (idle, reader, *long):
            connection.close()
        self.assertTrue(self.server.log_has("All work was finished."))

    def test_with_idle_clients_it_ends_at_once(self):
        idle = [self.server.socket() for _ in range(20)]
        kept = self.server.connect()
        self.assertEqual(self.server.ask("GET", "/livez", connection=kept).status, 200)
        self.assertLess(self.seconds_to_end(), 3 * SLOW)
        for connection in [*idle, kept]:
            connection.close()

    def test_who_asks_slowly_but_in_time_is_served(self):
        connection = self.server.socket()
        request = post_frame(self.scene, SMALL)
        connection.sendall(request[:-3])
        time.sleep(0.3)
        self.server.process.send_signal(signal.SIGTERM)
        time.sleep(2)
        connection.sendall(request[-3:])
        reply = receive_all(connection)
        connection.close()
        self.assertRegex(reply, b"^HTTP/1.1 200 ")
        self.assertIn(b"IEND", reply)
        self.assertEqual(self.server.process.wait(TIMEOUT), 0)


class Grace(unittest.TestCase):
    def test_without_a_grace_everyone_is_told_now(self):
        with Server("--device", "cpu", "--grace", "0") as server:
            scene = server.upload("box_on_plane")
            upload, reader = Dripping(server), slow_reader(server, scene)
            time.sleep(0.3)
            begin = time.monotonic()
            self.assertEqual(server.end(), 0)
            self.assertLess(time.monotonic() - begin, 2.5 * SLOW)
            self.assertRegex(upload.reply(), b"^HTTP/1.1 503 ")
            reader.close()


if __name__ == "__main__":
    unittest.main()

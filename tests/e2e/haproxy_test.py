"""docker/haproxy.cfg in front of the server, by the real program: TLS, the client's address, uploads, events."""

import json
import ssl
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from shipped_proxy import CLIENT, HAPROXY, Proxy, make_certificate
from shipped_server import SCENES, SLOW, SMALL, TIMEOUT, Server


@unittest.skipUnless(HAPROXY, "haproxy is not installed")
class HaProxy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.certificate = make_certificate(Path(folder.name))
        cls.server = Server("--device", "cpu", "--workers", "1", "--trusted-proxies", "127.0.0.1")
        cls.addClassCleanup(cls.server.__exit__)
        cls.proxy = Proxy(cls.server, cls.certificate)
        cls.addClassCleanup(cls.proxy.end)
        end = time.monotonic() + TIMEOUT
        while cls.proxy.ask("GET", "/readyz").status != 200:
            assert time.monotonic() < end and cls.proxy.process.poll() is None
            time.sleep(0.05)

    def upload(self, body):
        return self.proxy.ask("POST", "/v1/scenes", body, {"Content-Type": "model/gltf-binary"})

    def test_a_frame_over_tls_is_the_clients(self):
        scene = self.upload((SCENES / "box_on_plane.glb").read_bytes()).json()["id"]
        forged = {"X-Forwarded-For": "203.0.113.9", "Forwarded": "for=203.0.113.9", "X-Request-ID": "over-tls"}
        frame = self.proxy.ask("GET", f"/v1/scenes/{scene}/frame?width=64&height=48", headers=forged)
        self.assertEqual((frame.status, frame.body[1:4]), (200, b"PNG"))
        self.assertTrue(frame.headers["Strict-Transport-Security"])
        logged = self.server.request_line("over-tls")
        self.assertEqual((logged["client"], logged["proxy"]), (CLIENT, "127.0.0.1"))
        self.assertNotIn("203.0.113.9", self.server.settled_log())

    def test_pages_of_this_address_may_send_and_others_may_not(self):
        host = f"localhost:{self.proxy.port}"
        for origin, status in ((f"https://{host}", 400), ("https://evil.example", 403)):
            headers = {"Origin": origin, "Content-Type": "model/gltf-binary", "X-Forwarded-Host": "evil.example"}
            reply = self.proxy.ask("POST", "/v1/scenes", b"", headers)
            self.assertEqual(reply.status == 403, status == 403, reply.body)

    def test_metrics_can_not_be_reached(self):
        self.assertEqual(self.server.get("/metrics").status, 200)
        for path in ("/metrics", "/%6detrics", "/metrics?x", "//metrics", "/METRICS", "/metrics/", "/%6Detric%73",
                     "https://localhost/metrics", "/x/../metrics"):  # fmt: skip
            reply = self.proxy.ask("GET", path)
            self.assertIn(reply.status, (400, 404), path)
            self.assertNotIn(b"gnomon_", reply.body, path)

    def test_old_tls_is_refused(self):
        old = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
        old.check_hostname, old.verify_mode = False, ssl.CERT_NONE
        old.set_ciphers("ALL:@SECLEVEL=0")
        old.minimum_version = old.maximum_version = ssl.TLSVersion.TLSv1_1
        with self.assertRaises((ssl.SSLError, ConnectionResetError)):
            self.proxy.connect(old)
        new = ssl.create_default_context(cafile=None)
        new.check_hostname, new.verify_mode = False, ssl.CERT_NONE
        new.maximum_version = ssl.TLSVersion.TLSv1_2
        connection = self.proxy.connect(new)
        self.assertEqual(connection.sock.version(), "TLSv1.2")
        connection.close()

    def test_a_large_upload_is_passed_on_while_it_comes(self):
        connection = self.proxy.connect()
        connection.putrequest("POST", "/v1/scenes")
        connection.putheader("Content-Type", "model/gltf-binary")
        connection.putheader("Content-Length", str(40 << 20))
        connection.putheader("X-Request-ID", "upload")
        connection.endheaders()
        piece = bytes(1 << 20)
        for _ in range(20):
            connection.send(piece)
        end = time.monotonic() + TIMEOUT
        while self.used() < 15 << 20:  # the server has it before it is whole
            self.assertLess(time.monotonic(), end)
            time.sleep(0.05)
        for _ in range(20):
            connection.send(piece)
        self.assertEqual(connection.getresponse().status, 400, "it is no scene, but all of it came")
        connection.close()
        self.assertEqual(self.server.request_line("upload")["requestBytes"], 40 << 20)

    def used(self):
        text = self.server.get("/metrics").body.decode()
        line = next(each for each in text.splitlines() if each.startswith("gnomon_upload_memory_bytes "))
        return float(line.split()[1])

    def test_http2(self):
        address = f"https://localhost:{self.proxy.port}/v1/capabilities"
        told = subprocess.run(["curl", "-sS", "--http2", "--cacert", self.certificate, "-o", "/dev/null", "-w",
                               "%{http_version} %{http_code}", address],
                              capture_output=True, text=True, timeout=TIMEOUT)  # fmt: skip
        self.assertEqual(told.stdout, "2 200", told.stderr)

    def test_a_long_address_passes(self):
        path = "/v1/nothing?" + "a" * 28_000
        self.assertEqual(self.proxy.ask("GET", path).status, 404)

    def test_events_come_as_they_happen(self):
        scene = self.upload((SCENES / "box_on_plane.glb").read_bytes()).json()["id"]
        variants = [{"exposure": 0.5 + each} for each in range(4)]
        body = json.dumps({"spec": SMALL | {"width": 256, "height": 192}, "variants": variants})
        connection = self.proxy.connect()
        headers = {"Accept": "text/event-stream", "Content-Type": "application/json"}
        connection.request("POST", f"/v1/scenes/{scene}/evaluations", body, headers)
        reply = connection.getresponse()
        self.assertEqual((reply.status, reply.headers["Content-Type"]), (200, "text/event-stream"))
        begun, first, text = time.monotonic(), None, b""
        while piece := reply.read1(65536):
            first = first or time.monotonic()
            text += piece
        ended = time.monotonic()
        self.assertIn(b"event: result", text)
        self.assertGreater(text.count(b"event: progress"), 1)
        self.assertLess(first - begun, (ended - begun) / 2 + 0.05 * SLOW, "not only at the end")
        connection.close()

    def test_z_a_server_that_is_not_ready_answers_for_itself(self):
        server = Server("--device", "cpu", "--workers", "1", "--trusted-proxies", "127.0.0.1", "--drain", "20")
        self.addCleanup(server.__exit__)
        with tempfile.TemporaryDirectory() as folder:
            proxy = Proxy(server, make_certificate(Path(folder)))
            self.addCleanup(proxy.end)
            while proxy.ask("GET", "/readyz").status != 200:
                time.sleep(0.05)
            server.process.terminate()
            end = time.monotonic() + 20
            while proxy.ask("GET", "/readyz").status == 200:
                self.assertLess(time.monotonic(), end)
            time.sleep(5)  # the checks have failed by then
            self.assertEqual(proxy.ask("GET", "/v1/scenes").status, 200)
            server.process.kill()
            server.process.wait(TIMEOUT)
            self.assertEqual(proxy.ask("GET", "/v1/scenes").status, 503)


if __name__ == "__main__":
    unittest.main()

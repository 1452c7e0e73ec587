"""Hostile and unlucky clients: the server answers everyone else, and goes on."""

import json
import os
import signal
import socket
import subprocess
import threading
import time
import unittest

from shipped_server import BINARY, SCENES, SLOW, SMALL, TIMEOUT, Server, ServerTest, environment, receive_all

GET = "GET {} HTTP/1.1\r\nHost: localhost\r\n{}\r\n"


def post_head(path, content_type, length):
    lines = (f"POST {path} HTTP/1.1", "Host: localhost", f"Content-Type: {content_type}", f"Content-Length: {length}")
    return ("\r\n".join(lines) + "\r\n\r\n").encode()


def frame_request(scene, spec):
    body = json.dumps(spec).encode()
    return post_head(f"/v1/scenes/{scene}/frames", "application/json", len(body)) + body


def large_picture(width=2048, height=2048):
    """A frame of 16 bytes a pixel, however simple its scene."""
    output = {"format": "exr", "exrPixelType": "float", "exrCompression": "none"}
    return {"width": width, "height": height, "output": output}


def narrow_socket(server):
    """A connection whose kernel takes hardly anything that is not read."""
    connection = socket.socket()
    connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    connection.settimeout(TIMEOUT)
    connection.connect(server.address)
    return connection


def until(condition, seconds):
    """Whether the condition comes true in time."""
    end = time.monotonic() + seconds * SLOW
    while time.monotonic() < end:
        if condition():
            return True
        time.sleep(0.1)
    return False


class UnreadLog(unittest.TestCase):
    def test_stops_nothing_and_tells_what_it_lost(self):
        reading, writing = os.pipe()
        process = subprocess.Popen(
            [BINARY, "serve", "--port", "0", "--device", "cpu"],
            stdout=subprocess.PIPE, stderr=writing, text=True, env=environment(),
        )  # fmt: skip
        os.close(writing)
        try:
            port = int(process.stdout.readline().rsplit(":", 1)[1])
            target = "/livez?" + "a" * 480
            for _ in range(2500):  # some 800 bytes each: more than the pipe and the queue hold
                with socket.create_connection(("127.0.0.1", port), timeout=5 * SLOW) as connection:
                    connection.sendall(GET.format(target, "Connection: close\r\n").encode())
                    self.assertTrue(connection.recv(100).startswith(b"HTTP/1.1 "))
            lines = []
            log = os.fdopen(reading)
            reader = threading.Thread(target=lambda: lines.extend(log))
            reader.start()
            process.send_signal(signal.SIGTERM)
            self.assertEqual(process.wait(TIMEOUT), 0)
            reader.join()
            log.close()
            events = [json.loads(line) for line in lines]
            told = [event["detail"] for event in events if event["event"] == "log"]
            self.assertTrue(told)
            lost = sum(int(detail.split()[0]) for detail in told)
            # The end's own lines may be among the lost, where they come before the reader does.
            ends = {"draining", "ended"} - {event["event"] for event in events}
            self.assertEqual(lost + sum(event["event"] == "request" for event in events), 2500 + len(ends))
        finally:
            process.kill()
            process.wait(TIMEOUT)
            process.stdout.close()

    def test_does_not_hold_up_the_end(self):
        reading, writing = os.pipe()
        process = subprocess.Popen(
            [BINARY, "serve", "--port", "0", "--device", "cpu"],
            stdout=subprocess.PIPE, stderr=writing, text=True, env=environment(),
        )  # fmt: skip
        try:
            port = int(process.stdout.readline().rsplit(":", 1)[1])
            for _ in range(400):
                with socket.create_connection(("127.0.0.1", port), timeout=5 * SLOW) as connection:
                    connection.sendall(GET.format("/livez?" + "a" * 480, "Connection: close\r\n").encode())
                    connection.recv(100)
            process.send_signal(signal.SIGTERM)
            self.assertEqual(process.wait(10 * SLOW), 0)
        finally:
            process.kill()
            process.wait(TIMEOUT)
            process.stdout.close()
            os.close(reading)
            os.close(writing)


class SlowReaders(ServerTest):
    flags = ("--device", "cpu", "--http-threads", "4", "--max-connections-per-address", "4",
             "--upload-memory-bytes", "1000000", "--max-scene-bytes", "1000000", "--reply-memory-bytes", "16MB")  # fmt: skip

    def test_a_reply_that_nobody_reads_holds_a_thread_for_seconds_only(self):
        scene = self.server.upload("box_on_plane")
        held = []
        for number in range(4):
            connection = narrow_socket(self.server)
            connection.sendall(frame_request(scene, large_picture(1024, 512) | {"exposure": number / 10}))
            held.append(connection)
        status = lambda: self.server.get("/v1/capabilities").status  # noqa: E731
        self.assertTrue(until(lambda: status() == 503, 30), "the threads were never held")
        self.assertEqual(self.server.get("/livez").status, 200)
        self.assertTrue(until(lambda: status() == 200, 30))
        for connection in held:
            connection.close()

    def test_a_body_is_given_back_before_its_reply_is_read(self):
        scene = (SCENES / "box_on_plane.glb").read_bytes()
        boundary = "b"
        spec = json.dumps(large_picture(1024, 512)).encode()
        padding = b" " * 600_000
        body = b"--b\r\nContent-Disposition: form-data; name=\"scene\"; filename=\"a.glb\"\r\n\r\n" + scene
        body += b"\r\n--b\r\nContent-Disposition: form-data; name=\"spec\"\r\n\r\n" + spec + padding + b"\r\n--b--\r\n"
        with narrow_socket(self.server) as connection:
            connection.sendall(post_head("/v1/render", f"multipart/form-data; boundary={boundary}", len(body)) + body)
            self.assertTrue(connection.recv(12).startswith(b"HTTP/1.1 200"))
            reply = self.server.ask("POST", "/v1/scenes", bytes(700_000), {"Content-Type": "model/gltf-binary"})
            self.assertNotEqual(reply.status, 429, "the body still counts")


class DrippingUploads(ServerTest):
    flags = ("--device", "cpu", "--upload-memory-bytes", "8MB", "--max-scene-bytes", "8MB")

    def test_a_burst_earns_no_time(self):
        start = time.monotonic()
        with self.server.socket() as connection:
            connection.sendall(post_head("/v1/scenes", "model/gltf-binary", 8_000_000) + bytes(7_000_000))
            with self.assertRaises(OSError):  # at 16 KiB a second it would have earned seven minutes
                while time.monotonic() < start + 60 * SLOW:
                    connection.sendall(b"\0")
                    time.sleep(0.5)
        self.assertLess(time.monotonic() - start, 40 * SLOW)


class LeavingClients(ServerTest):
    flags = ("--device", "cpu")

    def test_unread_bytes_do_not_hide_that_a_client_left(self):
        scene = self.server.upload("box_on_plane")
        evaluation = {"spec": {"width": 640, "height": 360}, "sweep": "sizes", "repeats": 100}
        body = json.dumps(evaluation).encode()
        small = json.dumps({"spec": SMALL, "variants": [{}], "repeats": 1})
        path = f"/v1/scenes/{scene}/evaluations"
        for extra in (b"", b"\n"):
            with self.server.socket() as connection:
                connection.sendall(post_head(path, "application/json", len(body)) + body)
                time.sleep(0.5)
                connection.sendall(extra)
                time.sleep(0.2)
            asked = lambda: self.server.ask("POST", path, small, {"Content-Type": "application/json"})  # noqa: E731
            self.assertTrue(until(lambda: asked().status == 200, 10), extra)

    def test_a_client_that_only_sends_no_more_gets_its_frame(self):
        scene = self.server.upload("box_on_plane")
        for version in ("1.0", "1.1"):
            with self.server.socket() as connection:
                line = f"GET /v1/scenes/{scene}/frame?width=64&height=48&exposure=0.{version[2]} HTTP/{version}\r\n"
                connection.sendall(line.encode() + b"Host: localhost\r\nConnection: close\r\n\r\n")
                connection.shutdown(socket.SHUT_WR)
                reply = receive_all(connection, at_reset=b" <reset>")
            if version == "1.1":
                reply = reply.removeprefix(b"HTTP/1.1 100 Continue\r\n\r\n")
            self.assertTrue(reply.startswith(b"HTTP/1.1 200 OK\r\n"), reply[:200])

    def test_the_log_says_that_a_client_left(self):
        scene = self.server.upload("leaves")
        sizes = {"angularDiameterDegrees": 60}
        suns = [{"sun": {"azimuthDegrees": at, "elevationDegrees": 45}} | sizes for at in range(4)]
        shadow = {"technique": "rayTraced", "raySamples": 256}
        spec = {"width": 2048, "height": 2048, "antialiasing": "none", "shadow": shadow, "lights": suns}
        with self.server.socket() as connection:
            connection.sendall(frame_request(scene, spec).replace(b"Host:", b"X-Request-ID: left\r\nHost:", 1))
            time.sleep(0.3)  # it is being drawn
        line = self.server.request_line("left")
        self.assertEqual(line["status"], 499, line)
        self.assertEqual(line["undelivered"], "clientLeft")


class Slowloris(ServerTest):
    flags = ("--device", "cpu", "--http-threads", "16")

    def test_unfinished_heads_take_no_thread(self):
        stop = threading.Event()

        def drip():
            while not stop.is_set():
                try:
                    connections = [self.server.socket() for _ in range(220)]
                    for connection in connections:
                        connection.sendall(b"G")
                    stop.wait(0.9)
                    for connection in connections:
                        connection.close()
                except OSError:
                    pass

        attackers = [threading.Thread(target=drip) for _ in range(4)]
        for attacker in attackers:
            attacker.start()
        time.sleep(2)
        try:
            for path in ("/livez", "/readyz", "/v1/capabilities"):
                self.assertEqual([self.server.get(path).status for _ in range(10)], [200] * 10, path)
        finally:
            stop.set()
            for attacker in attackers:
                attacker.join()

    def test_one_address_leaves_threads_for_others(self):
        dripping = []
        for _ in range(40):  # as many bodies that hardly come as there are threads, and more
            connection = self.server.socket()
            connection.sendall(post_head("/v1/scenes", "model/gltf-binary", 1000) + b"g")
            dripping.append(connection)
        time.sleep(0.5)
        self.assert_problem(self.server.get("/v1/capabilities"), 429)
        self.assertEqual(self.server.get("/readyz").status, 200)
        with socket.create_connection(self.server.address, timeout=TIMEOUT, source_address=("127.0.0.2", 0)) as other:
            other.sendall(GET.format("/v1/capabilities", "Connection: close\r\n").encode())
            self.assertTrue(receive_all(other, at_reset=b" <reset>").startswith(b"HTTP/1.1 200 "))
        for connection in dripping:
            connection.close()


class Protocol(ServerTest):
    flags = ("--device", "cpu", "--allowed-hosts", "render.example", "--allowed-origins", "https://page.example")

    def raw(self, text):
        with self.server.socket() as connection:
            connection.sendall(text.encode())
            return receive_all(connection, at_reset=b" <reset>")

    def test_an_idle_connection_is_kept_and_says_for_how_long(self):
        connection = self.server.connect()
        first = self.server.ask("GET", "/livez", connection=connection)
        self.assertEqual(first.headers["Keep-Alive"], "timeout=75")
        own = connection.sock
        time.sleep(3)
        self.assertEqual(self.server.ask("GET", "/livez", connection=connection).status, 200)
        self.assertIs(connection.sock, own, "it was opened anew")
        connection.close()

    def test_a_stray_line_end_does_not_cut_the_reply(self):
        scene = self.server.upload("box_on_plane")
        body = json.dumps(large_picture(1024, 512)).encode()
        head = post_head(f"/v1/scenes/{scene}/frames", "application/json", len(body))
        with narrow_socket(self.server) as connection:
            connection.sendall(head.replace(b"Host:", b"Connection: close\r\nHost:") + body)
            time.sleep(0.3)
            connection.sendall(b"\r\n")
            reply = receive_all(connection, at_reset=b" <reset>")
        announced = int(reply.split(b"Content-Length: ")[1].split(b"\r\n")[0])
        self.assertEqual(len(reply.split(b"\r\n\r\n", 1)[1]), announced)

    def test_forms_of_the_request_line(self):
        close = "Host: localhost\r\nConnection: close\r\n\r\n"
        self.assertIn("200 OK", self.raw("\r\nGET /livez HTTP/1.1\r\n" + close).decode()[:20])
        self.assertIn("200 OK", self.raw("GET HTTP://localhost/livez HTTP/1.1\r\n" + close).decode()[:20])
        cut = self.raw("GET http://localhost?y=/v1/capabilities HTTP/1.1\r\n" + close)
        self.assertNotIn(b"fingerprint", cut)

    def test_a_line_that_ends_with_lf_alone_is_refused_at_once_and_logged(self):
        start = time.monotonic()
        reply = self.raw("GET /livez?a=bare HTTP/1.1\nHost: localhost\n\n")
        self.assertLess(time.monotonic() - start, 4)
        self.assertTrue(reply.startswith(b"HTTP/1.1 400 "), reply)
        self.server.settled_log()
        line = next(line for line in self.server.log_lines() if line.get("target") == "/livez?a=bare")
        self.assertEqual((line["method"], line["status"]), ("GET", 400))

    def test_an_old_client_gets_no_interim_reply(self):
        lines = "POST /v1/scenes HTTP/1.0\r\nContent-Type: model/gltf-binary\r\nExpect: 100-continue\r\n"
        self.assertTrue(self.raw(lines + "Content-Length: 4\r\n\r\nglTF").startswith(b"HTTP/1.1 400 "))

    def test_options_tells_the_methods(self):
        reply = self.server.ask("OPTIONS", "/v1/scenes")
        self.assertEqual((reply.status, reply.headers["Allow"]), (204, "GET, HEAD, OPTIONS, POST"))
        self.assertIsNone(reply.headers["Access-Control-Allow-Origin"])
        reply = self.server.ask("OPTIONS", "/v1/scenes", headers={"Origin": "https://page.example"})
        self.assertEqual(reply.headers["Access-Control-Allow-Origin"], "https://page.example")
        self.assertEqual(reply.headers["Access-Control-Allow-Methods"], "GET, HEAD, OPTIONS, POST")

    def test_options_of_no_path_names_all_methods(self):
        reply = self.raw("OPTIONS * HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n")
        self.assertTrue(reply.startswith(b"HTTP/1.1 204 "), reply)
        self.assertIn(b"Allow: DELETE, GET, HEAD, OPTIONS, POST, PUT\r\n", reply)

    def test_preconditions_are_those_of_a_frame_that_can_be_drawn(self):
        scene = self.server.upload("box_on_plane")
        tag = self.server.frame(scene, SMALL).headers["ETag"]
        undrawable = SMALL | {"camera": {"node": "nobody"}}
        for headers, spec, status in (
            ({"If_Match": tag}, SMALL, 200),
            ({"If_Match": "*"}, SMALL, 200),
            ({"If_Match": '"x"'}, SMALL, 412),
            ({"If_Match": '"x"'}, SMALL | {"exposure": 0.25}, 412),
            ({"If_Match": '"x"'}, undrawable, 400),
            ({"If_None_Match": "*"}, SMALL | {"exposure": 0.75}, 304),
            ({"If_None_Match": "*"}, undrawable, 400),
            ({"If_None_Match": '"x"'}, SMALL, 200),
        ):
            self.assertEqual(self.server.frame(scene, spec, **headers).status, status, (headers, spec))
        address = f"/v1/scenes/{scene}"
        self.assertEqual(self.server.ask("DELETE", address, headers={"If-Match": '"x"'}).status, 412)
        self.assertEqual(self.server.ask("DELETE", address, headers={"If-Match": "*"}).status, 204)

    def test_a_post_with_a_known_tag_draws_nothing(self):
        scene = self.server.upload("box_on_plane")
        tag = self.server.frame(scene, SMALL).headers["ETag"]
        self.assertEqual(self.server.frame(scene, SMALL, If_None_Match=tag).status, 304)

    def test_pages_of_other_servers_are_kept_away(self):
        get = lambda **headers: self.server.get("/v1/scenes", **headers)  # noqa: E731
        self.assert_problem(get(Host="rebound.example"), 421)
        self.assertEqual(get(Host="render.example").status, 200)
        form = {"Content-Type": "multipart/form-data; boundary=x"}
        post = lambda **headers: self.server.ask("POST", "/v1/render", b"", form | headers)  # noqa: E731
        self.assert_problem(post(Origin="http://evil.example"), 403)
        self.assert_problem(post(**{"Sec-Fetch-Site": "cross-site"}), 403)
        self.assert_problem(post(Origin="https://page.example"), 400)
        self.assert_problem(post(), 400)


if __name__ == "__main__":
    unittest.main()

"""What no honest client sends: the server refuses it within its bounds, and goes on serving."""

import time
import unittest

from shipped_server import SCENES, SLOW, ServerTest, receive_all

MEGABYTE = 1 << 20


def send_until_refused(connection, piece, most):
    """Sends `piece` again and again until the server stops reading; the bytes that it took, roughly."""
    sent = 0
    try:
        while sent < most:
            connection.sendall(piece)
            sent += len(piece)
    except (BrokenPipeError, ConnectionResetError):
        pass
    return sent


class Bodies(ServerTest):
    flags = ("--max-scene-bytes", str(2 * MEGABYTE))

    def raw(self, *pieces, finish=True):
        with self.server.socket() as connection:
            for piece in pieces:
                connection.sendall(piece)
            if finish:
                connection.shutdown(1)
            return receive_all(connection)

    def head(self, path, *lines):
        text = "\r\n".join([f"POST {path} HTTP/1.1", "Host: localhost", "Content-Type: model/gltf-binary", *lines, "", ""])
        return text.encode()

    def test_a_chunked_body_is_counted(self):
        before = self.server.resident_bytes()
        with self.server.socket() as connection:
            connection.sendall(self.head("/v1/scenes", "Transfer-Encoding: chunked"))
            chunk = b"%x\r\n" % 65536 + bytes(65536) + b"\r\n"
            sent = send_until_refused(connection, chunk, 64 * MEGABYTE)
            reply = receive_all(connection)
        if reply:  # a reset may have overtaken it
            self.assertTrue(reply.startswith(b"HTTP/1.1 413 "), reply[:200])
        self.assertLess(self.server.resident_bytes() - before, 32 * MEGABYTE)
        self.assertTrue(reply or sent < 64 * MEGABYTE)

    def test_a_chunk_that_announces_too_much_is_refused_unread(self):
        for size in (b"7fffffff", b"ffffffffffffffff", b"fffffffffffffffffffffff", b"-1", b"+1", b"1 1"):
            reply = self.raw(self.head("/v1/scenes", "Transfer-Encoding: chunked"), size + b"\r\n")
            self.assertRegex(reply, rb"^HTTP/1.1 4(00|13) ", size)

    def test_chunks_are_not_taken_where_json_is(self):
        reply = self.raw(
            b"POST /v1/scenes/x/frames HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
            b"Transfer-Encoding: chunked\r\n\r\n2\r\n{}\r\n0\r\n\r\n"
        )
        self.assertTrue(reply.startswith(b"HTTP/1.1 411 "), reply[:200])

    def test_a_length_over_the_limit_is_refused_unread(self):
        for length in (4 * MEGABYTE, 1 << 62):
            reply = self.raw(self.head("/v1/scenes", f"Content-Length: {length}"))
            self.assertTrue(reply.startswith(b"HTTP/1.1 413 "), reply[:200])
        reply = self.raw(self.head("/v1/scenes", f"Content-Length: {1 << 80}"))
        self.assertTrue(reply.startswith(b"HTTP/1.1 400 "), reply[:200])

    def test_a_body_shorter_than_its_length(self):
        reply = self.raw(self.head("/v1/scenes", "Content-Length: 1000"), b"short")
        self.assertTrue(reply.startswith(b"HTTP/1.1 400 "), reply[:200])

    def test_a_body_longer_than_its_length(self):
        reply = self.raw(self.head("/v1/scenes", "Content-Length: 4"), b"glTF and more that is no request\r\n\r\n")
        self.assertEqual(reply.count(b"HTTP/1.1 400 "), 2)

    def test_both_framings_at_once(self):
        reply = self.raw(self.head("/v1/scenes", "Content-Length: 4", "Transfer-Encoding: chunked"), b"0\r\n\r\n")
        self.assertTrue(reply.startswith(b"HTTP/1.1 400 "), reply[:200])

    def test_a_body_where_none_is_taken(self):
        reply = self.raw(b"GET /livez HTTP/1.1\r\nHost: localhost\r\nContent-Length: 5\r\n\r\nhello")
        self.assertTrue(reply.startswith(b"HTTP/1.1 413 "), reply[:200])

    def test_a_header_line_without_an_end(self):
        before = self.server.resident_bytes()
        with self.server.socket() as connection:
            connection.sendall(b"GET / HTTP/1.1\r\nHost: localhost\r\nX: ")
            send_until_refused(connection, b"a" * 65536, 64 * MEGABYTE)
            reply = receive_all(connection)
        if reply:
            self.assertTrue(reply.startswith(b"HTTP/1.1 431 "), reply[:200])
        self.assertLess(self.server.resident_bytes() - before, 16 * MEGABYTE)

    def test_heads_that_have_felled_servers(self):
        for lines in (
            b"GET / HTTP/1.1\r\nHost: localhost\r\nRange: bytes=" + b"0-0," * 7000 + b"0-0\r\n\r\n",
            b"GET /" + b"a" * 30000 + b" HTTP/1.1\r\nHost: localhost\r\n\r\n",
            b"GET /?" + b"&" * 30000 + b" HTTP/1.1\r\nHost: localhost\r\n\r\n",
            b"GET / HTTP/1.1\r\nHost: localhost\r\nAccept: " + b"," * 30000 + b"\r\n\r\n",
            b"GET / HTTP/1.1\r\nHost: localhost\r\nX: a%0d%0aSet-Cookie: b\r\n\r\n",
            b"GET / HTTP/1.1\r\nHost: localhost\r\n" + b"A: b\r\n" * 2000 + b"\r\n",
            b"\r\n\r\n", b"\0" * 1000 + b"\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n", b"\x16\x03\x01\x02\x00\r\n\r\n",
        ):  # fmt: skip
            reply = self.raw(lines)
            self.assertRegex(reply, rb"^HTTP/1.1 (200|400|404|431) ", lines[:60])
            self.assertNotIn(b"Set-Cookie", reply)
        self.assertEqual(self.server.get("/livez").status, 200)

    def test_deep_forms_and_empty_ones(self):
        for content_type in ("multipart/form-data", "multipart/form-data; boundary=", "multipart/form-data; boundary=x"):
            for body in (b"", b"--", b"--x--", b"--x\r\n\r\n--x--", b"--x\r\n" * 1000):
                reply = self.server.ask("POST", "/v1/scenes", body, {"Content-Type": content_type})
                self.assert_problem(reply, 400)


class SlowClients(ServerTest):
    flags = ("--http-threads", "8", "--max-connections-per-address", "8")

    def get_coming_again(self, path):
        """The reply to a client that comes again for as long as it is told to."""
        until = time.monotonic() + 10 * SLOW
        while (reply := self.server.get(path)).status == 503 and time.monotonic() < until:
            time.sleep(int(reply.headers["Retry-After"]))
        return reply

    def test_probes_are_answered_while_every_worker_waits(self):
        slow = []
        for _ in range(60):  # far more than there are workers
            connection = self.server.socket()
            connection.sendall(
                b"POST /v1/scenes HTTP/1.1\r\nHost: localhost\r\nContent-Type: model/gltf-binary\r\n"
                b"Content-Length: 1000\r\n\r\nglTF"
            )
            slow.append(connection)
        for path in ("/livez", "/readyz"):
            self.assertEqual(self.server.get(path).status, 200)
        refused = self.server.get("/v1/capabilities")
        self.assert_problem(refused, 503)
        self.assertEqual(refused.headers["Retry-After"], "1")
        # Each is told off, or cut off, in time; then the workers are free again.
        for connection in slow:
            with connection:
                self.assertRegex(receive_all(connection), rb"^(HTTP/1.1 (408|503) |$)")
        self.assertEqual(self.get_coming_again("/v1/capabilities").status, 200)


class LeavingClients(ServerTest):
    flags = ("--http-threads", "8")

    def test_clients_that_leave_at_once(self):
        for _ in range(200):
            self.server.socket().close()
        glb = (SCENES / "box_on_plane.glb").read_bytes()
        for _ in range(20):
            with self.server.socket() as connection:
                connection.sendall(
                    b"POST /v1/scenes HTTP/1.1\r\nHost: localhost\r\nContent-Type: model/gltf-binary\r\n"
                    + f"Content-Length: {len(glb)}\r\n\r\n".encode()
                    + glb[: len(glb) // 2]
                )
        self.assertEqual(self.server.get("/livez").status, 200)


if __name__ == "__main__":
    unittest.main()

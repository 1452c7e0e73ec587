"""Who asks, as a proxy tells it and as anyone may claim it; and the traces that requests belong to."""

import re
import subprocess
import time
import unittest

from shipped_server import BINARY, SMALL, TIMEOUT, Server, ServerTest, environment

TRACE = "0af7651916cd43dd8448eb211c80319c"
PARENT = "b7ad6b7169203331"


class Traces(ServerTest):
    flags = ("--device", "cpu", "--workers", "1")

    def test_a_request_goes_on_with_its_trace(self):
        reply = self.server.get("/livez", traceparent=f"00-{TRACE}-{PARENT}-01", X_Request_ID="traced")
        found = re.fullmatch(f"00-{TRACE}-([0-9a-f]{{16}})-01", reply.headers["traceresponse"])
        self.assertTrue(found, reply.headers["traceresponse"])
        self.assertNotEqual(found[1], PARENT)
        logged = self.server.request_line("traced")
        self.assertEqual((logged["traceId"], logged["spanId"], logged["parentId"]), (TRACE, found[1], PARENT))

    def test_a_malformed_one_begins_anew(self):
        for number, bad in enumerate((f"00-{TRACE.upper()}-{PARENT}-01", f"00-{TRACE}-{PARENT}-01-x", "x" * 5000)):
            reply = self.server.get("/v1/scenes", traceparent=bad, X_Request_ID=f"bad{number}")
            self.assertEqual(reply.status, 200)
            logged = self.server.request_line(f"bad{number}")
            self.assertNotEqual(logged["traceId"], TRACE)
            self.assertNotIn("parentId", logged)
            self.assertEqual(reply.headers["traceresponse"], f"00-{logged['traceId']}-{logged['spanId']}-00")

    def test_frames_events_and_refusals_have_one_too(self):
        scene = self.server.upload("box_on_plane")
        parent = f"00-{TRACE}-{PARENT}-00"
        for _ in range(2):  # drawn, and from memory
            self.assertIn(TRACE, self.server.frame(scene, SMALL, traceparent=parent).headers["traceresponse"])
        self.assertIn(TRACE, self.server.get("/nothing", traceparent=parent).headers["traceresponse"])
        bake = {"Accept": "text/event-stream", "Content-Type": "application/json", "traceparent": parent}
        events = self.server.ask("POST", f"/v1/scenes/{scene}/bakes", "{}", bake)
        self.assertIn(TRACE, events.headers["traceresponse"])


class Clients(unittest.TestCase):
    def logged(self, server, **headers):
        """What the log says of a request with these headers."""
        self.count = getattr(self, "count", 0) + 1
        identity = f"request{self.count}"
        self.assertEqual(server.get("/v1/scenes", X_Request_ID=identity, **headers).status, 200)
        return server.request_line(identity)

    def test_nobody_is_believed_unless_he_is_trusted(self):
        with Server("--device", "cpu", "--workers", "1", "--trusted-proxies", "192.0.2.0/24,2001:db8::/32") as server:
            for headers in ({"X_Forwarded_For": "203.0.113.9"}, {"Forwarded": "for=203.0.113.9"}):
                line = self.logged(server, **headers)
                self.assertEqual(line["client"], "127.0.0.1")
                self.assertNotIn("proxy", line)
            self.assertNotIn("203.0.113.9", server.settled_log())

    def test_a_trusted_proxy_names_its_client(self):
        with Server("--device", "cpu", "--workers", "1", "--trusted-proxies", "127.0.0.1,10.0.0.0/8") as server:
            line = self.logged(server, X_Forwarded_For="198.51.100.1, 203.0.113.9, 10.0.0.7")
            self.assertEqual((line["client"], line["proxy"]), ("203.0.113.9", "127.0.0.1"))
            line = self.logged(server, Forwarded='for=198.51.100.1, for="[2001:db8::9]:80";proto=https')
            self.assertEqual(line["client"], "2001:db8::9")
            long = "a" * 20_000
            for hostile in (long, '203.0.113.9"\\u0000', "1" * 5000 + ".2.3.4", ", ," * 500, "{}"):
                self.assertEqual(self.logged(server, X_Forwarded_For=hostile)["client"], "127.0.0.1")
            self.assertNotIn("a" * 100, server.settled_log())

    def test_each_client_of_a_proxy_has_its_own_share(self):
        flags = ("--trusted-proxies", "127.0.0.1", "--http-threads", "8", "--max-connections-per-address", "2")
        with Server("--device", "cpu", "--workers", "1", *flags) as server:
            head = ("POST /v1/scenes HTTP/1.1\r\nHost: localhost\r\nX-Forwarded-For: {}\r\n"
                    "Content-Type: model/gltf-binary\r\nContent-Length: 100000\r\n\r\n")  # fmt: skip
            held = [server.socket() for _ in range(2)]
            for each in held:
                each.sendall(head.format("203.0.113.9").encode())
            end = time.monotonic() + TIMEOUT
            while server.get("/v1/scenes", X_Forwarded_For="203.0.113.9").status != 429:
                self.assertLess(time.monotonic(), end)
            refused = server.get("/v1/scenes", X_Forwarded_For="203.0.113.9", X_Request_ID="refused")
            self.assertEqual(refused.status, 429)
            self.assertEqual(server.request_line("refused")["client"], "203.0.113.9")
            self.assertEqual(server.get("/v1/scenes", X_Forwarded_For="203.0.113.10").status, 200)
            for each in held:
                each.close()

    def test_what_a_proxy_forwards_weakens_no_check(self):
        flags = ("--trusted-proxies", "127.0.0.1", "--allowed-hosts", "render.example")
        with Server("--device", "cpu", "--workers", "1", *flags) as server:
            forwarded = {"X-Forwarded-For": "203.0.113.9", "X-Forwarded-Host": "render.example",
                         "X-Forwarded-Proto": "https", "Forwarded": "for=203.0.113.9;host=render.example"}  # fmt: skip
            other = server.ask("GET", "/v1/scenes", headers=forwarded | {"Host": "other.example"})
            self.assertEqual(other.status, 421)
            page = {"Host": "render.example", "Origin": "https://evil.example"}
            forwarded |= {"X-Forwarded-Host": "evil.example", "Forwarded": "for=203.0.113.9;host=evil.example"}
            self.assertEqual(server.ask("POST", "/v1/scenes", b"", forwarded | page).status, 403)

    def test_a_network_that_is_none_ends_the_start(self):
        for bad in ("10.0.0.1/8", "proxy.example"):
            ended = subprocess.run([BINARY, "serve", "--port", "0", "--trusted-proxies", "127.0.0.1," + bad],
                                   capture_output=True, text=True, timeout=TIMEOUT, env=environment())  # fmt: skip
            self.assertEqual(ended.returncode, 2)
            self.assertIn(bad, ended.stderr)


if __name__ == "__main__":
    unittest.main()

"""The rest of the API: probes, capabilities, the published routes, the page, logs, and the end."""

import json
import signal
import unittest
from html.parser import HTMLParser

from shipped_server import SMALL, Server, ServerTest


class Service(ServerTest):
    def test_probes(self):
        for path in ("/livez", "/readyz"):
            self.assertEqual(self.server.get(path).status, 200)
            self.assertEqual(self.server.ask("HEAD", path).status, 200)

    def test_capabilities_name_the_renderer(self):
        capabilities = self.server.get("/v1/capabilities").json()
        renderer = capabilities["renderer"]
        self.assertIn(renderer["backend"], ("cpu",) if renderer["device"] == "cpu" else ("egl", "osmesa"))
        self.assertTrue(capabilities["renderer"]["fingerprint"])
        self.assertGreater(capabilities["limits"]["maxSceneBytes"], 0)

    def test_every_published_route_exists_with_its_methods(self):
        document = self.server.get("/openapi.json").json()
        self.assertEqual(document["openapi"].split(".")[0], "3")
        self.assertGreater(len(document["paths"]), 8)
        for path, operations in document["paths"].items():
            reply = self.server.ask("PATCH", path.replace("{id}", "0" * 64))
            self.assert_problem(reply, 405)
            published = {method.upper() for method in operations if method in ("get", "put", "post", "delete")}
            self.assertEqual(set(reply.headers["Allow"].split(", ")) - {"HEAD", "OPTIONS"}, published, path)

    def test_unknown_addresses(self):
        for path in ("/nothing", "/v1", "/v1/scenes/", "/livez/", "//livez", "/index.html/..", "/%2e%2e/etc/passwd"):
            reply = self.server.get(path)
            self.assert_problem(reply, reply.status)
            self.assertIn(reply.status, (400, 404), path)

    def test_a_requests_id_comes_back(self):
        self.assertEqual(self.server.get("/livez", X_Request_ID="abc-123").headers["X-Request-ID"], "abc-123")
        made = self.server.get("/livez", X_Request_ID="not valid{}").headers["X-Request-ID"]
        self.assertRegex(made, "^[0-9a-f]{16}$")

    def test_a_connection_is_kept(self):
        connection = self.server.connect()
        socket_of_first = None
        for _ in range(50):
            self.assertEqual(self.server.ask("GET", "/livez", connection=connection).status, 200)
            socket_of_first = socket_of_first or connection.sock
            self.assertIs(connection.sock, socket_of_first)
        connection.close()

    def test_each_request_is_one_json_line(self):
        scene = self.server.upload("box_on_plane")
        self.server.frame(scene, SMALL, X_Request_ID="the-frame")
        self.server.get('/a"b%0A?x=%22', X_Request_ID="the-odd-one")
        self.assertEqual(self.server.request_line("the-odd-one")["problem"][-1], ".")
        line = self.server.request_line("the-frame")
        self.assertEqual((line["event"], line["status"]), ("request", 200))
        self.assertIn("shade", line["stages"])

    def test_the_page_and_everything_that_it_names(self):
        page = self.server.get("/")
        self.assertEqual((page.status, page.headers["Content-Type"]), (200, "text/html; charset=utf-8"))
        self.assertIn("script-src 'self'", page.headers["Content-Security-Policy"])
        named = Named()
        named.feed(page.body.decode())
        self.assertTrue(named.files)
        self.assertEqual(named.forbidden, [], "the page's policy would block these")
        for file in named.files:
            reply = self.server.get("/" + file.removeprefix("./").removeprefix("/"))
            self.assertEqual(reply.status, 200, file)
            self.assertEqual(self.server.get("/" + file.lstrip("./"), If_None_Match=reply.headers["ETag"]).status, 304)


class Named(HTMLParser):
    """The files that a page loads, and what its policy forbids: scripts, styles and handlers within the page."""

    def __init__(self):
        super().__init__()
        self.files = []
        self.forbidden = []

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        source = attributes.get("src") if tag == "script" else attributes.get("href") if tag == "link" else None
        if source and not source.startswith("data:"):
            self.files.append(source)
        if (tag == "script" and not source) or tag == "style":
            self.forbidden.append(tag)
        self.forbidden += [name for name in attributes if name == "style" or name.startswith("on")]


class End(unittest.TestCase):
    def test_signals_end_it_in_order(self):
        for number in (signal.SIGTERM, signal.SIGINT):
            with Server() as server:
                idle = server.connect()
                self.assertEqual(server.ask("GET", "/livez", connection=idle).status, 200)
                self.assertEqual(server.end(number), 0)
                self.assertTrue(server.log_has("All work was finished."))
                idle.close()

    def test_what_runs_is_finished(self):
        with Server() as server:
            scene = server.upload("box_on_plane")
            body = json.dumps({"width": 640, "height": 480}).encode()
            head = (
                f"POST /v1/scenes/{scene}/frames HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
                f"Content-Length: {len(body)}\r\nExpect: 100-continue\r\n\r\n"
            ).encode()
            sockets = [server.socket() for _ in range(4)]
            for each in sockets:
                each.sendall(head)
            for each in sockets:  # every request is taken before the signal
                self.assertIn(b"100 Continue", each.recv(4096))
                each.sendall(body)
            self.assertEqual(server.end(), 0)
            for each in sockets:
                with each, each.makefile("rb") as replies:
                    reply = replies.read()
                    # 503 where the signal came between the body and the queue.
                    self.assertRegex(reply, rb"^HTTP/1.1 (200|503) ")
                    self.assertIn(b"Connection: close", reply)

    def test_a_failing_readyz_goes_before_the_end(self):
        with Server("--drain", "60") as server:
            connection = server.connect()
            self.assertEqual(server.ask("GET", "/readyz", connection=connection).status, 200)
            server.process.send_signal(signal.SIGTERM)
            while server.ask("GET", "/readyz", connection=connection).status == 200:
                pass  # until the signal has arrived
            self.assertEqual(server.ask("GET", "/livez", connection=connection).status, 200)
            self.assertEqual(server.end(), 1)  # the second signal ends it at once
            connection.close()

    def test_a_taken_port_is_told(self):
        with Server() as server:
            with self.assertRaisesRegex(AssertionError, "can't listen on this address"):
                Server(port=server.address[1])


if __name__ == "__main__":
    unittest.main()

"""What only waits holds no thread, no client holds all threads or jobs, and what a probe says of it."""

import contextlib
import json
import os
import re
import resource
import select
import signal
import socket
import threading
import time
import unittest

from jobs_test import JobTest, LONG, ask_for
from sequences_test import SPEC, orbit
from shipped_server import SLOW, SMALL, TIMEOUT, Server, ServerTest, receive_all, workers_of

SLOW_BODY = (
    b"POST /v1/scenes HTTP/1.1\r\nHost: localhost\r\nContent-Type: model/gltf-binary\r\nContent-Length: 10000000\r\n\r\n"
)


MOST = resource.getrlimit(resource.RLIMIT_NOFILE)[1]
resource.setrlimit(resource.RLIMIT_NOFILE, (MOST, MOST))  # a crowd has more connections than the usual 1,024


def places(server):
    """How many replies may wait for jobs: as many as the log says where the system grants few open files."""
    fewer = re.search(r"room for (\d+) of 1024 replies that wait for jobs", server.settled_log())
    return int(fewer[1]) if fewer else 1024


def connect_from(server, address):
    return socket.create_connection(server.address, timeout=TIMEOUT, source_address=(address, 0))


def asked_from(server, address, path, accept="*/*"):
    connection = connect_from(server, address)
    connection.sendall(f"GET {path} HTTP/1.1\r\nHost: localhost\r\nAccept: {accept}\r\nConnection: close\r\n\r\n".encode())
    return connection


class Holding:
    """Bodies that come slowly, but fast enough: each holds a thread for as long as this lives."""

    def __init__(self, server, addresses, each):
        self.connections = [connect_from(server, address) for address in addresses for _ in range(each)]
        for connection in self.connections:
            connection.sendall(SLOW_BODY)
        self.stop = threading.Event()
        self.thread = threading.Thread(target=self.go_on)

    def go_on(self):
        while not self.stop.wait(0.25):
            for connection in self.connections:
                try:
                    connection.sendall(b"x" * 10_000)
                except OSError:
                    pass  # it was refused

    def __enter__(self):
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.stop.set()
        self.thread.join()
        for connection in self.connections:
            connection.close()


class Crowd(JobTest):
    flags = ("--device", "cpu", "--http-threads", "4")

    def test_a_thousand_streams_of_as_many_addresses_cost_no_other_client_a_frame(self):
        job = self.submit(LONG | {"frames": [{"exposure": i / 5000} for i in range(10_000)]})["address"]
        kinds = [(job, "text/event-stream")] * 9 + [(job + "?wait=60", "*/*")]
        streams = []
        for index in range(min(1000, places(self.server))):
            stream = asked_from(self.server, f"127.0.{1 + index // 200}.{1 + index % 200}", *kinds[index % 10])
            begun = stream.recv(65536) if index % 10 < 9 else b""
            self.assertTrue(begun.startswith(b"HTTP/1.1 200 OK\r\n" if index % 10 < 9 else b""), begun[:300])
            streams.append((stream, begun))
        end = time.monotonic() + 5 * SLOW
        drawn = 0
        while time.monotonic() < end:
            self.assertEqual(self.server.get("/readyz").status, 200)
            self.assertEqual(self.server.frame(self.scene, SMALL | {"exposure": drawn / 1000}).status, 200)
            drawn += 1
        self.assertGreater(drawn, 5)
        self.assertEqual(self.server.ask("DELETE", job).status, 204)
        for stream, begun in streams:
            with stream:
                text = begun + receive_all(stream)
                self.assertTrue(text.startswith(b"HTTP/1.1 200 OK\r\n"), text[:200])
                self.assertIn(b'"cancelled"', text[-600:])


class Waits(JobTest):
    flags = ("--device", "cpu", "--http-threads", "4")

    def test_results_wait_for_their_frames_without_a_thread(self):
        job = self.submit(LONG | {"spec": SPEC | {"width": 1536, "height": 1024}})
        streams = [asked_from(self.server, f"127.0.9.{1 + index}", job["result"], accept)
                   for index, accept in enumerate(["text/event-stream", "application/zip", "multipart/mixed"] * 4)]
        received = dict.fromkeys(streams, 0)
        end = time.monotonic() + 4 * SLOW
        while time.monotonic() < end:
            readable, _, _ = select.select(streams, [], [], 0)
            for stream in readable:
                received[stream] += len(stream.recv(1 << 22))
            self.assertEqual(self.server.frame(self.scene, SMALL).status, 200)
        self.assertGreater(min(received.values()), 0)
        for stream in streams:
            stream.close()

    def test_what_waits_is_told_that_it_lives_and_is_logged(self):
        job = self.submit(LONG | {"spec": LONG["spec"] | {"width": 2048, "height": 2048}})
        connection = self.server.connect()
        connection.request("GET", job["address"] + "?wait=1", headers={"X-Request-ID": "awaited"})
        reply = connection.getresponse()
        self.assertIn(json.loads(reply.read())["state"], ("queued", "running"))
        connection.request("GET", "/v1/jobs")  # the connection goes on
        self.assertEqual(connection.getresponse().status, 200)
        connection.close()
        line = self.server.request_line("awaited")
        self.assertEqual(line["status"], 200)
        self.assertGreaterEqual(line["milliseconds"], 900)


class Places(unittest.TestCase):
    def check(self, descriptors=None):
        """One client has half of the places for replies that wait, and leaves some to others. How many places there are."""
        with Server("--device", "cpu", "--http-threads", "4", descriptors=descriptors) as server, contextlib.ExitStack() as streams:
            count = places(server)
            job = ask_for(server, server.upload("box_on_plane"), LONG).json()["address"]

            def asked(address):
                return streams.enter_context(asked_from(server, address, job, "text/event-stream")).recv(65536)

            replies = [asked("127.0.0.3") for _ in range(count // 2 + 20)]
            self.assertEqual([int(reply[9:12]) for reply in replies], [200] * (count // 2) + [429] * 20)
            self.assertIn(f'"limit":"{count} of all clients"'.encode(), replies[-1].replace(b'": ', b'":'))
            self.assertTrue(asked("127.0.0.4").startswith(b"HTTP/1.1 200"))
        return count

    def test_a_client_has_its_share_of_the_replies_that_wait(self):
        self.check()

    def test_where_few_open_files_are_granted_they_are_fewer_and_the_log_says_so(self):
        self.assertLess(self.check(descriptors=min(4096, MOST)), 512)


class Shares(ServerTest):
    flags = ("--device", "cpu", "--workers", "1", "--http-threads", "8")

    def test_two_addresses_leave_threads_to_a_third(self):
        scene = self.server.upload("box_on_plane")
        with Holding(self.server, ("127.0.0.3", "127.0.0.4"), 12):
            end = time.monotonic() + 8 * SLOW
            while time.monotonic() < end:
                self.assertEqual(self.server.frame(scene, SMALL).status, 200)
                self.assertEqual(self.server.get("/readyz").status, 200)
                time.sleep(0.1)
            with asked_from(self.server, "127.0.0.3", "/v1/scenes") as more:
                self.assertTrue(more.recv(65536).startswith(b"HTTP/1.1 429 "))


class Ready(unittest.TestCase):
    def test_while_no_thread_is_left_for_some_seconds_it_is_not(self):
        with Server("--device", "cpu", "--workers", "1", "--http-threads", "4", "--max-connections-per-address", "4") as server:
            with Holding(server, ("127.0.0.3",), 4):
                time.sleep(0.5)
                self.assertEqual(server.get("/readyz").status, 200, "it may pass")
                end = time.monotonic() + 30 * SLOW
                while server.get("/readyz").status == 200:
                    self.assertLess(time.monotonic(), end)
                    time.sleep(0.1)
                self.assertIn(b"Requests find no thread.", server.get("/readyz").body)
                self.assertEqual(server.get("/livez").status, 200)
            end = time.monotonic() + 10 * SLOW
            while server.get("/readyz").status != 200:
                self.assertLess(time.monotonic(), end)
                time.sleep(0.05)

    def test_a_worker_that_is_replaced_makes_no_difference(self):
        with Server("--device", "cpu", "--workers", "1") as server:
            scene = server.upload("box_on_plane")
            for _ in range(5):
                (worker,) = workers_of(server)
                os.kill(worker, signal.SIGKILL)
                end = time.monotonic() + 1
                while time.monotonic() < end:
                    self.assertEqual(server.get("/readyz").status, 200)
                self.assertEqual(server.frame(scene, SMALL).status, 200)


class Identities(unittest.TestCase):
    def test_all_addresses_of_a_network_are_one_client(self):
        with Server("--device", "cpu", "--workers", "1", "--trusted-proxies", "127.0.0.1") as server:
            scene = server.upload("box_on_plane")

            def status_for(address):
                return ask_for(server, scene, orbit(1), **{"X-Forwarded-For": address}).status

            self.assertEqual([status_for(f"2001:db8::{index:x}") for index in range(1, 21)], [202] * 16 + [429] * 4)
            self.assertEqual(status_for("192.0.2.9"), 202)


if __name__ == "__main__":
    unittest.main()

"""What /metrics tells: counters move, hostile requests add no series, and a second address answers under load."""

import json
import os
import re
import signal
import tempfile
import threading
import time
import unittest
from pathlib import Path

from prometheus_client.parser import text_string_to_metric_families

import access_test
from shipped_server import SCENES, SLOW, SMALL, TIMEOUT, Server, ServerTest

ROOT = Path(__file__).resolve().parents[2]
FAULTY = os.environ["GNOMON_FAULTY_WORKER"]
MOST_SERIES = 2_000  # of a server that has been asked for everything


class Metrics:
    """The text of /metrics, read."""

    def __init__(self, text):
        self.families = list(text_string_to_metric_families(text))
        self.samples = [sample for family in self.families for sample in family.samples]

    def value(self, name, **labels):
        """The sum of the samples that have these labels; 0 where there is none."""
        return sum(sample.value for sample in self.samples
                   if sample.name == name and labels.items() <= sample.labels.items())  # fmt: skip

    def names(self):
        """Families by the name that stands in the text."""
        return {family.name + "_total" if family.type == "counter" else family.name for family in self.families}


def metrics_of(server, headers=None):
    reply = server.ask("GET", "/metrics", headers=headers)
    assert reply.status == 200, reply.body
    assert reply.headers["Content-Type"] == "text/plain; version=0.0.4; charset=utf-8"
    return Metrics(reply.body.decode())


def until(condition):
    """Waits until it gives something that counts as true: replies are counted after they are sent."""
    end = time.monotonic() + TIMEOUT
    while not (value := condition()):
        if time.monotonic() > end:
            raise AssertionError("it never came true")
        time.sleep(0.05)
    return value


class Counters(ServerTest):
    flags = ("--device", "cpu", "--workers", "1")

    def moved(self, before, name, by, **labels):
        """Whether a metric has grown by so much since."""
        wanted = before.value(name, **labels) + by
        until(lambda: metrics_of(self.server).value(name, **labels) >= wanted)
        self.assertEqual(metrics_of(self.server).value(name, **labels), wanted, (name, labels))

    def test_frames_are_counted(self):
        scene = self.server.upload("box_on_plane")
        before = metrics_of(self.server)
        frames = [self.server.frame(scene, SMALL | {"exposure": 0.125 * (1 + each)}) for each in range(3)]
        frames.append(self.server.frame(scene, SMALL | {"exposure": 0.125}))
        self.assertEqual([frame.status for frame in frames], [200] * 4)
        route = {"route": "/v1/scenes/{id}/frames"}
        self.moved(before, "gnomon_http_requests_total", 4, method="POST", status="200", **route)
        self.moved(before, "gnomon_http_request_duration_seconds_count", 4, **route)
        self.moved(before, "gnomon_stage_duration_seconds_count", 3, stage="shade")
        self.moved(before, "gnomon_queue_wait_seconds_count", 3, lane="interactive")
        self.moved(before, "gnomon_reply_cache_hits_total", 1)
        self.moved(before, "gnomon_reply_cache_misses_total", 3)
        after = metrics_of(self.server)
        sent = sum(len(frame.body) for frame in frames)
        self.assertGreaterEqual(after.value("gnomon_http_reply_bytes_total"),
                                before.value("gnomon_http_reply_bytes_total") + sent)  # fmt: skip
        self.assertGreater(after.value("gnomon_reply_cache_bytes"), before.value("gnomon_reply_cache_bytes"))
        self.assertEqual(after.value("gnomon_workers_ready"), 1)
        self.assertEqual(after.value("gnomon_workers_configured"), 1)
        self.assertEqual(after.value("gnomon_store_scenes"), 1)
        self.assertGreaterEqual(after.value("gnomon_store_bytes"), (SCENES / "box_on_plane.glb").stat().st_size)
        self.assertGreater(after.value("gnomon_workers_resident_bytes"), 1 << 20)
        self.assertEqual(after.value("gnomon_build_info", device="cpu"), 1)

    def test_frames_of_jobs_are_counted(self):
        scene = self.server.upload("box_on_plane")
        before = metrics_of(self.server)
        job = self.server.ask("POST", f"/v1/scenes/{scene}/sequences", json.dumps({"spec": SMALL, "frames": [{}, {"exposure": 2}]}),
                              {"Content-Type": "application/json", "Prefer": "respond-async"}).json()  # fmt: skip
        self.moved(before, "gnomon_job_frames_total", 2, end="drawn")
        after = metrics_of(self.server)
        self.assertEqual(after.value("gnomon_job_frames_left"), 0)
        self.assertEqual(after.value("gnomon_jobs"), before.value("gnomon_jobs") + 1)
        self.assertGreater(after.value("gnomon_jobs_bytes"), before.value("gnomon_jobs_bytes"))
        self.assertEqual(self.server.ask("DELETE", job["address"]).status, 204)
        self.assertEqual(metrics_of(self.server).value("gnomon_jobs"), before.value("gnomon_jobs"))

    def test_the_process_is_told(self):
        metrics = metrics_of(self.server)
        resident = metrics.value("process_resident_memory_bytes")
        self.assertAlmostEqual(resident, self.server.resident_bytes(), delta=16 << 20)
        files = len(list(Path(f"/proc/{self.server.process.pid}/fd").iterdir()))
        self.assertAlmostEqual(metrics.value("process_open_fds"), files, delta=8)
        self.assertAlmostEqual(metrics.value("process_start_time_seconds"), time.time(), delta=600)

    def test_hostile_requests_add_no_series(self):
        def ask(number):
            connection = self.server.connect()
            method = ("GET", "PATCH", f"M{number}", "DELETE")[number % 4]
            path = (f"/v1/scenes/{number:064x}", f"/{number}", f"/v1/{number}?q={number}", "/metrics%0a")[number // 4 % 4]
            try:
                connection.putrequest(method, path, skip_host=True)
                connection.putheader("Host", f"host{number}.example" if number % 3 else "localhost")
                connection.putheader("X-Request-ID", f"id{number}")
                connection.endheaders()
                connection.getresponse().read()
            finally:
                connection.close()

        def asked():  # beside what this asks itself
            metrics, name = metrics_of(self.server), "gnomon_http_requests_total"
            return metrics.value(name) - metrics.value(name, route="/metrics")

        before = asked()
        for number in range(48):
            ask(number)
        until(lambda: asked() >= before + 48)
        series = {(sample.name, *sorted(sample.labels.items())) for sample in metrics_of(self.server).samples}
        before = asked()
        for number in range(48, 144):
            ask(number)
        until(lambda: asked() >= before + 96)
        metrics = metrics_of(self.server)
        later = {(sample.name, *sorted(sample.labels.items())) for sample in metrics.samples}
        self.assertEqual(later - series, set())
        self.assertLess(len(later), MOST_SERIES)
        routes = {sample.labels["route"] for sample in metrics.samples if "route" in sample.labels}
        published = set(self.server.get("/openapi.json").json()["paths"]) | {"none", "page"}
        self.assertLessEqual(routes, published)

    def test_every_metric_is_documented_and_no_other(self):
        self.server.get("/livez")
        until(lambda: metrics_of(self.server).value("gnomon_http_requests_total", route="/livez"))
        text = (ROOT / "server/OPERATIONS.md").read_text(encoding="utf-8")
        listed = {name for part in text.split("\n") if part.startswith("| `gnomon_") or part.startswith("| `process_")
                  for name in part.split("`")[1:2]}  # fmt: skip
        self.assertEqual(metrics_of(self.server).names(), listed)

    def test_the_dashboard_asks_for_metrics_and_labels_that_there_are(self):
        self.server.frame(self.server.upload("box_on_plane"), SMALL)
        until(lambda: metrics_of(self.server).value("gnomon_http_requests_total", status="200"))
        labels = {}
        for sample in metrics_of(self.server).samples:
            labels.setdefault(sample.name, set()).update(sample.labels)
        board = json.loads((ROOT / "docker/grafana_dashboard.json").read_text(encoding="utf-8"))
        asked = [target["expr"] for panel in board["panels"] for target in panel.get("targets", [])]
        asked += [row["query"]["query"] for row in board["templating"]["list"] if row["type"] == "query"]
        self.assertGreater(len(asked), 20)
        for query in asked:
            names = re.findall(r"\b(?:gnomon|process)_\w+", query)
            self.assertTrue(names, query)
            known = {"job", "instance"}
            for name in names:
                self.assertIn(name, labels, query)
                known |= labels[name]
            grouped = {word.strip() for part in re.findall(r"by \((.*?)\)", query) for word in part.split(",")}
            matched = {label for part in re.findall(r"\{(.*?)\}(?=[\[)\s]|$)", query)
                       for label in re.findall(r"(\w+)(?:=~|!~|!=|=)\"", part)}  # fmt: skip
            self.assertLessEqual(grouped | matched, known, query)
        told = {name for query in asked for name in re.findall(r"\b(?:gnomon|process)_\w+", query)}
        self.assertGreater(len(told), 25, "most of what there is has its panel")

    def test_no_help_and_no_type_is_missing(self):
        for family in metrics_of(self.server).families:
            self.assertTrue(family.documentation, family.name)
            self.assertIn(family.type, ("counter", "gauge", "histogram"), family.name)


class Refusals(unittest.TestCase):
    def refused(self, server, reason, headers=None):
        until(lambda: metrics_of(server, headers).value("gnomon_refusals_total", reason=reason) >= 1)

    def test_each_tells_its_reason(self):
        with Server("--device", "cpu", "--workers", "1", "--queue-limit", "1", "--max-scene-bytes", "200KB") as server:
            scene = server.upload("box_on_plane")
            self.assertEqual(server.ask("GET", "/", headers={"Host": "other.example"}).status, 421)
            self.refused(server, "origin")
            large = server.ask("POST", "/v1/scenes", bytes(2 << 20), {"Content-Type": "model/gltf-binary"})
            self.assertEqual(large.status, 413)
            self.refused(server, "size")
            spec = {"width": 640, "height": 480}
            asking = [threading.Thread(target=server.frame, args=(scene, spec | {"exposure": 0.5 + each}))
                      for each in range(12)]  # fmt: skip
            for each in asking:
                each.start()
            for each in asking:
                each.join()
            self.refused(server, "queue")

    def test_events_that_end_with_a_problem_tell_it_too(self):
        with Server("--device", "cpu", "--workers", "1") as server:
            scene = server.upload("box_on_plane")
            body = json.dumps({"spec": {"width": 1920, "height": 1080}, "sweep": "all"})
            events = server.ask("POST", f"/v1/scenes/{scene}/evaluations", body,
                                {"Accept": "text/event-stream", "Content-Type": "application/json",
                                 "Prefer": "wait=1", "X-Request-ID": "too-short"})  # fmt: skip
            self.assertIn(b"event: problem", events.body)
            self.refused(server, "deadline")
            line = server.request_line("too-short")
            self.assertIn("deadline", line["problem"])
            self.assertEqual(line["replyBytes"], len(events.body))

    def test_replaced_workers_tell_why(self):
        flags = ("--device", "cpu", "--workers", "1", "--worker-program", FAULTY)
        with Server(*flags) as server:
            scene = server.upload("box_on_plane")
            self.assertEqual(server.frame(scene, {"camera": {"node": "fault-abort"}}).status, 500)
            name = "gnomon_worker_replacements_total"
            until(lambda: metrics_of(server).value(name, reason="crash") == 2)
            self.assertEqual(metrics_of(server).value(name), 2)


class Keys(unittest.TestCase):
    def test_only_an_admin_sees_metrics(self):
        bearer, line = access_test.bearer, access_test.line
        lines = (line("reader", "read,render,upload"), line("boss", "admin"), line("few", "read", "requestsPerSecond=0.01"))
        with tempfile.NamedTemporaryFile("w") as keys:
            keys.write("".join(lines))
            keys.flush()
            server = Server("--device", "cpu", "--workers", "1", "--keys", keys.name)
            self.addCleanup(server.__exit__)
        self.assertEqual(server.get("/metrics").status, 401)
        self.assertEqual(server.ask("GET", "/metrics", headers=bearer("reader")).status, 403)
        for status in (200, 429):
            self.assertEqual(server.ask("GET", "/v1/scenes", headers=bearer("few")).status, status)

        def told(reason, count):
            metrics = metrics_of(server, bearer("boss"))
            return metrics.value("gnomon_refusals_total", reason=reason) == count

        until(lambda: told("keys", 2) and told("rate", 1))
        metrics = metrics_of(server, bearer("boss"))
        self.assertEqual(metrics.value("gnomon_http_requests_total", route="/metrics", status="403"), 1)


class AdminAddress(unittest.TestCase):
    def start(self, *flags):
        server = Server("--device", "cpu", "--workers", "1", "--admin-port", "0", *flags)
        self.addCleanup(server.__exit__)
        server.log_has('"event":"admin"')
        told = next(each for each in server.log_lines() if each["event"] == "admin")
        admin = Second(server, int(told["detail"].rsplit(":", 1)[1]))
        return server, admin

    def test_it_alone_tells_metrics(self):
        server, admin = self.start()
        self.assertEqual(server.get("/metrics").status, 404)
        for path in ("/livez", "/readyz"):
            self.assertEqual((server.get(path).status, admin.get(path).status), (200, 200))
        for path in ("/v1/scenes", "/", "/openapi.json"):
            self.assertEqual(admin.get(path).status, 404, path)
        self.assertEqual(metrics_of(admin).value("gnomon_workers_ready"), 1)
        self.assertEqual(admin.ask("GET", "/metrics", headers={"Host": "other.example"}).status, 421)
        self.assertEqual(server.end(), 0)

    def test_it_answers_while_every_thread_is_taken(self):
        server, admin = self.start("--http-threads", "2", "--max-connections-per-address", "2")
        head = (b"POST /v1/scenes HTTP/1.1\r\nHost: localhost\r\nContent-Type: model/gltf-binary\r\n"
                b"Content-Length: 100000\r\n\r\n")  # fmt: skip
        held = [server.socket() for _ in range(2)]
        for each in held:
            each.sendall(head)
        until(lambda: metrics_of(admin).value("gnomon_http_requests_in_progress") == 2)
        self.assertIn(server.get("/v1/scenes").status, (429, 503))
        begun = time.monotonic()
        metrics = metrics_of(admin)
        self.assertLess(time.monotonic() - begun, 1 * SLOW)
        self.assertEqual(metrics.value("gnomon_http_threads"), 2)
        until(lambda: sum(metrics_of(admin).value("gnomon_refusals_total", reason=reason)
                          for reason in ("threads", "address")) == 1)  # fmt: skip
        for each in held:
            each.close()

    def test_it_answers_until_the_server_has_ended(self):
        server, admin = self.start("--drain", "2")
        server.process.send_signal(signal.SIGTERM)
        until(lambda: metrics_of(admin).value("gnomon_draining") == 1)
        self.assertEqual(admin.get("/readyz").status, 503)
        self.assertEqual(server.process.wait(TIMEOUT), 0)

    def test_its_address_needs_its_port(self):
        with self.assertRaises(AssertionError) as told:
            Server("--admin-bind", "127.0.0.2")  # the usual one is what --print-config prints, without a port, too
        self.assertIn("--admin-port", str(told.exception))


class Second(Server):
    """The second address of a server that runs."""

    def __init__(self, server, port):
        self.address = (server.address[0], port)


if __name__ == "__main__":
    unittest.main()

"""Evaluations over HTTP: every form, events while they last, problems, and what ends them early."""

import csv
import io
import json
import time
import unittest
import xml.etree.ElementTree

from shipped_server import SLOW, SMALL, ServerTest

SPEC = SMALL | {"width": 160, "height": 90, "atlas": {"baseSize": 256}}
HARD_AND_SOFT = [{"shadow": {"filter": {"type": "hard"}}}, {"shadow": {"filter": {"type": "pcf", "size": 7}}}]
LONG = {"spec": SPEC | {"width": 640, "height": 360}, "sweep": "sizes", "repeats": 100}


def events_of(text):
    """(name, data) of each server-sent event."""
    events = []
    for block in text.split("\n\n"):
        fields = dict(line.split(": ", 1) for line in block.splitlines() if not line.startswith(":"))
        if fields:
            events.append((fields["event"], json.loads(fields["data"])))
    return events


class Evaluations(ServerTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.scene = cls.server.upload("box_on_plane")

    def headers(self, accept):
        return {"Content-Type": "application/json", "Accept": accept}

    def evaluate(self, request, accept="application/json"):
        path = f"/v1/scenes/{self.scene}/evaluations"
        return self.server.ask("POST", path, json.dumps(request, separators=(",", ":")), self.headers(accept))

    def begin(self, request, accept):
        """A bare connection that has sent its request and reads nothing."""
        body = json.dumps(request)
        lines = [f"POST /v1/scenes/{self.scene}/evaluations HTTP/1.1", "Host: localhost", f"Content-Length: {len(body)}"]
        lines += [f"{name}: {value}" for name, value in self.headers(accept).items()]
        connection = self.server.socket()
        connection.sendall(("\r\n".join(lines) + "\r\n\r\n" + body).encode())
        return connection

    def test_a_row_a_variant_with_speed_and_error(self):
        reply = self.evaluate({"spec": SPEC, "variants": HARD_AND_SOFT, "repeats": 3})
        self.assertEqual((reply.status, reply.headers["Content-Type"]), (200, "application/json"), reply.body)
        self.assertEqual(reply.headers["Cache-Control"], "no-store")
        report = reply.json()
        self.assertEqual([row["variant"] for row in report["rows"]], HARD_AND_SOFT)
        for row in report["rows"]:
            self.assertGreater(row["milliseconds"], 0)
            self.assertAlmostEqual(sum(row["stages"].values()), row["milliseconds"], delta=0.5 * row["milliseconds"])
            self.assertGreater(row["memoryBytes"], 0)
            self.assertGreater(row["metrics"]["receivers"], 1000)
            self.assertLess(row["metrics"]["misclassified"], 0.05)
        self.assertTrue(any(row["pareto"] for row in report["rows"]))
        self.assertEqual((report["reference"]["samples"], report["reference"]["frames"]), (256, 1))
        self.assertEqual(report["renderer"], self.server.get("/v1/capabilities").json()["renderer"])

    def test_csv_has_a_line_a_row(self):
        reply = self.evaluate({"spec": SPEC, "variants": HARD_AND_SOFT, "repeats": 1}, "text/csv")
        self.assertEqual(reply.status, 200, reply.body)
        self.assertTrue(reply.headers["Content-Type"].startswith("text/csv"))
        rows = list(csv.DictReader(io.StringIO(reply.body.decode())))
        self.assertEqual([row["name"] for row in rows], ["filter.type hard", "filter.type pcf, filter.size 7"])
        for row in rows:
            self.assertGreater(float(row["milliseconds"]), 0)
            self.assertGreaterEqual(float(row["misclassified"]), 0)
            self.assertIn(row["pareto"], ("true", "false"))

    def test_a_chart_is_an_svg_file(self):
        reply = self.evaluate({"spec": SPEC, "variants": HARD_AND_SOFT, "repeats": 1}, "image/svg+xml")
        self.assertEqual((reply.status, reply.headers["Content-Type"]), (200, "image/svg+xml"), reply.body)
        root = xml.etree.ElementTree.fromstring(reply.body)
        self.assertEqual(root.tag, "{http://www.w3.org/2000/svg}svg")
        self.assertEqual(len(root.findall("{http://www.w3.org/2000/svg}circle")), 2)
        self.assertIn("style-src", reply.headers["Content-Security-Policy"])

    def test_events_tell_progress_rows_and_at_last_the_result(self):
        request = {"spec": SPEC, "variants": [*HARD_AND_SOFT, {"camera": {"node": "nobody"}}], "repeats": 2}
        reply = self.evaluate(request, "text/event-stream")
        self.assertEqual((reply.status, reply.headers["Content-Type"]), (200, "text/event-stream"), reply.body)
        self.assertIsNone(reply.headers["Content-Length"])
        events = events_of(reply.body.decode())
        progress = [data for name, data in events if name == "progress"]
        self.assertEqual([step["done"] for step in progress], list(range(len(progress))))
        self.assertEqual({step["of"] for step in progress}, {len(progress)})
        rows = [data for name, data in events if name == "row"]
        self.assertEqual([("metrics" in row, "problems" in row) for row in rows], [(False, True), (True, False), (True, False)])
        self.assertEqual(events[-1][0], "result")
        result = events[-1][1]
        self.assertEqual(len(result["rows"]), 3)
        self.assertEqual(result["rows"][0]["metrics"], rows[1]["metrics"])
        self.assertEqual(result["rows"][2]["problems"][0]["pointer"], "/camera/node")
        self.assertNotIn("milliseconds", result["rows"][2])

    def test_a_long_report_ends_no_worker(self):
        # Variants that can't be drawn, and so cost nothing, are quoted all the same: more than 1 MiB in all.
        sun = {"sun": {"azimuthDegrees": 120, "elevationDegrees": 40}}
        patch = {"camera": {"node": "nobody"}, "lights": [sun] * 200}
        variants = [{}] + [patch] * 92
        request = {"spec": SPEC, "variants": variants, "repeats": 1}
        self.assertGreater(len(json.dumps(json.dumps(variants, separators=(",", ":")))), 1 << 20)
        for accept in ("text/event-stream", "application/json"):
            with self.subTest(accept):
                reply = self.evaluate(request, accept)
                self.assertEqual(reply.status, 200, reply.body[:1000])
                is_told = accept == "text/event-stream"
                name, result = events_of(reply.body.decode())[-1] if is_told else ("result", reply.json())
                self.assertEqual((name, len(result["rows"])), ("result", len(variants)))
                self.assertEqual(result["rows"][-1]["variant"], patch)
        self.assertNotIn("ended with", self.server.log_text())

    def test_shimmer_is_measured_where_there_is_a_path(self):
        path = {"step": [0.01, 0, 0], "frames": 4}
        snapped = {"stabilization": "projectionSnapping", "depthRange": {"mode": "manual", "min": 0, "max": 40}}
        rows = self.evaluate({"spec": SPEC, "variants": [{"shadow": snapped}], "repeats": 1, "path": path}).json()["rows"]
        self.assertEqual(rows[0]["metrics"]["shimmer"], 0)
        rows = self.evaluate({"spec": SPEC, "variants": [{}], "repeats": 1}).json()["rows"]
        self.assertNotIn("shimmer", rows[0]["metrics"])

    def test_a_spec_that_the_scene_can_not_meet_is_refused(self):
        request = {"spec": {"camera": {"node": "nobody"}}, "sweep": "techniques"}
        self.assert_problem(self.evaluate(request), 400, "/spec/camera/node")
        name, problem = events_of(self.evaluate(request, "text/event-stream").body.decode())[-1]
        self.assertEqual((name, problem["status"]), ("problem", 400))
        self.assertEqual(problem["problems"][0]["pointer"], "/spec/camera/node")

    def test_frames_of_others_go_between(self):
        with self.begin(LONG, "text/event-stream") as connection:
            connection.recv(1)
            start = time.monotonic()
            self.assertEqual(self.server.frame(self.scene, SMALL).status, 200)
            self.assertLess(time.monotonic() - start, 20 * SLOW)
        self.wait_until_free()

    def wait_until_free(self):
        """The seconds until an evaluation is taken again; only a busy server may refuse it."""
        start = time.monotonic()
        while True:
            reply = self.evaluate({"spec": SPEC, "variants": [{}], "repeats": 1})
            if reply.status == 200:
                return time.monotonic() - start
            self.assert_problem(reply, 429)
            self.assertGreaterEqual(int(reply.headers["Retry-After"]), 1)
            self.assertLess(time.monotonic() - start, 30 * SLOW)
            time.sleep(0.05)

    def test_who_leaves_ends_the_evaluation_and_frees_its_place(self):
        for accept in ("text/event-stream", "application/json"):
            with self.subTest(accept), self.begin(LONG, accept) as connection:
                if accept == "text/event-stream":
                    self.assertTrue(connection.recv(1))
                else:
                    time.sleep(0.5 * SLOW)
                self.assert_problem(self.evaluate({"spec": SPEC, "variants": [{}]}), 429)
            # All of it would take minutes.
            self.assertLess(self.wait_until_free(), 30 * SLOW)


class LittleTime(ServerTest):
    flags = ("--evaluation-timeout", "1")

    def test_an_evaluation_has_its_time(self):
        scene = self.server.upload("box_on_plane")
        headers = {"Content-Type": "application/json"}
        reply = self.server.ask("POST", f"/v1/scenes/{scene}/evaluations", json.dumps(LONG), headers)
        self.assert_problem(reply, 504)
        self.assertEqual(reply.json()["problems"][0]["limit"], "1 seconds")
        self.assertEqual(self.server.frame(scene, SMALL).status, 200)


class LittleMemory(ServerTest):
    flags = ("--workers", "1", "--frame-memory-bytes", "40MB")

    def test_an_evaluation_that_does_not_fit_is_refused_before_it_begins(self):
        scene = self.server.upload("box_on_plane")
        headers = {"Content-Type": "application/json"}
        path = f"/v1/scenes/{scene}/evaluations"
        reply = self.server.ask("POST", path, json.dumps({"sweep": "sizes"}), headers)
        self.assert_problem(reply, 413, "/spec/width")
        small = {"spec": SMALL, "variants": [{}], "repeats": 1}
        self.assertEqual(self.server.ask("POST", path, json.dumps(small), headers).status, 200)


if __name__ == "__main__":
    unittest.main()

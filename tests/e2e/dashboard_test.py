"""docker/grafana_dashboard.json and docker/kubernetes/prometheus_adapter.yaml before the real Prometheus, which scrapes a
server that draws: every query has an answer."""

import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

import yaml

from shipped_server import SLOW, SMALL, TIMEOUT, Server

DOCKER = Path(__file__).resolve().parents[2] / "docker"
sys.path.insert(0, str(DOCKER / "checks"))
import dashboard  # noqa: E402

PROMETHEUS = shutil.which("prometheus")
INTERVAL = 8  # seconds over which rates are taken
TARGET = {"namespace": "gnomon", "pod": "gnomon-0"}  # labels, as a ServiceMonitor gives them


class Scraper:
    """Prometheus on a free port, scraping one address every half second."""

    def __init__(self, address):
        self.folder = tempfile.TemporaryDirectory()
        configuration = Path(self.folder.name) / "prometheus.yml"
        scrape = {"job_name": "gnomon", "scrape_interval": "500ms", "scrape_timeout": "500ms",
                  "static_configs": [{"targets": [address], "labels": TARGET}]}  # fmt: skip
        configuration.write_text(yaml.safe_dump({"scrape_configs": [scrape]}), encoding="utf-8")
        self.process = subprocess.Popen(
            [PROMETHEUS, f"--config.file={configuration}", f"--storage.tsdb.path={self.folder.name}/data",
             "--web.listen-address=127.0.0.1:0"], stderr=subprocess.PIPE, text=True)  # fmt: skip
        for line in self.process.stderr:
            if found := re.search(r'msg="Listening on" address=(\S+)', line):
                self.url = f"http://{found[1]}"
                break
        else:
            self.__exit__()
            raise AssertionError("Prometheus does not listen")
        self.reader = threading.Thread(target=self.process.stderr.read)  # so that it never waits for a reader
        self.reader.start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait(TIMEOUT)
        if hasattr(self, "reader"):
            self.reader.join()
        self.process.stderr.close()
        self.folder.cleanup()


def answered(ask):
    """Waits until a query has an answer; why it has none if it never does."""
    end = time.monotonic() + 30 * SLOW
    while (told := ask()) and time.monotonic() < end:
        time.sleep(0.2)
    return told


@unittest.skipUnless(PROMETHEUS, "prometheus is not installed")
class Queries(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        server = Server("--device", "cpu", "--workers", "1", "--admin-port", "0")
        cls.addClassCleanup(server.__exit__)
        server.log_has('"event":"admin"')
        told = next(each for each in server.log_lines() if each["event"] == "admin")
        scraper = Scraper("127.0.0.1:" + told["detail"].rsplit(":", 1)[1])
        cls.addClassCleanup(scraper.__exit__)
        cls.scraper = scraper
        cls.prometheus = dashboard.Prometheus(scraper.url)
        scene, done = server.upload("box_on_plane"), threading.Event()
        cls.addClassCleanup(done.set)

        def draw():  # new pictures and kept ones, so that there are rates of all kinds
            number = 0
            while not done.wait(0.1):
                number += 1
                server.frame(scene, SMALL | {"exposure": 1 + number // 2 / 1000})

        drawing = threading.Thread(target=draw)
        drawing.start()
        cls.addClassCleanup(drawing.join)
        cls.addClassCleanup(done.set)

    def test_every_query_of_the_dashboard_has_an_answer(self):
        told = subprocess.run(
            [sys.executable, "-B", DOCKER / "checks/dashboard.py", self.scraper.url, "--interval", str(INTERVAL)],
            capture_output=True, text=True, timeout=TIMEOUT)  # fmt: skip
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertGreater(int(told.stdout.split()[0]), 30)

    def test_a_query_without_an_answer_is_told(self):
        good = f'sum(rate(gnomon_http_requests_total{{job="gnomon"}}[{INTERVAL}s]))'
        self.assertEqual(answered(lambda: dashboard.fault(self.prometheus, good)), "")
        self.assertEqual(dashboard.fault(self.prometheus, good.replace("requests", "request")), "nothing")
        self.assertEqual(dashboard.fault(self.prometheus, f"{good} * 0 / 0"), "no number")
        with self.assertRaisesRegex(SystemExit, "parse error"):
            dashboard.fault(self.prometheus, good + ")")

    def test_every_rule_of_the_adapter_has_an_answer(self):
        rules = yaml.safe_load((DOCKER / "kubernetes/prometheus_adapter.yaml").read_text(encoding="utf-8"))
        matchers = ",".join(f'{name}="{value}"' for name, value in TARGET.items())
        for rule in rules["rules"]["custom"]:
            with self.subTest(rule["name"]["as"]):
                found = answered(lambda: not self.prometheus.ask("series", **{"match[]": rule["seriesQuery"]}))
                self.assertFalse(found, "no series")
                query = rule["metricsQuery"].replace("<<.LabelMatchers>>", matchers).replace("<<.GroupBy>>", "pod")
                self.assertNotIn("<<", query)
                self.assertEqual(answered(lambda: dashboard.fault(self.prometheus, query)), "")
                result = self.prometheus.ask("query", query=query)["result"]
                self.assertEqual([series["metric"] for series in result], [{"pod": TARGET["pod"]}])


if __name__ == "__main__":
    unittest.main()

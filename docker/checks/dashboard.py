"""Asks every query of docker/grafana_dashboard.json of a Prometheus, until each has a number for an answer.

usage: dashboard.py PROMETHEUS [--instances N] [--job NAME] [--interval SECONDS] [--timeout SECONDS]
"""

import argparse
import json
import math
import re
import sys
import time
import urllib.error
import urllib.parse
import urllib.request
from pathlib import Path

BOARD = Path(__file__).resolve().parents[1] / "grafana_dashboard.json"


class Prometheus:
    def __init__(self, url):
        self.url = url.rstrip("/")

    def ask(self, path, **parameters):
        url = f"{self.url}/api/v1/{path}?{urllib.parse.urlencode(parameters)}"
        try:
            with urllib.request.urlopen(url, timeout=10) as reply:
                return json.load(reply)["data"]
        except urllib.error.HTTPError as error:
            if error.code == 503:
                return None  # it is still reading its own data
            raise SystemExit(f"Prometheus refuses {parameters}: {error.read().decode(errors='replace')}") from error
        except OSError:
            return None  # it is still starting


def queries(board):
    """Each target's panel and query."""
    return [(panel["title"], target["expr"]) for panel in board["panels"] for target in panel.get("targets", [])]


def filled(text, job, interval):
    """As Grafana fills in its variables when all instances are chosen."""
    text = text.replace("$job", job).replace("$instance", ".*").replace("$__rate_interval", f"{interval}s")
    assert "$" not in text, f"an unknown variable: {text}"
    return text


def fault(prometheus, query):
    """Why a query has no answer; none if it has."""
    data = prometheus.ask("query", query=query)
    if not data or not data["result"]:
        return "nothing"
    values = [float(series["value"][1]) for series in data["result"]]
    return "" if any(math.isfinite(value) for value in values) else "no number"


def variable_fault(prometheus, query, instances):
    """Why a variable of the dashboard has nothing to choose from; none if it has."""
    metric, label = re.fullmatch(r"label_values\((.*), (\w+)\)", query).groups()
    found = {series.get(label) for series in prometheus.ask("series", **{"match[]": metric}) or []} - {None}
    least = instances if label == "instance" else 1
    return "" if len(found) >= least else f"{len(found)} values"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("prometheus")
    parser.add_argument("--instances", type=int, default=1, help="servers that there have to be")
    parser.add_argument("--job", default="gnomon")
    parser.add_argument("--interval", type=int, default=30, help="seconds over which rates are taken")
    parser.add_argument("--timeout", type=float, default=90, help="seconds until every query has to have an answer")
    options = parser.parse_args()
    prometheus = Prometheus(options.prometheus)
    board = json.loads(BOARD.read_text(encoding="utf-8"))
    asked = {f"{title}: {query}": lambda query=query: fault(prometheus, filled(query, options.job, options.interval))
             for title, query in queries(board)}  # fmt: skip
    for row in board["templating"]["list"]:
        if row["type"] == "query":
            query = filled(row["query"]["query"], options.job, options.interval)
            asked[f"${row['name']}: {query}"] = lambda query=query: variable_fault(prometheus, query, options.instances)
    count, end = len(asked), time.monotonic() + options.timeout
    while True:
        faults = {name: told for name, ask in asked.items() if (told := ask())}
        asked = {name: asked[name] for name in faults}
        if not faults:
            print(f"{count} queries of the dashboard have answers")
            return 0
        if time.monotonic() > end:
            for name, told in faults.items():
                print(f"no answer ({told}): {name}", file=sys.stderr)
            return 1
        time.sleep(0.5)


if __name__ == "__main__":
    sys.exit(main())

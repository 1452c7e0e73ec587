#!/usr/bin/python3
"""Repeats of one frame, as the server's cache answers them, beside nginx that sends the same bytes from a file: requests
a second and latency, by wrk on the loopback. The two take turns. Needs nginx and wrk.

usage: tests/bench/cached_frames.py BINARY [--seconds N] [--rounds N]
"""

import argparse
import json
import re
import statistics
import subprocess
import sys
import tempfile
import time
import urllib.request
from pathlib import Path

SIZES = [(64, 48), (320, 180), (1280, 720)]
CONNECTIONS = 16

# Debian's defaults, but for the places of its files.
NGINX = """
worker_processes auto;
pid {folder}/nginx.pid;
error_log {folder}/error.log;
events {{ worker_connections 768; }}
http {{
  sendfile on; tcp_nopush on; types_hash_max_size 2048;
  types {{ image/png png; }}
  access_log {folder}/access.log;
  client_body_temp_path {folder}/body; proxy_temp_path {folder}/proxy; fastcgi_temp_path {folder}/fastcgi;
  uwsgi_temp_path {folder}/uwsgi; scgi_temp_path {folder}/scgi;
  keepalive_requests 1000000;
  server {{ listen 127.0.0.1:{port}; root {folder}; }}
}}
"""


def wrk(url, seconds):
    """(requests a second, median milliseconds)"""
    told = subprocess.run(["wrk", "-t1", f"-c{CONNECTIONS}", f"-d{seconds}s", "--latency", url],
                          check=True, capture_output=True, text=True).stdout  # fmt: skip
    if "Non-2xx" in told:
        sys.exit(f"{url} was refused:\n{told}")
    value, unit = re.search(r"50%\s+([\d.]+)(us|ms|s)", told).groups()
    return float(re.search(r"Requests/sec:\s+([\d.]+)", told)[1]), float(value) * {"us": 1e-3, "ms": 1, "s": 1e3}[unit]


def one_by_one(url, count=500):
    """Median milliseconds of requests on one kept connection, one after the other."""
    told = subprocess.run(["curl", "-sS", "-o", "/dev/null", "-w", "%{time_starttransfer} %{time_total}\\n", f"{url}#[1-{count}]"],
                          check=True, capture_output=True, text=True).stdout  # fmt: skip
    return statistics.median(float(line.split()[1]) for line in told.split("\n") if line) * 1000


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary")
    parser.add_argument("--seconds", type=int, default=5)
    parser.add_argument("--rounds", type=int, default=5)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        Path(folder).chmod(0o755)
        server = subprocess.Popen([options.binary, "serve", "--until-stdin-closes", "--port", "0"],
                                  stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                                  stderr=open(Path(folder) / "log", "w"))  # fmt: skip
        url = server.stdout.readline().split()[-1]
        port = int(url.rsplit(":", 1)[1]) + 1
        configuration = Path(folder) / "nginx.conf"
        configuration.write_text(NGINX.format(folder=folder, port=port))
        nginx = subprocess.Popen(["nginx", "-c", str(configuration), "-g", "daemon off;"])
        try:
            demo = Path(options.binary).resolve().parent.parent / "share/gnomon/demo.glb"
            upload = urllib.request.Request(url + "/v1/scenes", demo.read_bytes(), {"Content-Type": "model/gltf-binary"})
            scene = json.load(urllib.request.urlopen(upload))["id"]
            print("| frame | KB | Gnomon, requests/s | nginx, requests/s | Gnomon / nginx | Gnomon, median ms | nginx, median ms | one by one, ms | nginx, ms |")
            print("|---|---|---|---|---|---|---|---|---|")
            for width, height in SIZES:
                frame = f"{url}/v1/scenes/{scene}/frame?width={width}&height={height}"
                data = urllib.request.urlopen(frame).read()
                (Path(folder) / f"{width}.png").write_bytes(data)
                file = f"http://127.0.0.1:{port}/{width}.png"
                time.sleep(0.5)
                rates = {frame: [], file: []}
                for _ in range(options.rounds):
                    for each in rates:
                        rates[each].append(wrk(each, options.seconds))
                (ours, ms), (theirs, their_ms) = (
                    [statistics.median(column) for column in zip(*rates[each])] for each in (frame, file)
                )
                print(f"| {width} x {height} | {len(data) / 1000:.0f} | {ours:.0f} | {theirs:.0f} | **{ours / theirs:.2f}** "
                      f"| {ms:.2f} | {their_ms:.2f} | {one_by_one(frame):.2f} | {one_by_one(file):.2f} |")  # fmt: skip
        finally:
            for process in (server, nginx):
                process.terminate()
                process.wait(20)


if __name__ == "__main__":
    main()

"""Clients that mean well: frames at a steady pace, uploads, the command line, curl, the page in a browser."""

import http.client
import json
import os
import random
import select
import shutil
import signal
import subprocess
import threading
import time
import zlib

from service import PORT

PERIOD = 0.5  # seconds between two frames of one client
WHOLE = {200, 201, 204, 304}


def is_whole_png(data):
    """Whether every chunk is there, with its checksum, up to the end."""
    at = 8
    while data[:8] == b"\x89PNG\r\n\x1a\n" and at + 12 <= len(data):
        length, kind = int.from_bytes(data[at : at + 4], "big"), data[at + 4 : at + 8]
        end = at + 12 + length
        if end > len(data) or zlib.crc32(data[at + 4 : end - 4]) != int.from_bytes(data[end - 4 : end], "big"):
            return False
        if kind == b"IEND":
            return end == len(data)
        at = end
    return False


class Tally:
    """What became of requests, by kind of client. Any thread."""

    def __init__(self):
        self.lock = threading.Lock()
        self.outcomes = {}  # (client, outcome) -> how often
        self.latencies = []  # (when it ended, seconds) of frames that came
        self.broken = []  # what was neither whole nor a problem

    def note(self, client, outcome, seconds=None):
        with self.lock:
            self.outcomes[client, outcome] = self.outcomes.get((client, outcome), 0) + 1
            if seconds is not None:
                self.latencies.append((time.monotonic(), seconds))

    def served(self, client):
        with self.lock:
            return self.outcomes.get((client, "served"), 0)

    def note_broken(self, client, what):
        with self.lock:
            self.broken.append((time.monotonic(), f"{client}: {what}"))


def ask(connection, method, path, body=None, headers=None):
    """Status and body of a whole reply; raises what http.client raises where it is cut."""
    connection.request(method, path, body, headers or {})
    reply = connection.getresponse()
    return reply.status, reply.headers, reply.read()


def check(tally, client, status, headers, body, seconds=None):
    """A reply is whole, or a problem with its words. True = what was asked for."""
    if status in WHOLE:
        if headers.get("Content-Type") == "image/png" and not is_whole_png(body):
            tally.note_broken(client, f"a picture of {len(body)} bytes is cut")
            return False
        tally.note(client, "served", seconds)
        return True
    if headers.get("Content-Type") == "application/problem+json" and json.loads(body).get("problems"):
        tally.note(client, str(status))
    else:
        tally.note_broken(client, f"status {status} without a problem")
    return False


class Client(threading.Thread):
    """Repeats `step` until `stop`; a connection that ends within a request is noted as broken. One that was closed while it
    was idle, as a server may do, is opened again."""

    def __init__(self, name, tally, stop, period, address="127.0.0.1"):
        super().__init__(name=name, daemon=True)
        self.tally, self.stop_event, self.period, self.address = tally, stop, period, address
        self.connection = None

    def connect(self):
        if self.connection is None:
            self.connection = http.client.HTTPConnection("127.0.0.1", PORT, timeout=40, source_address=(self.address, 0))
        return self.connection

    def ask(self, *request):
        """As ask(), on the connection that is kept."""
        if self.connection and self.connection.sock and select.select([self.connection.sock], [], [], 0)[0]:
            self.tally.note(self.name, "closed while idle")
            self.connection = None
        return ask(self.connect(), *request)

    def run(self):
        due = time.monotonic()
        while not self.stop_event.is_set():
            try:
                self.step()
            except Exception as error:  # noqa: BLE001 - whatever it is, the client goes on
                self.tally.note_broken(self.name, repr(error))
                self.connection = None
            due = max(due + self.period, time.monotonic())
            self.stop_event.wait(due - time.monotonic())


class Frames(Client):
    """Somebody who drags the sun: a new picture twice a second."""

    def __init__(self, number, tally, stop, scene):
        super().__init__(f"frames {number}", tally, stop, PERIOD, f"127.0.2.{number + 1}")
        self.scene = scene

    def step(self):
        spec = {"width": 320, "height": 180,
                "lights": [{"sun": {"azimuthDegrees": random.uniform(0, 360), "elevationDegrees": 40}}]}  # fmt: skip
        begun = time.monotonic()
        reply = self.ask("POST", f"/v1/scenes/{self.scene}/frames", json.dumps(spec),
                         {"Content-Type": "application/json", "Accept": "image/png"})  # fmt: skip
        check(self.tally, "frames", *reply, time.monotonic() - begun)


class Uploads(Client):
    """Small models, each of its own; `accepted` has the ids that were answered with 201."""

    def __init__(self, tally, stop, model):
        super().__init__("uploads", tally, stop, 1.0)
        self.model, self.accepted = model, []

    def step(self):
        text = json.loads(self.model)
        text["extras"] = {"number": random.getrandbits(64)}
        reply = self.ask("POST", "/v1/scenes", json.dumps(text), {"Content-Type": "model/gltf+json"})
        if check(self.tally, "uploads", *reply):
            self.accepted.append(json.loads(reply[2])["id"])


class SteadyReader(Client):
    """Takes large pictures at a steady pace, each of them for half a minute."""

    SECONDS = 30
    SLICES = 8  # a second

    def __init__(self, number, rate, tally, stop, scene):
        super().__init__(f"reader of {rate >> 10} KiB/s", tally, stop, 1.0, f"127.0.3.{number + 1}")
        self.rate, self.scene = rate, scene

    def step(self):
        side = int((self.rate * self.SECONDS / 12) ** 0.5)  # three floats a pixel
        spec = {"width": side, "height": side, "output": {"format": "exr", "exrPixelType": "float", "exrCompression": "none"}}
        self.connection = None  # one that was idle may be closed
        connection = self.connect()
        connection.request("POST", f"/v1/scenes/{self.scene}/frames", json.dumps(spec), {"Content-Type": "application/json"})
        reply = connection.getresponse()
        length, begun, taken = int(reply.headers["Content-Length"]), time.monotonic(), 0
        while taken < length:
            data = reply.read(min(self.rate // self.SLICES, length - taken))
            if not data:
                break
            taken += len(data)
            time.sleep(max(taken / self.rate - (time.monotonic() - begun), 0))
        if reply.status != 200:
            self.tally.note(self.name, str(reply.status))
        elif taken < length:
            self.tally.note_broken(self.name, f"cut after {taken} of {length} bytes")
        else:
            self.tally.note(self.name, "served")


class Newcomer(Client):
    """Comes from a new address each second, as a balancer would send it: asks /readyz, and then for a frame."""

    def __init__(self, tally, stop, scene):
        super().__init__("newcomer", tally, stop, 1.0)
        self.scene = scene

    def step(self):
        self.connection, self.address = None, f"127.0.4.{random.randint(1, 254)}"
        ready, _, _ = ask(self.connect(), "GET", "/readyz")
        spec = {"width": 64, "height": 36, "lights": [{"sun": {"azimuthDegrees": random.uniform(0, 360), "elevationDegrees": 40}}]}
        status, _, _ = ask(self.connect(), "POST", f"/v1/scenes/{self.scene}/frames", json.dumps(spec),
                           {"Content-Type": "application/json", "Accept": "image/png"})  # fmt: skip
        said = "ready" if ready == 200 else "not ready"
        self.tally.note(self.name, f"{said}, and {'served' if status == 200 else status}")


class Program(Client):
    """A program that is run again and again: curl, the command line, a browser. One that does not end within its
    patience is killed with all that it started, and counts as a failed attempt."""

    def __init__(self, name, tally, stop, period, command, patience=60):
        super().__init__(name, tally, stop, period)
        self.command, self.patience = command, patience

    def step(self):
        program = subprocess.Popen(self.command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True)
        try:
            output, errors = program.communicate(timeout=self.patience)
        except subprocess.TimeoutExpired:
            os.killpg(program.pid, signal.SIGKILL)
            program.communicate()
            self.tally.note(self.name, f"not done within {self.patience} s")
            return
        if program.returncode == 0:
            self.tally.note(self.name, "served")
        else:
            words = (errors or output).decode(errors="replace").strip().splitlines()
            self.tally.note(self.name, f"ended with {program.returncode}: " + (words[-1][:80] if words else ""))


def never_served(tally, clients):
    names = [client.name for client in clients if isinstance(client, (Program, SteadyReader))]
    return [f"{name} was never served" for name in names if not tally.served(name)]


def programs(tally, stop, binary, url, scene, demo, folder):
    """Those of them that this machine has."""
    query = f"{url}/v1/scenes/{scene}/frame?width=160&height=90"
    found = [
        Program("curl", tally, stop, 2, ["curl", "-fsS", "-m", "30", "-o", os.devnull, query]),
        Program("gnomon", tally, stop, 5,
                [binary, "render", demo, "--server", url, "--width", "160", "--height", "90", "-o", f"{folder}/cli.png"]),
    ]  # fmt: skip
    browser = shutil.which("chromium")
    if browser:
        found.append(
            Program("page", tally, stop, 15,
                    [browser, "--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=4000",
                     f"--user-data-dir={folder}/browser", f"--screenshot={folder}/page.png", url + "/"])
        )  # fmt: skip
    else:
        print("no chromium here: the page is left out")
    return found

"""Clients that mean ill, each from an address of its own on the loopback. Started as a process of low priority, since
elsewhere they would not take this machine's processor."""

import json
import os
import random
import re
import socket
import struct
import threading
import time
from pathlib import Path

from service import PORT

HOST = b"Host: localhost\r\n"


def connected(number, timeout=20):
    return socket.create_connection(("127.0.0.1", PORT), timeout=timeout, source_address=(f"127.0.1.{number}", 0))


def posting(path, body, length=None, kind=b"application/json"):
    length = len(body) if length is None else length
    return (b"POST %s HTTP/1.1\r\n" % path.encode() + HOST + b"Content-Type: %s\r\nContent-Length: %d\r\n\r\n" % (kind, length)
            + body)  # fmt: skip


def drain(connection):
    while connection.recv(1 << 16):
        pass


def slow_heads(_scene):
    """Hundreds of heads, a byte at a time."""
    held = [connected(10) for _ in range(100)]
    for byte in b"GET /livez HTTP/1.1\r\nHost: localhost\r\nX: " + b"y" * 20:
        for connection in held:
            connection.send(bytes([byte]))
        time.sleep(0.5)


def slow_bodies(_scene):
    """Uploads that promise much and drip."""
    held = [connected(11) for _ in range(20)]
    for connection in held:
        connection.sendall(posting("/v1/scenes", b"glTF", 50 << 20, b"model/gltf-binary"))
    for _ in range(20):
        for connection in held:
            connection.send(bytes(1000))
        time.sleep(1)


def unread_replies(scene):
    """Large pictures that nobody takes."""
    held = []
    for _ in range(6):
        connection = connected(12)
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        spec = {"width": 1600, "height": 1200, "output": {"pngCompression": 0},
                "camera": {"orbit": {"azimuthDegrees": random.uniform(0, 360)}}}  # fmt: skip
        connection.sendall(posting(f"/v1/scenes/{scene}/frames", json.dumps(spec).encode()))
        held.append(connection)
    time.sleep(12)


def vanishing(scene):
    """Frames whose client is gone at once: half closed, or reset."""
    for number in range(50):
        connection = connected(13)
        spec = {"width": 800, "height": 600, "camera": {"orbit": {"azimuthDegrees": random.uniform(0, 360)}}}
        connection.sendall(posting(f"/v1/scenes/{scene}/frames", json.dumps(spec).encode()))
        if number % 2:
            connection.shutdown(socket.SHUT_WR)
            time.sleep(0.1)
        else:
            connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        connection.close()


def idle_connections(_scene):
    """More connections than anyone needs, all silent."""
    held = []
    try:
        for _ in range(1500):
            held.append(connected(14))
    except OSError:
        pass
    time.sleep(5)


def noise(_scene):
    """Bytes that are no HTTP, and heads that never end."""
    for _ in range(40):
        connection = connected(15)
        connection.sendall(random.randbytes(3000) if random.random() < 0.5 else b"GET / HTTP/1.1\r\n" + b"A: b\r\n" * 5000)
        drain(connection)


def costly_requests(scene):
    """All that a spec may ask for at once, and more."""
    for _ in range(5):
        spec = {"width": 4096, "height": 4096, "shadow": {"technique": "rayTraced"},
                "lights": [{"sun": {"azimuthDegrees": random.uniform(0, 360), "elevationDegrees": 5},
                            "angularDiameterDegrees": 10, "shadow": {"raySamples": 1024}}]}  # fmt: skip
        connection = connected(16)
        connection.sendall(posting(f"/v1/scenes/{scene}/frames", json.dumps(spec).encode()))
        connection.settimeout(2)
        drain(connection)


def broken_models(_scene):
    """Models whose numbers lie: huge counts, deep nesting, cut files."""
    huge = {"asset": {"version": "2.0"}, "buffers": [{"byteLength": 1 << 40}],
            "accessors": [{"componentType": 5126, "count": 1 << 31, "type": "VEC3"}] * 1000}  # fmt: skip
    for body in (json.dumps(huge).encode(), b"[" * 200_000, b"glTF" + struct.pack("<II", 2, 1 << 31), random.randbytes(1 << 20)):
        connection = connected(17)
        connection.sendall(posting("/v1/scenes", body, kind=b"model/gltf-binary"))
        connection.settimeout(5)
        drain(connection)


def numbered(number):
    """An address of its own for each of thousands of clients."""
    return f"127.1.{number // 250}.{number % 250 + 1}"


def idle_streams(scene):
    """A thousand addresses that each follow one long job, and never read its events."""
    job = json.dumps({"spec": {"width": 1280, "height": 720}, "frames": [{"exposure": i / 500} for i in range(1000)]})
    asked = posting(f"/v1/scenes/{scene}/sequences", job.encode()).replace(HOST, HOST + b"Prefer: respond-async\r\n")
    first = connected(19)
    first.sendall(asked)
    address = re.search(rb"Location: (\S+)", first.recv(1 << 16))
    if not address:
        return time.sleep(5)
    held = []
    try:
        for number in range(1000):
            held.append(socket.create_connection(("127.0.0.1", PORT), 20, (numbered(number), 0)))
            held[-1].sendall(b"GET %s HTTP/1.1\r\n" % address[1] + HOST + b"Accept: text/event-stream\r\n\r\n")
    except OSError:
        pass
    time.sleep(20)
    first.sendall(b"DELETE %s HTTP/1.1\r\n" % address[1] + HOST + b"\r\n")


def npy(side):
    """A cube of floats."""
    head = b"{'descr': '<f4', 'fortran_order': False, 'shape': (%d, %d, %d), }" % (side, side, side)
    head += b" " * (64 - (len(head) + 11) % 64) + b"\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head + struct.pack("<f", 0.5) * side**3


def many_volumes(_scene):
    """Sixteen grids that light and shade each other."""
    names = [f"v{i}.npy" for i in range(16)]
    model = b'{"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "scene": 0, "nodes": [{"name": "empty"}]}'
    parts = [(b'name="scene"; filename="a.gltf"', model)]
    parts += [(b'name="file"; filename="%s"' % name.encode(), npy(64)) for name in names]
    body = b"".join(b"--cut\r\nContent-Disposition: form-data; " + head + b"\r\n\r\n" + data + b"\r\n" for head, data in parts)
    connection = connected(20)
    connection.sendall(posting("/v1/scenes", body + b"--cut--\r\n", kind=b"multipart/form-data; boundary=cut"))
    stored = re.search(rb'"id": ?"([^"]+)"', connection.recv(1 << 16))
    if not stored:
        return time.sleep(5)
    steps = [{"value": 0, "extinction": 0}, {"value": 1, "extinction": 0.01}]
    boxes = [{"min": [-80 + 10 * i, 0, -80], "max": [-60 + 10 * i, 40, 80]} for i in range(16)]
    volumes = [{"file": name, "box": box, "transferFunction": steps} for name, box in zip(names, boxes)]
    spec = json.dumps({"width": 320, "height": 240, "lights": [{"sun": {"azimuthDegrees": 30, "elevationDegrees": 40}}], "volumes": volumes})
    for _ in range(5):
        connection = connected(20, 60)
        connection.sendall(posting(f"/v1/scenes/{stored[1].decode()}/frames", spec.encode()))
        connection.recv(1 << 16)


LIES = re.findall(r'\{"((?:lie|fault)-[a-z-]+)"', (Path(__file__).parent.parent / "server/faulty_worker.cpp").read_text())


def lying_workers(scene):
    """Requests whose worker does what one would do that was taken over; see tests/server/faulty_worker.cpp."""
    for lie in LIES:
        spec = {"width": 64, "height": 36, "camera": {"node": lie}}
        connection = connected(21)
        connection.sendall(posting(f"/v1/scenes/{scene}/frames", json.dumps(spec).encode()))
        connection.recv(1 << 16)
        time.sleep(1)


def flood(scene):
    """Good frames without end, from one address: of all that the workers can do, ten times."""
    for _ in range(200):
        spec = {"width": 640, "height": 360, "camera": {"orbit": {"azimuthDegrees": random.uniform(0, 360)}}}
        connection = connected(18)
        request = posting(f"/v1/scenes/{scene}/frames", json.dumps(spec).encode())
        connection.sendall(request.replace(HOST, HOST + b"Connection: close\r\n"))
        drain(connection)


ATTACKS = [slow_heads, slow_bodies, unread_replies, vanishing, idle_connections, idle_streams, noise, costly_requests,
           many_volumes, broken_models, lying_workers]  # fmt: skip
FLOODS = 90  # of them, four are drawn and 64 may wait


def repeat(attack, scene):
    while True:
        try:
            attack(scene)
        except OSError:
            time.sleep(0.05)


def main(scene):
    os.nice(19)
    for attack in ATTACKS + [flood] * FLOODS:
        threading.Thread(target=repeat, args=(attack, scene), daemon=True).start()
    while os.getppid() != 1:
        time.sleep(1)

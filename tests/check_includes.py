#!/usr/bin/env python3
"""Holds every #include of the source tree against the order of the house.

usage: check_includes.py [ROOT]      prints one line a fault; exit status 1 if there is any

Who may include whom, one way:
  protocol/base <- protocol <- renderer/core <- renderer/image <- renderer/environment <- renderer/scene; core <- renderer/{shadow,volume,video};
  scene, volume <- renderer/rays <- renderer/bake, renderer/reference; scene, shadow <- renderer/prepare <- renderer/resolve;
  bake, prepare <- renderer/techniques;
  bake, resolve, volume <- renderer/device <- renderer/frame <- renderer/evaluation, renderer/export
           <- renderer/render.h <- server/worker;
  reference <- evaluation, and of frame only the error views: what draws never sees what judges it;
  protocol <- server/system <- server/redis, server/wire <- server/worker, server/http <- server/access, server/scenes <- server/dispatch
           <- server/metrics <- server/handlers <- server/process: of the server, only its workers see the renderer;
  clients see protocol and renderer/render.h. Beside that way, renderer/cpu and renderer/{gl,passes,shaders} implement
  renderer/device: only render.cpp knows them, by one header each.
"""

import re
import sys
from pathlib import Path

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^">]+)[">]')
ROOMS = ("protocol", "renderer", "server", "clients")

VALUES = ["protocol", "renderer/core", "renderer/image", "renderer/environment", "renderer/scene", "renderer/shadow"]
PREPARED = VALUES + ["renderer/shaders/shared", "renderer/prepare"]
SETTLED = PREPARED + ["renderer/rays", "renderer/resolve"]
DEVICE = SETTLED + ["renderer/bake", "renderer/volume", "renderer/device"]
FRAME = DEVICE + ["renderer/frame"]

BOTH_PROCESSES = ["protocol", "server/system", "server/wire"]
FRONT = BOTH_PROCESSES + ["server/redis", "server/http", "server/access", "server/scenes", "server/dispatch", "server/frames", "server/bakes", "server/jobs",
                          "server/metrics"]

# Folder -> folders, or single headers, that its files may include.
MAY_INCLUDE = {
    "protocol/base": ["protocol/base"],
    "protocol": ["protocol"],
    "renderer/core": ["protocol", "renderer/core"],
    "renderer/image": ["protocol", "renderer/core", "renderer/image"],
    "renderer/environment": ["protocol", "renderer/core", "renderer/image", "renderer/shaders/shared", "renderer/environment"],
    "renderer/scene": ["protocol", "renderer/core", "renderer/image", "renderer/environment", "renderer/scene"],
    "renderer/shadow": ["protocol", "renderer/core", "renderer/shadow"],
    "renderer/volume": ["protocol", "renderer/core", "renderer/volume"],
    "renderer/rays": ["protocol", "renderer/core", "renderer/image", "renderer/scene", "renderer/shaders/shared", "renderer/volume", "renderer/rays"],
    "renderer/reference": ["protocol", "renderer/core", "renderer/environment", "renderer/scene", "renderer/rays", "renderer/reference"],
    "renderer/bake": ["protocol", "renderer/core", "renderer/environment", "renderer/scene", "renderer/rays", "renderer/bake"],
    "renderer/shaders": ["renderer/shaders", "renderer/shaders/shared"],
    "renderer/shaders/shared": ["renderer/shaders/shared"],
    "renderer/prepare": PREPARED,
    "renderer/techniques": PREPARED + ["renderer/rays", "renderer/bake", "renderer/techniques"],
    "renderer/resolve": PREPARED + ["renderer/resolve"],
    "renderer/device": DEVICE,
    "renderer/frame": FRAME,
    "renderer/frame/frame_views.h": FRAME + ["renderer/reference"],
    "renderer/frame/frame_views.cpp": FRAME + ["renderer/reference"],
    "renderer/frame/predicted_displacement.cpp": FRAME + ["renderer/reference"],
    "renderer/export": FRAME + ["renderer/export"],
    "renderer/evaluation": FRAME + ["renderer/reference", "renderer/evaluation"],
    "renderer/cpu": DEVICE + ["renderer/techniques", "renderer/cpu"],
    "renderer/gl": VALUES + ["renderer/shaders", "renderer/gl"],
    "renderer/passes": DEVICE + ["renderer/techniques", "renderer/shaders", "renderer/gl", "renderer/passes"],
    "renderer/charts": ["protocol", "renderer/charts"],
    "renderer/video": ["protocol", "renderer/core", "renderer/video"],
    "renderer": FRAME + ["renderer/evaluation", "renderer/export", "renderer/charts", "renderer/video", "renderer/cpu/cpu_device.h", "renderer/passes/gl_device.h",
                 "renderer"],
    "server/system": ["protocol/base", "server/system", "renderer/core/control_groups.h"],
    "server/redis": ["protocol/base", "server/system", "server/redis"],
    "server/wire": BOTH_PROCESSES,
    "server/worker": BOTH_PROCESSES + ["server/worker", "renderer/core/file_access.h", "renderer/core/parallel.h", "renderer/core/system_calls.h"],
    "server/http": BOTH_PROCESSES + ["server/http"],
    "server/access": BOTH_PROCESSES + ["server/http", "server/access"],
    "server/scenes": BOTH_PROCESSES + ["server/http", "server/redis", "server/scenes"],
    "server/dispatch": BOTH_PROCESSES + ["server/scenes", "server/dispatch"],
    "server/frames": BOTH_PROCESSES + ["server/http", "server/frames"],
    "server/bakes": ["protocol", "server/bakes"],
    "server/jobs": BOTH_PROCESSES + ["server/redis", "server/jobs"],
    "server/metrics": BOTH_PROCESSES + ["server/http", "server/scenes", "server/dispatch", "server/frames", "server/jobs", "server/metrics"],
    "server/handlers": FRONT + ["server/handlers", "renderer/video"],
    "server/process": FRONT + ["server/handlers", "server/process", "renderer/core/parallel.h"],
    "server": ["protocol", "server"],
    "clients/cli": ["protocol", "clients/cli"],
    "clients/web": ["clients/web"],
}

# These also see the renderer's door: render.h, and the headers that it includes itself.
DOOR = "renderer/render.h"
AT_THE_DOOR = ("server/worker", "clients/cli")

# The assembler puts the parts together, and so sees the clients that it offers.
ASSEMBLER = "server/main.cpp"
ASSEMBLED = ["clients/cli", "clients/web"]

# Third-party header (the first characters of its path) -> the only files or folders that may include it.
KEPT_IN = {
    "httplib.h": ["clients/cli/remote/http_client.cpp"],
    "openssl/": ["protocol/base", "server/redis"],
    "hiredis/": ["server/redis"],
    "prometheus/": ["server/metrics"],
    "nlohmann/": [
        "protocol",
        "server",
        "clients/cli",
        "renderer/charts",
        "renderer/export",
        "renderer/frame_encoding.cpp",
        "renderer/scene/checks",
        "renderer/scene/container/json_text.h",
        "renderer/scene/document",
    ],
    "tiny_gltf.h": ["tests"],
    "draco/": ["renderer/scene/decode"],
    "meshoptimizer.h": ["renderer/scene"],
    "OpenImageIO/": ["tests"],
    "OpenEXR/": ["renderer/image"],
    "isa-l/": ["renderer/image"],
    "libdeflate.h": ["protocol/base", "renderer/image"],
    "tiffio.h": ["renderer/image"],
    "zlib.h": ["renderer/image"],
    "glad/": ["renderer/gl", "renderer/passes"],
    "GL/": ["renderer/gl"],
    "EGL/": ["renderer/gl"],
    "embree3/": ["renderer/rays"],
    "hwy/": ["renderer/cpu"],
    "openvdb/": ["renderer/volume/vdb"],
    "seccomp.h": ["renderer/core/system_calls.cpp"],
    "systemd/": ["server/process/service_manager.cpp"],
    "tbb/": ["renderer/core/parallel.cpp", "renderer/volume/vdb"],
    "vpx/": ["renderer/video"],
}


def inside(path, place):
    return path == place or path.startswith(place + "/")


def room_of(path):
    """The folder of MAY_INCLUDE that `path` lies in, at any depth; None where no rule speaks of it."""
    rooms = [room for room in MAY_INCLUDE if inside(path, room)]
    room = max(rooms, key=len, default=None)
    # A new folder of the renderer needs a rule of its own.
    return None if room == "renderer" and path.count("/") > 1 else room


def rooms_around(path):
    """The rooms that `path` lies in, the outer ones too; only what lies in no room of its own is the renderer's."""
    rooms = [room for room in MAY_INCLUDE if inside(path, room) and room != "renderer"]
    return rooms or [room_of(path)]


def includes_of(file):
    """(line number, '<' or '"', path) of each include of a file."""
    lines = file.read_text(encoding="utf-8").splitlines()
    matches = [(number, INCLUDE.match(line)) for number, line in enumerate(lines, 1)]
    return [(number, match.group(1), match.group(2)) for number, match in matches if match]


def door_of(root):
    """render.h and the renderer's headers that it includes."""
    door = root / DOOR
    seen = [path for _, _, path in includes_of(door) if inside(path, "renderer")] if door.exists() else []
    return [DOOR] + seen


def may_include(path, target, door):
    allowed = MAY_INCLUDE[room_of(path)] + (ASSEMBLED if path == ASSEMBLER else [])
    at_the_door = any(inside(path, place) for place in AT_THE_DOOR)
    seen = target in allowed or any(room in allowed for room in rooms_around(target))
    return seen or (at_the_door and target in door)


def fault_of(root, path, kind, target, door):
    """What is wrong with `path` including `target`; None if nothing is."""
    for header, places in KEPT_IN.items():
        if target.startswith(header):
            allowed = any(inside(path, place) for place in places)
            return None if allowed else f"{target} belongs to {', '.join(places)} alone"
    if kind == "<":
        return f"<{target}> is ours, and is written in quotes" if (root / target).exists() else None
    if not (root / target).exists():
        return f'"{target}" is no file of the tree; includes are written from its root'
    if room_of(path) is None:
        return "its folder has no rule in tests/check_includes.py"
    return None if may_include(path, target, door) else f'"{target}" is not below {room_of(path)}'


def faults_of_file(root, file, door):
    path = file.relative_to(root).as_posix()
    includes = includes_of(file)
    for number, kind, target in includes:
        fault = fault_of(root, path, kind, target, door)
        if fault:
            yield f"{path}:{number}: {fault}"
    own = file.with_suffix(".h").relative_to(root).as_posix()
    if file.suffix == ".cpp" and (root / own).exists() and (not includes or includes[0][2] != own):
        yield f'{path}: its own header "{own}" is not its first include'


def faults_of_tree(root):
    door = door_of(root)
    for room in ROOMS:
        for file in sorted((root / room).rglob("*")):
            if file.suffix in (".h", ".cpp") and file.is_file():
                yield from faults_of_file(root, file, door)


def main(arguments):
    root = Path(arguments[0]) if arguments else Path(__file__).resolve().parent.parent
    faults = list(faults_of_tree(root))
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

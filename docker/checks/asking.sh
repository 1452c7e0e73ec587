# shellcheck shell=bash
# Sourced by docker/check: what every step asks of a server.

: "${work:?}"

# A PNG with many different bytes: a picture, and not a blank one.
isPicture() {
  python3 - "$1" <<'PY'
import struct, sys, zlib
data, at, pixels = open(sys.argv[1], "rb").read(), 8, b""
assert data[:8] == b"\x89PNG\r\n\x1a\n", "no PNG"
while at < len(data):
    length, kind = struct.unpack(">I4s", data[at:at + 8])
    pixels += data[at + 8:at + 8 + length] if kind == b"IDAT" else b""
    at += length + 12
assert len(set(zlib.decompress(pixels))) > 32, "the picture is blank"
PY
}

# usage: waitFor SECONDS COMMAND...      until it succeeds
waitFor() {
  local end=$((SECONDS + $1))
  shift
  until "$@"; do
    [ $SECONDS -lt $end ] || return 1
    sleep 0.2
  done
}

key=() # a header, where the server asks for one
ask() { curl -fsS -m 60 "${key[@]}" "$@"; }
isReady() { curl -fsS -m 2 -o /dev/null "$1/readyz" 2>/dev/null; }

# usage: hasStore URL      whether the replica that answers reaches its store
hasStore() { ask -o /dev/null "$1/v1/scenes" 2>/dev/null; }

# usage: demoOf CONTAINER      prints the file with the demo scene of its image
demoOf() {
  podman cp "$1:/usr/local/share/gnomon/demo.glb" "$work/demo.glb"
  echo "$work/demo.glb"
}

# usage: upload URL FILE      prints the scene's id
upload() {
  ask -H "Content-Type: model/gltf-binary" -H "Content-Digest: sha-256=:$(openssl dgst -sha256 -binary "$2" | base64):" \
    --data-binary "@$2" "$1/v1/scenes" |
    python3 -c 'import json, sys; print(json.load(sys.stdin)["id"])'
}

# usage: draw URL ID SPEC PNG
draw() {
  ask -H 'Accept: image/png' -H 'Content-Type: application/json' -d "$3" -o "$4" "$1/v1/scenes/$2/frames"
}

# usage: drawMany URL ID COUNT      prints each frame's status and the replica that served it; all of them differ
drawMany() {
  local i
  for i in $(seq "$3"); do
    curl -s -m 60 "${key[@]}" -o /dev/null -w '%{http_code} %header{x-served-by}\n' -H 'Content-Type: application/json' \
      -d "{\"width\":96,\"height\":64,\"exposure\":0.$((1000 + i))}" "$1/v1/scenes/$2/frames"
  done
}

# usage: servedBy URL      prints the replicas that serve it, one a line
servedBy() {
  local i
  for i in 1 2 3 4 5 6 7 8; do
    ask -o /dev/null -w '%header{x-served-by}\n' "$1/v1/capabilities"
  done | sort -u
}
hasReplicas() { [ "$(servedBy "$1" 2>/dev/null | wc -l)" = "$2" ]; }

# usage: drewMost CONTAINER...      prints the one of these servers that was asked for most frames
drewMost() {
  local name
  for name in "$@"; do
    echo "$(podman logs "$name" 2>&1 | grep -c '/frames"') $name"
  done | sort -n | tail -1 | cut -d' ' -f2
}

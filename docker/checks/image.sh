# shellcheck shell=bash
# Sourced by docker/check: the image alone, run the way it is meant to be deployed: read-only root, no capabilities, no new
# privileges, a numeric user, limits on memory, cores and processes.

: "${image:?}" "${work:?}"

build all "$image" 340
build cpu "$image-cpu" 200

hardened=(--read-only --tmpfs "/tmp:rw,nosuid,nodev,size=64m,mode=1777" --cap-drop=ALL
  --security-opt=no-new-privileges --user 65532:65532 --pids-limit 512 --memory 1g --memory-swap 1g --cpus 2)
demo=/usr/local/share/gnomon/demo.glb

# A frame in process, with no network at all.
install -d -o 65532 -g 65532 "$work/out"
podman run --rm "${hardened[@]}" --network=none -v "$work/out:/out" "$image" render "$demo" -o /out/frame.png
isPicture "$work/out/frame.png"
say "rendered the demo scene with no network"

podman run --rm "${hardened[@]}" --network=none -v "$work/out:/out" "$image" render "$demo" -o /out/gl.png --device gl
isPicture "$work/out/gl.png"
say "and by OpenGL"
podman run --rm "${hardened[@]}" --network=none -v "$work/out:/out" "$image-cpu" render "$demo" -o /out/cpu.png
cmp "$work/out/frame.png" "$work/out/cpu.png" || fail "the image without OpenGL draws another picture"
if podman run --rm "${hardened[@]}" "$image-cpu" render "$demo" -o /tmp/gl.png --device gl 2>"$work/refusal"; then
  fail "the image without OpenGL draws with it"
fi
grep -q libEGL "$work/refusal" || fail "the image without OpenGL does not say what is missing: $(cat "$work/refusal")"
say "without OpenGL it draws the same, and says what is missing"

# The list of what is in the image.
podman create -q "$image" >"$work/id"
endings+=("podman rm -f -v $(cat "$work/id")")
podman cp "$(cat "$work/id"):/usr/local/share/doc/gnomon/sbom.cdx.json" "$work/sbom.json"
python3 - "$work/sbom.json" <<'PY'
import json, sys
listed = json.load(open(sys.argv[1]))
assert listed["bomFormat"] == "CycloneDX" and len(listed["components"]) > 25, listed
for component in listed["components"]:
    assert component["version"] and component["purl"].startswith("pkg:deb/debian/" + component["name"] + "@"), component
names = {component["name"] for component in listed["components"]}
missing = {"libc6", "libembree3-3", "libopenvdb10.0", "libwebp7", "libgl1-mesa-dri", "libllvm15"} - names
assert not missing, missing
PY
say "the SBOM names what is in the image"

# The server: healthy by its own check, and a frame over HTTP that is the same to the byte.
container=$(podman run -d "${hardened[@]}" -p 127.0.0.1::8080 "$image")
endings+=("podman rm -f -v -t 3 $container")
url=http://$(podman port "$container" 8080/tcp)
waitFor 60 isReady "$url" || { podman logs "$container" >&2; fail "the server does not become ready"; }
podman healthcheck run "$container" || fail "gnomon health says no"
say "serving and healthy"

id=$(upload "$url" "$(demoOf "$container")")
draw "$url" "$id" '{}' "$work/http.png"
isPicture "$work/http.png"
cmp "$work/out/frame.png" "$work/http.png" || fail "the frame over HTTP differs from the one rendered in process"
say "a frame over HTTP is the same, byte for byte"

podman stop -t 20 "$container" >/dev/null
status=$(podman inspect "$container" --format '{{.State.ExitCode}}')
[ "$status" = 0 ] || { podman logs "$container" >&2; fail "stopped with status $status"; }
say "stopped cleanly"

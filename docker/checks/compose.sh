# shellcheck shell=bash
# Sourced by docker/check: docker/compose.yaml as it stands, with the images of services.Dockerfile, brought up by
# podman-compose on free ports.

: "${image:?}" "${base:?}" "${work:?}"

needPackages podman-compose

buildServices redis haproxy prometheus

project=gnomon-check-$$
compose() {
  GNOMON_IMAGE=$image REDIS_IMAGE=localhost/gnomon-redis:check HAPROXY_IMAGE=localhost/gnomon-haproxy:check \
    PROMETHEUS_IMAGE=localhost/gnomon-prometheus:check PROXY_ADDRESS=127.0.0.1: PROMETHEUS_ADDRESS=127.0.0.1: \
    podman-compose -f docker/compose.yaml -p "$project" "$@" >"$work/compose.log" 2>&1
}
removeProject() {
  podman ps -aq --filter "label=com.docker.compose.project=$project" | xargs -r podman rm -f -v -t 3
  podman volume ls -q --filter "label=com.docker.compose.project=$project" | xargs -r podman volume rm
  podman network rm -f "${project}_default"
}
endings+=(removeProject)
compose up -d || { tail -40 "$work/compose.log" >&2; fail "compose.yaml does not come up"; }

url=http://$(podman port "${project}_haproxy_1" 8080/tcp)
waitFor 60 hasReplicas "$url" 2 || { podman logs "${project}_gnomon_1" >&2; fail "HAProxy does not see two replicas"; }
for _ in 1 2 3 4; do
  waitFor 60 hasStore "$url" || fail "the replicas do not reach Redis"
done
say "two replicas answer through HAProxy"

id=$(upload "$url" "$(demoOf "${project}_gnomon_1")")
draw "$url" "$id" '{}' "$work/compose.png"
isPicture "$work/compose.png"
podman exec "${project}_redis_1" redis-cli --scan | grep -q "$id" || fail "Redis knows nothing of the scene"
say "a frame came through HAProxy, and its scene is in Redis"

# The replica whose scene it is goes without a word, while frames are asked for.
drawMany "$url" "$id" 60 >"$work/load" &
load=$!
waitFor 60 test -s "$work/load"
killed=$(drewMost "${project}_gnomon_1" "${project}_gnomon_2")
podman kill -s KILL "$killed" >/dev/null
wait "$load"
[ "$(grep -c '^200 ' "$work/load")" = 60 ] || { sort "$work/load" | uniq -c >&2; fail "frames failed as a replica was killed"; }
[ "$(cut -d' ' -f2 "$work/load" | sort -u | wc -l)" = 2 ] || fail "the other replica never took over"
say "a replica was killed among 60 frames: each was drawn"

podman start "$killed" >/dev/null
waitFor 60 hasReplicas "$url" 2 || fail "the replica does not come back"
prometheus=http://$(podman port "${project}_prometheus_1" 9090/tcp)
drawMany "$url" "$id" 60 >"$work/load" & # so that there are rates to tell
load=$!
python3 -B docker/checks/dashboard.py "$prometheus" --instances 2
wait "$load"
say "every query of the dashboard has an answer from Prometheus"

# Redis goes without a word: what is in memory is drawn, and it is used again once it is back.
podman kill -s KILL "${project}_redis_1" >/dev/null
draw "$url" "$id" '{"exposure":0.6}' "$work/without.png" || fail "without Redis, a scene in memory is not drawn"
podman start "${project}_redis_1" >/dev/null
isListed() { ask "$url/v1/scenes" 2>/dev/null | grep -q "$id"; }
waitFor 60 isListed || fail "Redis is back, and its scenes are not listed"
say "Redis was killed and came back: a frame meanwhile, and the scene after it"

# All of it stops and comes again, with its scenes.
removeContainers() { podman ps -aq --filter "label=com.docker.compose.project=$project" | xargs -r podman rm -f -t 20 >/dev/null; }
removeContainers
compose up -d || { tail -40 "$work/compose.log" >&2; fail "compose.yaml does not come up again"; }
url=http://$(podman port "${project}_haproxy_1" 8080/tcp)
waitFor 60 hasReplicas "$url" 2 || fail "HAProxy does not see two replicas again"
waitFor 60 draw "$url" "$id" '{}' "$work/again.png" 2>/dev/null || fail "the scene is not there again"
cmp "$work/compose.png" "$work/again.png" || fail "another picture of the same scene"
say "after a restart of everything the scene is there, and its picture the same"
removeProject >/dev/null 2>&1

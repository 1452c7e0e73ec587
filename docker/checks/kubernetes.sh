# shellcheck shell=bash
# Sourced by docker/check: docker/kubernetes as an operator builds it, held to rules and schemas, and what podman can play of
# it played: servers, Redis and HAProxy.

: "${image:?}" "${work:?}"

needPackages python3-yaml
. docker/checks/kustomize.sh
ensureKustomize
build_overlay() { "${kustomize[@]}" --load-restrictor LoadRestrictionsNone "$tree/kubernetes/overlays/$1"; }

tree=$work/docker
cp -r docker "$tree"
rm -f "$tree"/kubernetes/base/keys "$tree"/kubernetes/redis/password
if build_overlay replicas >/dev/null 2>"$work/refusal"; then
  fail "it is built without keys and a password"
fi
grep -q 'keys: no such file' "$work/refusal" || fail "it does not say that keys are missing: $(cat "$work/refusal")"
secret=$(openssl rand -hex 32)
echo "name=check sha256=$(printf %s "$secret" | sha256sum | cut -d' ' -f1) scopes=read,render,upload" >"$tree/kubernetes/base/keys"
openssl rand -hex 32 >"$tree/kubernetes/redis/password"
built=()
for overlay in "$tree"/kubernetes/overlays/*/; do
  overlay=$(basename "$overlay")
  build_overlay "$overlay" >"$work/$overlay.yaml"
  built+=("$work/$overlay.yaml")
done
/usr/bin/python3 -B docker/checks/manifests.py "${built[@]}" || fail "the manifests break rules"
say "built ${#built[@]} overlays, which keep the rules of docker/checks/manifests.py"

if command -v npm >/dev/null; then
  install -d "$work/schemas"
  docker/checks/schemas/check "$work/schemas" "${built[@]}" || fail "the manifests break published schemas"
  say "and published schemas"
else
  say "skipped: published schemas (apt-get install npm)"
fi

network=gnomon-check-$$
podman network create "$network" >/dev/null
endings+=("podman network rm -f $network")

# usage: play OVERLAY      what podman can; each service has its name in the network
play() {
  local file alias
  install -d "$work/play"
  /usr/bin/python3 -B docker/checks/for_podman.py "$work/$1.yaml" "$work/play" gnomon="$image" \
    redis=localhost/gnomon-redis:check haproxy=localhost/gnomon-haproxy:check
  for file in "$work"/play/*.yaml; do
    alias=$(basename "$file" .yaml)
    [ "$alias" != gnomon ] || alias=gnomon-replicas
    podman kube play --network "$network:alias=$alias" "$file" >"$work/play.log" 2>&1 ||
      { cat "$work/play.log" >&2; fail "podman does not play $alias of the overlay $1"; }
  done
}
stopPlaying() {
  podman pod ls -q --filter "network=$network" | xargs -r podman pod rm -f -t 0
  podman volume ls -q --filter 'name=^gnomon' | xargs -r podman volume rm
  rm -rf "$work/play"
} >/dev/null 2>&1
endings+=(stopPlaying)

# usage: addressOf POD PORT
addressOf() {
  local infra
  infra=$(podman pod inspect "$1" --format '{{.InfraContainerID}}')
  echo "http://$(podman inspect "$infra" --format "{{(index .NetworkSettings.Networks \"$network\").IPAddress}}"):$2"
}
# usage: isSealed CONTAINER      a server without privileges, whose workers have a filter of their own as well
isSealed() {
  local server worker
  server=$(podman inspect "$1" --format '{{.State.Pid}}')
  worker=$(pgrep -P "$server" | head -1)
  grep -q '^CapEff:	0*$' "/proc/$server/status" && grep -q '^Seccomp:	2' "/proc/$server/status" &&
    grep -q '^Seccomp_filters:	2' "/proc/$worker/status"
}

buildServices redis haproxy
# shellcheck disable=SC2034 # asking.sh sends it
key=(-H "Authorization: Bearer $secret")

play single
url=$(addressOf gnomon-pod-0 8080)
waitFor 60 isReady "$url" || { podman logs gnomon-pod-0-gnomon >&2; fail "the single server does not become ready"; }
isSealed gnomon-pod-0-gnomon || fail "the server or its workers have more rights than they should"
id=$(upload "$url" "$(demoOf gnomon-pod-0-gnomon)")
draw "$url" "$id" '{}' "$work/single.png"
isPicture "$work/single.png"
if curl -fsS -o /dev/null "$url/v1/scenes" 2>/dev/null; then fail "it asks nobody for a key"; fi
stopPlaying
say "podman plays the overlay single: sealed, with keys, and it draws"

play replicas
url=$(addressOf gnomon-haproxy-pod-0 8080)
waitFor 60 hasReplicas "$url" 2 || { podman logs gnomon-pod-0-gnomon >&2; fail "HAProxy does not see two replicas"; }
for _ in 1 2 3 4; do
  waitFor 60 hasStore "$url" || fail "the replicas do not reach Redis"
done
id=$(upload "$url" "$work/demo.glb")
draw "$url" "$id" '{}' "$work/replicas.png"
cmp "$work/single.png" "$work/replicas.png" || fail "replicas draw another picture"
drawMany "$url" "$id" 60 >"$work/load" &
load=$!
waitFor 60 test -s "$work/load"
podman kill -s KILL "$(drewMost gnomon-pod-0-gnomon gnomon-pod-1-gnomon)" >/dev/null
wait "$load"
[ "$(grep -c '^200 ' "$work/load")" = 60 ] || { sort "$work/load" | uniq -c >&2; fail "frames failed as a replica was killed"; }
draw "$url" "$id" '{"exposure":0.75}' "$work/after.png"
say "and replicas: Redis with its password, HAProxy, two servers, one of them killed among 60 frames"
stopPlaying

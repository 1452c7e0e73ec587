# shellcheck shell=bash
# Sourced by docker/check: kustomize of version 5, of the kubectl that is there, or from Debian 13, whose program runs on 12.

: "${work:?}"

# usage: ensureKustomize      sets `kustomize` to a command that builds a folder
ensureKustomize() {
  kustomize=(kubectl kustomize)
  kubectl version --client 2>/dev/null | grep -q '^Kustomize Version: v[5-9]' && return
  local folder=$work/trixie options
  # shellcheck disable=SC2034 # kubernetes.sh calls it
  kustomize=("$folder/usr/bin/kustomize" build)
  install -d "$folder/lists/partial" "$folder/cache/archives/partial"
  sed 's/bookworm/trixie/g' /etc/apt/sources.list.d/debian.sources >"$folder/trixie.sources"
  options=(-qq -o Dir::Etc::sourcelist="$folder/trixie.sources" -o Dir::Etc::sourceparts=- -o APT::Sandbox::User=root
    -o Dir::State::lists="$folder/lists" -o Dir::Cache="$folder/cache")
  apt-get "${options[@]}" update
  (cd "$folder" && apt-get "${options[@]}" download kustomize)
  dpkg -x "$folder"/kustomize_*.deb "$folder"
}

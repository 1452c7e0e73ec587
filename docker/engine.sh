# shellcheck shell=bash
# Sourced by docker/check: podman from Debian's packages, ready on a machine with no container engine and no systemd.
# Offers needPackages, ensureTools, which sets CONTAINERS_CONF, and ensureBase. These write below $work, a folder of the caller's.

: "${work:?}"
engine_packages=(podman runc netavark aardvark-dns catatonit iptables debootstrap curl openssl python3)
base_image=localhost/debian:bookworm-slim

# usage: needPackages PACKAGE...      installs those that are missing
needPackages() {
  local missing=() package
  for package in "$@"; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  apt-get update -qq
  DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

ensureTools() {
  needPackages "${engine_packages[@]}"
  # runc: Debian 12's crun refuses hybrid cgroups. ulimits: a root without CAP_SYS_RESOURCE can't raise its own.
  # netavark: without it podman falls back to CNI, whose plugins are not installed.
  cat >"$work/containers.conf" <<'CONF'
[engine]
runtime = "runc"
cgroup_manager = "cgroupfs"
events_logger = "file"
[containers]
default_ulimits = ["nofile=4096:4096", "nproc=4096:4096"]
log_driver = "k8s-file"
[network]
network_backend = "netavark"
CONF
  # No systemd here, so no timer could run a HEALTHCHECK; `podman healthcheck run` is asked instead.
  export CONTAINERS_CONF=$work/containers.conf DISABLE_HC_SYSTEMD=true
}

# debian:bookworm-slim by its short name, so that the Dockerfile stays stock. Made from the machine's own package
# sources, which are read here and stand in no file of the project.
ensureBase() {
  podman image exists "$base_image" && return
  local sources=/etc/apt/sources.list.d/debian.sources root=$work/rootfs mirror
  [ -r "$sources" ] || { echo "docker/check: $sources is not there: can't make the base image" >&2; return 1; }
  mirror=$(awk '/^URIs:/ {print $2; exit}' "$sources")
  debootstrap --variant=minbase bookworm "$root" "$mirror" >"$work/debootstrap.log" || {
    tail -5 "$work/debootstrap.log" >&2
    return 1
  }
  rm -f "$root/etc/apt/sources.list"
  cp "$sources" "$root/etc/apt/sources.list.d/"
  printf '%s\n' 'path-exclude /usr/share/doc/*' 'path-include /usr/share/doc/*/copyright' \
    'path-exclude /usr/share/man/*' 'path-exclude /usr/share/info/*' 'path-exclude /usr/share/locale/*' \
    >"$root/etc/dpkg/dpkg.cfg.d/docker"
  # As in the stock image: downloaded .debs don't stay in the layers.
  cat >"$root/etc/apt/apt.conf.d/docker-clean" <<'CONF'
DPkg::Post-Invoke { "rm -f /var/cache/apt/archives/*.deb /var/cache/apt/archives/partial/*.deb /var/cache/apt/*.bin || true"; };
Dir::Cache::pkgcache ""; Dir::Cache::srcpkgcache "";
Acquire::Languages "none"; Acquire::GzipIndexes "true";
CONF
  (
    cd "$root" || exit
    rm -rf var/cache/apt/* var/lib/apt/lists/* var/log/*.log var/log/apt usr/share/{man,info,locale}/* \
      etc/resolv.conf etc/hostname
    find usr/share/doc -mindepth 1 ! -name copyright ! -type d -delete
  )
  tar -C "$root" --numeric-owner --sort=name -c . | podman import -q --change 'CMD ["bash"]' \
    --change 'ENV PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin' - "$base_image" >/dev/null
  rm -rf "$root"
}

#!/usr/bin/env bash
# Builds the packages of this machine's Debian, and from them the images with podman or docker, and tests these as
# docs/operations.md describes. Their base is made of Debian packages, so that no registry is needed.
#
# Usage: containers.sh      as root; the programs must have been built in build/release
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source ./packages.sh

SUITE=$(. /etc/os-release && echo "$VERSION_CODENAME")
export SUITE
base=localhost/albtpu-test-base-$SUITE
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

skip() {
  echo "skipped: containers: $*"
  exit 0
}

# Without systemd, podman needs lower limits, and another cgroup manager and runtime.
fit_podman() {
  [[ ! -d /run/systemd/system ]] || return 0
  cat >"$scratch/containers.conf" <<'EOF'
[containers]
default_ulimits = ["nofile=4096:4096", "nproc=4096:4096"]
[engine]
cgroup_manager = "cgroupfs"
runtime = "runc"
EOF
  export CONTAINERS_CONF=$scratch/containers.conf
}

install_packages containers
engine=$(command -v podman || command -v docker) || skip "podman or docker is missing; apt-get install podman"
[[ $engine != */podman ]] || fit_podman
reason=$("$engine" info 2>&1 >/dev/null) || skip "$engine does not work here: ${reason##*$'\n'}"

if ! "$engine" image inspect "$base" >/dev/null 2>&1; then
  echo "== Making a base image from Debian packages"
  mmdebstrap --quiet --variant=minbase "$SUITE" "$scratch/base.tar"
  "$engine" import "$scratch/base.tar" "$base" >/dev/null
fi
reason=$("$engine" run --rm "$base" true 2>&1) || skip "$engine cannot run containers here: ${reason##*$'\n'}"

./package.sh --here
export ALBTPU_TAG=test  # Leaves other images of this machine alone.
echo "== Building the images"
ENGINE=$engine docker/build.sh --build-arg "BASE=$base" >"$scratch/build.log" 2>&1 || {
  tail -n 50 "$scratch/build.log"
  echo "failed: containers: the images could not be built" >&2
  exit 1
}
echo "== Running the images"
export PYTHONPATH=clients/python/src
status=0
/usr/bin/python3 -B tests/e2e/containers_test.py "$engine" build/release . || status=1
/usr/bin/python3 -B tests/e2e/orchestration_test.py "$engine" "$base" . || status=1
exit "$status"

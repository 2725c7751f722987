#!/usr/bin/env bash
# Builds the three images with podman or docker, or what ENGINE names: albtpu-serve, albtpu-query and albtpu-generate,
# tagged with the version and `latest`, or with ALBTPU_TAG alone.
#
# Usage: build.sh [flags of the engine's build, such as --build-arg BASE=localhost/debian]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

engine=$(command -v "${ENGINE:-podman}" || command -v "${ENGINE:-docker}") || {
  echo "$0: no ${ENGINE:-podman and no docker}: apt-get install podman is right" >&2
  exit 1
}
export DOCKER_BUILDKIT=1  # Debian's docker would build without, and know no --mount.
version=$(sed -n 's/^project(albtpu VERSION \([0-9.]*\) .*/\1/p' CMakeLists.txt)
commit=$(git describe --always --dirty --abbrev=12 2>/dev/null || echo unknown)
build=("$engine" build --file docker/Dockerfile --build-arg "VERSION=$version" --build-arg "COMMIT=$commit")
# Podman's own format has no place for HEALTHCHECK.
[[ $engine != */podman ]] || build+=(--format docker)

for image in service:albtpu-serve query:albtpu-query generator:albtpu-generate; do
  name=${image#*:}
  tags=(--tag "$name:${ALBTPU_TAG:-$version}")
  [[ -n ${ALBTPU_TAG-} ]] || tags+=(--tag "$name:latest")
  echo "== $name $version ($commit)"
  "${build[@]}" --target "${image%:*}" "${tags[@]}" "$@" .
done

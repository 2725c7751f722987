#!/usr/bin/env bash
# Builds the images albtpu-serve, albtpu-query and albtpu-generate with podman or docker, or with the program that
# ENGINE names, from the packages of Debian 13, or of the one that SUITE names. Tags them with the version and `latest`,
# or only with ALBTPU_TAG if that is set.
#
# Usage: build.sh [flags of the engine's build command, such as --build-arg BASE=localhost/debian]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

engine=$(command -v "${ENGINE:-podman}" || command -v "${ENGINE:-docker}") || {
  echo "$0: ${ENGINE:-podman or docker} is missing; apt-get install podman" >&2
  exit 1
}
export DOCKER_BUILDKIT=1  # Without it, Debian's docker uses its old builder, which does not support RUN --mount.
suite=${SUITE:-trixie}
compgen -G "build/packages/$suite/albtpu-generate_*.deb" >/dev/null || {
  echo "$0: build/packages/$suite has no packages; ./package.sh $suite makes them" >&2
  exit 1
}
version=$(sed -n 's/^set(ALBTPU_VERSION \(.*\))$/\1/p' CMakeLists.txt)
commit=$(git describe --always --dirty --abbrev=12 2>/dev/null || echo unknown)
build=("$engine" build --file docker/Dockerfile --build-arg "VERSION=$version" --build-arg "COMMIT=$commit"
  --build-arg "SUITE=$suite")
# Podman's default image format does not support HEALTHCHECK.
[[ $engine != */podman ]] || build+=(--format docker)

for image in service:albtpu-serve query:albtpu-query generator:albtpu-generate; do
  name=${image#*:}
  tags=(--tag "$name:${ALBTPU_TAG:-$version}")
  [[ -n ${ALBTPU_TAG-} ]] || tags+=(--tag "$name:latest")
  echo "== $name $version ($commit)"
  "${build[@]}" --target "${image%:*}" "${tags[@]}" "$@" .
done

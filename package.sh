#!/usr/bin/env bash
# Makes the Debian packages albtpu, albtpu-generate, libalbtpu-dev and python3-albtpu in build/packages/SUITE, and
# checks them by lintian. docs/install.md installs them.
#
# Usage: package.sh [--here | --portable | SUITE...]
#   SUITE...   each in a bare root of that Debian, made by mmdebstrap and removed at the end (default: bookworm trixie);
#              as root
#   --here     for the Debian on which it runs, without a root; installs the packages that the build needs
#   --portable an archive and a wheel for any Linux instead, in build/packages/portable
set -euo pipefail
umask 022  # Of the files of packages, whatever that of the user is.
cd "$(dirname "${BASH_SOURCE[0]}")"
source ./packages.sh
# Of the changelogs and all files. A root knows them only from here: it need not see the repository.
git=(git -c "safe.directory=$PWD")  # Of a user's folder that root works in.
export ALBTPU_COMMIT=${ALBTPU_COMMIT:-$("${git[@]}" describe --always --dirty --abbrev=12 2>/dev/null || echo unknown)}
export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$("${git[@]}" log -1 --format=%ct 2>/dev/null || date +%s)}

build_here() {
  local suite
  suite=$(. /etc/os-release && echo "$VERSION_CODENAME")
  install_packages packages
  cmake --preset release -B "build/$suite" -DCMAKE_INSTALL_PREFIX=/usr -DALBTPU_BUILD_TESTS=OFF \
    -DCMAKE_EXE_LINKER_FLAGS="-Wl,-z,relro,-z,now" -DALBTPU_COMMIT="$ALBTPU_COMMIT" \
    -DALBTPU_DEBIAN_PACKAGES="$(date -uR --date="@$SOURCE_DATE_EPOCH")"
  cmake --build "build/$suite" -j "$(nproc)"
  rm -rf "build/packages/$suite"
  (cd "build/$suite" && cpack -B "$OLDPWD/build/packages/$suite")
  rm -rf "build/packages/$suite/_CPack_Packages"
  lintian --fail-on error "build/packages/$suite/"*.deb
}

# Runs the same in a root of $1, in which this folder has the same path as outside. The mounts end with the command.
build_in_root() {
  local include
  include=$(package_names packages | paste -sd,)
  export here=$PWD cache=${CCACHE_DIR:-$HOME/.cache/ccache}
  mkdir -p build "$cache"
  # shellcheck disable=SC2016  # The variables are those of the shells that run it.
  mmdebstrap --variant=minbase --include="$include" --customize-hook='
    mkdir -p "$1$here" "$1/ccache"
    exec unshare --mount sh -ec '\''
      mount --bind "$here" "$1$here"
      mount --bind "$cache" "$1/ccache"
      HOME=/root CCACHE_DIR=/ccache exec chroot "$1" sh -c "cd \"\$here\" && ./package.sh --here"
    '\'' sh "$1"' "$1" /dev/null
}

if [[ $# == 1 && $1 == --here ]]; then
  build_here
  exit
fi
[[ $* != *-* || $* == --portable ]] || { sed -n 's/^# \?//; 2,9p' "$0" >&2; exit 2; }
((EUID == 0)) || { echo "$0: only root can make roots of Debian; use --here, or sudo" >&2; exit 1; }
command -v mmdebstrap >/dev/null || { echo "$0: mmdebstrap is missing; apt-get install mmdebstrap" >&2; exit 1; }
[[ $* != --portable ]] || exec packaging/portable.sh
[[ $# != 0 ]] || set -- bookworm trixie
for suite in "$@"; do
  echo "== Building the packages of $suite"
  build_in_root "$suite"
done
ls -l build/packages/*/*.deb

#!/usr/bin/env bash
# Makes, in build/packages/portable, an archive of the programs with the libraries that they need, for any Linux on
# x86-64 whose C library is at least as new as that of Debian 12, and a wheel of the same programs and the Python
# package. Compiles in a root of Debian 12, which mmdebstrap makes, as root, and which is removed at the end.
#
# Usage: portable.sh [--here]
#   --here   compile on this machine, which must be a Debian 12
set -euo pipefail
umask 022  # All may read the root and what is made in it, whatever the umask of the user is.
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source ./packages.sh

target=build/packages/portable
build=build/portable
git=(git -c "safe.directory=$PWD")  # Of a user's folder that root works in.
ALBTPU_COMMIT=${ALBTPU_COMMIT:-$("${git[@]}" describe --always --dirty --abbrev=12 2>/dev/null || echo unknown)}
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$("${git[@]}" log -1 --format=%ct 2>/dev/null || date +%s)}
export SOURCE_DATE_EPOCH  # Of all files in the archive and in the wheel.

compile_here() {
  install_packages portable
  rm -rf "$build/installed"
  # Ranks of MPI need the Open MPI of the machine that they run on, and GDAL has a hundred libraries.
  cmake --preset release -B "$build" -DALBTPU_BUILD_TESTS=OFF -DALBTPU_MPI=OFF -DALBTPU_GDAL=OFF \
    -DALBTPU_COMMIT="$ALBTPU_COMMIT" >"$build.log"
  cmake --build "$build" -j "$(nproc)"
  cmake --install "$build" --prefix "$build/installed" --strip >>"$build.log"
  local version
  version=$(sed -n 's/^set(ALBTPU_VERSION \(.*\))$/\1/p' CMakeLists.txt)
  mkdir -p "$target"
  rm -f "$target"/albtpu-*
  /usr/bin/python3 -B packaging/portable.py "$build/installed" "$target" "$version"
}

# Runs a command in `root`, in this folder and with the cache of ccache. The mounts end with the command.
in_root() {
  local root=$1 cache=${CCACHE_DIR:-$HOME/.cache/ccache}
  shift
  mkdir -p "$cache" "$root$PWD" "$root/ccache"
  cp /etc/resolv.conf "$root/etc/resolv.conf"
  unshare --mount bash -euc '
    root=$1 folder=$2 cache=$3
    shift 3
    mount --bind "$folder" "$root$folder"
    mount --bind "$cache" "$root/ccache"
    mount -t proc proc "$root/proc"
    exec chroot "$root" env -C "$folder" "$@"' \
    bash "$root" "$PWD" "$cache" -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 CCACHE_DIR=/ccache \
    CCACHE_BASEDIR="$PWD" CCACHE_NOHASHDIR=1 SOURCE_DATE_EPOCH="$SOURCE_DATE_EPOCH" \
    ${XZ_OPT+XZ_OPT="$XZ_OPT"} ALBTPU_COMMIT="$ALBTPU_COMMIT" "$@"
}

if [[ $# == 1 && $1 == --here ]]; then
  compile_here
  exit
elif [[ $# != 0 ]]; then
  echo "$0: unknown argument '$1'; the flag is --here" >&2
  exit 2
fi
root=$(mktemp --directory --tmpdir albtpu-root.XXXXXX)
trap 'rm -rf "$root"' EXIT
chmod 755 "$root"
echo "== Making a root of Debian 12"
mmdebstrap --quiet --variant=minbase bookworm "$root"
in_root "$root" packaging/portable.sh --here
ls -l "$target"

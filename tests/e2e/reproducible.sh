#!/usr/bin/env bash
# Builds the Debian packages, the archive and the wheel of the commit twice, in two folders and without the cache of the
# compiler, and compares their bytes. Takes as long as two builds.
#
# Usage: reproducible.sh      on Debian; the archive and the wheel only on Debian 12
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

folder=$(mktemp --directory --tmpdir albtpu-reproducible.XXXXXX)
trap 'rm -rf "$folder"' EXIT
git=(git -c "safe.directory=$PWD")  # Of a user's folder that root works in.
ALBTPU_COMMIT=$("${git[@]}" describe --always --abbrev=12)
SOURCE_DATE_EPOCH=$("${git[@]}" log -1 --format=%ct)
export ALBTPU_COMMIT SOURCE_DATE_EPOCH CCACHE_DISABLE=1

build() {  # FOLDER UMASK
  mkdir -p "$1"
  "${git[@]}" archive HEAD | tar -C "$1" --extract
  (
    umask "$2"
    cd "$1"
    ./package.sh --here
    ! grep -q '^VERSION_ID="12"$' /etc/os-release || packaging/portable.sh --here
    rm -rf build/bookworm build/trixie build/portable
  )
}
build "$folder/first" 022
build "$folder/the/second/place" 027

status=0
cd "$folder/first/build/packages"
while IFS= read -r file; do
  if cmp "$file" "$folder/the/second/place/build/packages/$file"; then
    sha256sum "$file"
  else
    echo "differs: $file (diffoscope shows where)"
    status=1
  fi
done < <(find . -type f | sort)
exit "$status"

#!/usr/bin/env bash
# Makes the archive and the wheel (package.sh --portable) and tests them on bare Debian 12 and 13, as root.
#
# Usage: portable.sh      build/release must have been built
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

if ((EUID != 0)) || ! command -v mmdebstrap >/dev/null; then
  echo "skipped: portable: needs root and mmdebstrap; apt-get install mmdebstrap"
  exit 0
fi
./package.sh --portable
export PYTHONPATH=clients/python/src
roots=$(mktemp --directory --tmpdir albtpu-roots.XXXXXX)
trap 'rm -rf "$roots"' EXIT
/usr/bin/python3 -B tests/e2e/portable_test.py build/packages/portable/albtpu-*.tar.xz \
  build/packages/portable/albtpu-*.whl build/release/tests/flights/albtpu_simulated_survey "$roots"

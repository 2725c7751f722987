#!/usr/bin/env bash
# Installs what is missing, builds everything, runs every test, says what was skipped and why, and ends with
# CTest's summary.
#
# Usage: test.sh [--aarch64]    with the kernels' tests on that architecture, emulated
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
source ./packages.sh

if (($# > 1)) || [[ ${1---aarch64} != --aarch64 ]]; then
  echo "$0: '$*' is not --aarch64, its only flag" >&2
  exit 2
fi

install_packages tests

echo "== Building"
cmake --preset release >/dev/null
cmake --build --preset release -j "$(nproc)"

echo "== Testing"
log=build/release/test.log
results=build/release/test.xml
status=0
ctest --preset release --parallel 2 --output-junit "$PWD/$results" --test-output-size-passed 1000000 \
  | tee "$log" | sed -u '/% tests passed/,$d' || status=$?

if (($# == 1)) && ! tests/generator/aarch64.sh; then
  echo "failed: aarch64"
  status=1
fi

python3 tests/skipped.py "$results"
(($# == 1)) || echo "skipped: aarch64: the kernels are tested there by --aarch64"
sed -n '/% tests passed/,$p' "$log"
exit "$status"

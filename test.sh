#!/usr/bin/env bash
# Installs what is missing, builds everything, runs every test, says what was skipped and why, and ends with
# CTest's summary.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
source ./packages.sh

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

python3 tests/skipped.py "$results"
sed -n '/% tests passed/,$p' "$log"
exit "$status"

#!/usr/bin/env bash
# Installs what is missing, builds everything, runs every test, says what was skipped and why, and ends with
# CTest's summary.
#
# Usage: test.sh [--aarch64] [--containers] [--fuzz] [--sanitizers] [--soak]
#   --aarch64      also the kernels' tests on that architecture, emulated
#   --containers   also the images, by podman or docker, and the jobs of Slurm and Kubernetes
#   --fuzz         also every fuzz target for a minute (installs clang, 400 MB); tests/fuzz/run.sh for longer
#   --sanitizers   also the tests under AddressSanitizer with UndefinedBehaviorSanitizer, and under ThreadSanitizer
#   --soak         also half an hour of everything at once against one server
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
source ./packages.sh

declare -A further=(
  [aarch64]=tests/generator/aarch64.sh [containers]=tests/e2e/containers.sh [fuzz]="tests/fuzz/run.sh 60"
  [sanitizers]=tests/sanitizers/run.sh [soak]=tests/faults/soak.sh)
asked=()
for flag in "$@"; do
  if [[ $flag != --?* || -z ${further[${flag#--}]-} ]]; then
    echo "$0: '$flag' is none of its flags: ${!further[*]}" >&2
    exit 2
  fi
  asked+=("${flag#--}")
done

for section in tests "${asked[@]}"; do install_packages "$section"; done

# Unpacked alone: installed, its package starts a server.
tools=build/promtool
if ! command -v promtool >/dev/null && [[ ! -x $tools/usr/bin/promtool ]]; then
  mkdir -p "$tools"
  (cd "$tools" && apt-get -qq download prometheus && dpkg-deb -x prometheus_*.deb .) 2>/dev/null || true
fi
PATH+=:$PWD/$tools/usr/bin

echo "== Building"
cmake --preset release >/dev/null
cmake --build --preset release -j "$(nproc)"

echo "== Testing"
log=build/release/test.log
results=build/release/test.xml
status=0
ctest --preset release --parallel 2 --output-junit "$PWD/$results" --test-output-size-passed 1000000 \
  | tee "$log" | sed -u '/% tests passed/,$d' || status=$?

for name in "${asked[@]}"; do
  if ! ${further[$name]} 2>&1 | tee "build/release/$name.log"; then
    echo "failed: $name"
    status=1
  fi
done

python3 tests/skipped.py "$results"
for name in "${!further[@]}"; do
  if [[ " ${asked[*]} " != *" $name "* ]]; then
    echo "skipped: $name: tested by --$name"
  else
    sed -nE "/^skipped: /p; s/.* \.\.\. skipped ['\"](.+)['\"]\$/skipped: $name: \1/p" "build/release/$name.log" | uniq
  fi
done
sed -n '/% tests passed/,$p' "$log"
exit "$status"

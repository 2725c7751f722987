#!/usr/bin/env bash
# Installs missing packages, builds everything and runs every test. The closing lines name what was not built and which
# tests were skipped, and why; CTest's summary comes last.
#
# Usage: test.sh [--aarch64] [--bench] [--containers] [--fuzz] [--packages] [--portable] [--reproducible]
#                [--sanitizers] [--soak]
#   --aarch64      also run the kernels' tests on that architecture, emulated
#   --bench        also run each benchmark once and briefly; they are built in any case
#   --containers   also test the images with podman or docker, and the Slurm and Kubernetes jobs
#   --fuzz         also run every fuzz target for one minute (installs clang, 400 MB); tests/fuzz/run.sh runs longer
#   --packages     also make the Debian packages of both Debians, in bare roots, and install them in such roots
#   --portable     also make the archive and the wheel for any Linux, and test them on bare Debian 12 and 13, as root
#   --reproducible also make packages, archive and wheel of the commit twice and compare their bytes; takes an hour
#   --sanitizers   also run the tests under AddressSanitizer with UndefinedBehaviorSanitizer, and under ThreadSanitizer
#   --soak         also run half an hour of mixed load and faults against one server
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
source ./packages.sh

declare -A optional_runs=(
  [aarch64]=tests/generator/aarch64.sh [bench]="ctest --preset release --label-regex ^bench$"
  [containers]=tests/e2e/containers.sh [fuzz]="tests/fuzz/run.sh 60" [packages]=tests/e2e/packages.sh
  [portable]=tests/e2e/portable.sh [reproducible]=tests/e2e/reproducible.sh
  [sanitizers]=tests/sanitizers/run.sh [soak]=tests/faults/soak.sh)
requested=()
for flag in "$@"; do
  if [[ $flag != --?* || -z ${optional_runs[${flag#--}]-} ]]; then
    names=("${!optional_runs[@]}")
    echo "$0: unknown argument '$flag'; the flags are ${names[*]/#/--}" >&2
    exit 2
  fi
  requested+=("${flag#--}")
done

for section in tests "${requested[@]}"; do install_packages "$section"; done

# promtool is unpacked without installing its package, because the package would start a Prometheus server.
tools=build/promtool
if ! command -v promtool >/dev/null && [[ ! -x $tools/usr/bin/promtool ]]; then
  mkdir -p "$tools"
  (cd "$tools" && apt-get -qq download prometheus && dpkg-deb -x prometheus_*.deb .) 2>/dev/null || true
fi
PATH+=:$PWD/$tools/usr/bin

echo "== Building"
cmake --preset release >/dev/null
cmake --build --preset release -j "$(nproc)" --target all benchmarks

echo "== Testing"
log=build/release/test.log
results=build/release/test.xml
status=0
# Many tests wait for servers and clients more than they compute.
ctest --preset release --label-exclude "^bench$" --parallel $((2 * $(nproc) + 1)) --output-junit "$PWD/$results" \
  --test-output-size-passed 1000000 | tee "$log" | sed -u '/% tests passed/,$d' || status=$?

for name in "${requested[@]}"; do
  if ! ${optional_runs[$name]} 2>&1 | tee "build/release/$name.log"; then
    echo "failed: $name"
    status=1
  fi
done

cat build/release/not_built.txt
python3 tests/skipped.py "$results"
for name in "${!optional_runs[@]}"; do
  if [[ " ${requested[*]} " != *" $name "* ]]; then
    echo "skipped: $name: --$name runs it"
  else
    sed -nE "/^skipped: /p; s/.* \.\.\. skipped ['\"](.+)['\"]\$/skipped: $name: \1/p" "build/release/$name.log" | uniq
  fi
done
sed -n '/% tests passed/,$p' "$log"
exit "$status"

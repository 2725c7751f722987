#!/usr/bin/env bash
# Runs all tests except the validations under AddressSanitizer with UndefinedBehaviorSanitizer, and under
# ThreadSanitizer. The validations repeat the generator's code for minutes, here for hours. Prints how many tests ran
# under each, and all findings: also of programs that a test killed or whose exit code it did not check.
#
# Usage: run.sh [PRESET [CTEST OPTION...]]    PRESET is asan or tsan; for example run.sh tsan -R '^serve_test$'
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

# ThreadSanitizer of g++ 12 supports at most 28 bits of address space randomization.
if (($(</proc/sys/vm/mmap_rnd_bits) > 28)) && [[ -z ${ALBTPU_FIXED_ADDRESSES-} ]]; then
  ALBTPU_FIXED_ADDRESSES=yes exec setarch --addr-no-randomize "$0" "$@"
fi

presets=(tsan asan)  # the longer first
if (($# > 0)); then
  presets=("$1")
  shift
fi
status=0
summary=()
for preset in "${presets[@]}"; do
  cmake --preset "$preset" >/dev/null
  cmake --build --preset "$preset" -j "$(nproc)" --target all benchmarks
  findings=$PWD/build/$preset/findings
  rm -rf "$findings"
  mkdir "$findings"
  ALBTPU_FINDINGS=log_path=$findings/report ctest --preset "$preset" --parallel 2 "$@" |
    tee "build/$preset/test.log" || status=1
  # HDF5 is refused what a damaged table makes it ask for (tests/fuzz/fuzz_target.cc): a warning, which is no finding.
  reports=$(grep -rlv "WARNING: .*Sanitizer failed to allocate" "$findings" | wc -l || true)
  if ((reports > 0)); then
    status=1
    cat "$findings"/*
  fi
  tests=$(sed -n 's/.* tests passed, .* out of //p' "build/$preset/test.log")
  summary+=("$preset: $tests tests, $reports programs with findings")
done
printf '%s\n' "${summary[@]}"
exit "$status"

#!/usr/bin/env bash
# Fuzzes the targets, as many at a time as there are cores, and prints how many inputs each was given.
#
# Usage: run.sh [--at-least RUNS] SECONDS [TARGET...]
#   SECONDS for each target, and longer until it was given RUNS inputs; all targets unless some are given
#
# Inputs that reached new code are kept in build/fuzz/corpus for the next run. An input on which a target fails is left
# beside them; when the fault is fixed, add the input to tests/fuzz/found/TARGET, so that every test run tries it again.
# tests/fuzz/reached/TARGET has the few inputs that get further than the seeds, by three branches or more each.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

at_least=0
if [[ ${1-} == --at-least && ${2-} =~ ^[0-9]+$ ]]; then
  at_least=$2
  shift 2
fi
if (($# < 1)) || [[ ! $1 =~ ^[0-9]+$ ]]; then
  echo "$0: '${1-}' is not a number of seconds; usage: run.sh [--at-least RUNS] SECONDS [TARGET...]" >&2
  exit 2
fi
seconds=$1
shift
targets=("$@")

# The longest input of each target, in bytes: enough for its format and no more, because short inputs run faster.
declare -A longest=([ascii_trajectory]=1500 [budget]=2400 [campaign]=2048 [clocks]=48 [columns]=2400 [csv]=300
                    [csv_file]=300 [las]=1500 [las_head]=1500 [laz_chunk]=600 [laz_file]=1500 [laz_records]=620
                    [ndbc_bulk]=400 [ndbc_spectra]=700 [sbet]=1088 [sea_csv]=300 [sea_gzip]=200 [sea_state]=4000
                    [sea_text]=700 [seal]=600 [sensor_file]=500 [smrmsg]=640 [span_index]=300 [specification]=500
                    [survey_description]=900 [swan_spectra]=400 [table]=131072 [table_values]=600 [water_level]=500
                    [water_values]=600 [ww3_points]=600)
# The longest inputs take the longest: those targets run first, so that no core waits for one at the end.
(($# > 0)) || mapfile -t targets < <(
  for target in "${!longest[@]}"; do echo "${longest[$target]} $target"; done | sort -k1,1nr -k2 | cut -d ' ' -f 2)
for target in "${targets[@]}"; do
  if [[ -z ${longest[$target]-} ]]; then
    echo "$0: '$target' is not a target; choose from ${!longest[*]}" >&2
    exit 2
  fi
done
if ! command -v clang++ >/dev/null; then
  echo "$0: clang++ is missing; apt-get install clang libclang-rt-dev" >&2
  exit 2
fi

cmake --preset fuzz >/dev/null
cmake --build --preset fuzz -j "$(nproc)" --target albtpu_fuzz_seeds "${targets[@]/%/_fuzz}" >build/fuzz/build.log ||
  { tail -n 50 build/fuzz/build.log >&2; exit 1; }
folder=build/fuzz/tests/fuzz
"$folder/albtpu_fuzz_seeds" tests/fuzz/seeds build/fuzz/seeds

# Leaks are searched once, when a target ends: libraries keep memory from input to input (HDF5 its free lists, gRPC
# its slices), which looks like a leak after one input and would make libFuzzer search all memory each time. Short
# call stacks of allocations and a small quarantine take a tenth less time and an eighth of the memory; run a failing
# input again without these options for a full report. The time limit is generous, because on a busy machine a target
# may wait.
export ASAN_OPTIONS=malloc_context_size=2:quarantine_size_mb=8
export UBSAN_OPTIONS=print_stacktrace=1
export LSAN_OPTIONS=suppressions=tests/sanitizers/lsan.supp:print_suppressions=0
[[ ! -w /dev/shm ]] || export TMPDIR=/dev/shm  # Keeps the files of targets in memory.

# run_fuzzer TARGET OPTION...: libFuzzer with the options; adds the inputs that it ran to `runs`, and fails if it found
# something.
run_fuzzer() {
  local target=$1 corpus=build/fuzz/corpus/$1 kind log=build/fuzz/$1.log
  shift
  # Which features are rare is not followed: that took more than half of the time of targets that run fast.
  local options=(-max_len="${longest[$target]}" -detect_leaks=0 -entropic=0 "$@")
  local dictionary=tests/fuzz/${target%%_*}.dict  # One per format: csv and csv_file share one.
  [[ -f $dictionary ]] || dictionary=tests/fuzz/sea/${target%%_*}.dict
  [[ ! -f $dictionary ]] || options+=(-dict="$dictionary")
  local known=("build/fuzz/seeds/$target")
  for kind in found reached; do
    [[ ! -d tests/fuzz/$kind/$target ]] || known+=("tests/fuzz/$kind/$target")
  done
  mkdir -p "$corpus"
  local code=0
  "$folder/${target}_fuzz" -rss_limit_mb=2048 -timeout=60 -print_final_stats=1 \
    -artifact_prefix="build/fuzz/corpus/$target." "${options[@]}" "$corpus" "${known[@]}" >"$log" 2>&1 || code=$?
  runs=$((runs + $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") + 0))
  return "$code"
}

# fuzz TARGET: fails if it found something.
fuzz() {
  local target=$1 start=$SECONDS runs=0 known
  run_fuzzer "$target" -max_total_time="$seconds" || return 1
  if ((runs < at_least)); then
    # Inputs that are already in the corpus are run again first.
    known=$(find "build/fuzz/corpus/$target" -type f | wc -l)
    run_fuzzer "$target" -runs=$((at_least - runs + known)) || return 1
  fi
  echo "$target: $runs executions in $((SECONDS - start)) s, nothing found"
}

# Prints what a target found.
found() {
  local log=build/fuzz/$1.log
  echo "$1: FOUND SOMETHING, see $log:"
  grep -m 5 -E 'does not hold|ERROR|SUMMARY|runtime error|Test unit written' "$log" || tail -n 5 "$log"
}

status=0
declare -A target_of=()  # By process.
await_one() {
  local process
  wait -n -p process "${!target_of[@]}" || { status=1; found "${target_of[$process]}"; }
  unset "target_of[$process]"
}
for target in "${targets[@]}"; do
  ((${#target_of[@]} < $(nproc))) || await_one
  fuzz "$target" &
  target_of[$!]=$target
done
while ((${#target_of[@]} > 0)); do await_one; done
exit "$status"

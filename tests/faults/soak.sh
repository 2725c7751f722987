#!/usr/bin/env bash
# Runs all kinds of load at once against one server. mixed_load.py says which, and what must hold.
#
# Usage: soak.sh [MINUTES]      (default: 30) after the programs have been built in build/release
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
build=build/release
PYTHONPATH=tests/e2e:tests/programs/query:clients/python/src \
  /usr/bin/python3 -B tests/faults/mixed_load.py --minutes "${1:-30}" \
  query="$build/bin/albtpu-query" serve="$build/bin/albtpu-serve" \
  synthetic_table="$build/tests/tables/albtpu_synthetic_table" \
  simulated_flight="$build/tests/formats/albtpu_simulated_flight"

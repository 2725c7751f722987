#!/usr/bin/env bash
# Half an hour of everything at once against one server: mixed_load.py says what that is, and what must hold.
#
# Usage: soak.sh      after the programs are built in build/release
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
build=build/release
PYTHONPATH=tests/e2e:tests/service/client:clients/python/src \
  /usr/bin/python3 -B tests/faults/mixed_load.py --minutes 30 \
  query="$build/service/client/albtpu-query" serve="$build/service/server/albtpu-serve" \
  synthetic_table="$build/tests/tables/albtpu_synthetic_table" \
  simulated_flight="$build/tests/service/client/albtpu_simulated_flight"

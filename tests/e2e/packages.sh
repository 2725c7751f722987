#!/usr/bin/env bash
# Makes the Debian packages of both Debians and tests them in bare roots (packages_test.py).
#
# Usage: packages.sh      as root; the programs must have been built in build/release
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

if ((EUID != 0)); then
  echo "skipped: packages: not root, who alone can install packages into a root"
  exit 0
fi
./package.sh
simulated_survey=build/release/tests/flights/albtpu_simulated_survey
status=0
for suite in bookworm trixie; do
  /usr/bin/python3 -B tests/e2e/packages_test.py "$suite" . "$simulated_survey" || status=1
done
exit "$status"

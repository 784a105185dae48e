#!/usr/bin/env bash
# prove.sh: every rounding constant by its script (docs/rounding.md). Ends with 1 if one is unproven
# without a named reason.
set -euo pipefail
cd "$(dirname "$0")/.."
. dev/common.sh

for package in $(packages proofs); do
  (install_missing "$package") || echo "run: not to be had: $package; its part is skipped" >&2
done
exec python3 tests/gappa/proofs.py prove

# Tests in shell share this. shellcheck shell=bash
set -euo pipefail
export LC_ALL=C

readonly skipped=77 # CTest's SKIP_RETURN_CODE

skip() {
  echo "SKIPPED: $*"
  exit "$skipped"
}

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

# need TOOL PACKAGE skips the test where the tool is missing.
need() {
  command -v "$1" >/dev/null || skip "no $1 here; it is in Debian's package $2"
}

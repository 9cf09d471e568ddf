# What the tests of the interface share. They get, from CTest, in the environment:
#   SOURCE    CRT's source
#   LIBRARY   libcrt.so, as built
#   WORK      a folder of the test's own
#   CC, CXX   the compilers that CRT was built with
#   SANITIZE  what the build is instrumented with, if so
# shellcheck shell=bash
set -euo pipefail
export LC_ALL=C

header=$SOURCE/include/crt/crt.h
readonly skipped=77 # CTest's SKIP_RETURN_CODE

skip() {
  echo "SKIPPED: $*"
  exit "$skipped"
}

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

# need TOOL PACKAGE: skips where the tool is missing.
need() {
  command -v "$1" >/dev/null || skip "no $1 here; it is in Debian's package $2"
}

# exported_functions: the names, sorted.
exported_functions() {
  nm -D --defined-only "$LIBRARY" | awk '$2 == "T" { sub(/@.*/, "", $3); print $3 }' | sort
}

rm -rf "$WORK"
mkdir -p "$WORK"
cd "$WORK"

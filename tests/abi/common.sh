# The tests of the interface share this. They get these from CTest, in the environment:
#   SOURCE    CRT's source
#   LIBRARY   libcrt.so, as built
#   WORK      a folder of the test's own
#   CC, CXX   the compilers that CRT was built with
#   SANITIZE  what the build is instrumented with, if so
# shellcheck shell=bash
# shellcheck source=tests/support/shell.sh
source "$SOURCE/tests/support/shell.sh"

header=$SOURCE/include/crt/crt.h

# exported_functions prints the names, sorted.
exported_functions() {
  nm -D --defined-only "$LIBRARY" | awk '$2 == "T" { sub(/@.*/, "", $3); print $3 }' | sort
}

rm -rf "$WORK"
mkdir -p "$WORK"
cd "$WORK"

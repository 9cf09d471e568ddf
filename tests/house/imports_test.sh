#!/usr/bin/env bash
# Checks that what makes pictures takes no function from the C library's mathematics but those that
# are exact, and so the same anywhere; and that the compiler has not fused products with sums on its
# own, which GCC 12.2 does with pairs side by side:  imports_test.sh COMPILER LIBRARY...
set -euo pipefail

compiler=$1
shift

# These round to integers, take numbers apart or find a remainder, all without an error. A square
# root and an fma are rounded correctly.
exact='^(sqrt|fma|floor|ceil|trunc|round|rint|nearbyint|l?lround|l?lrint|frexp|ldexp|scalbl?n|ilogb'
exact+='|logb|fmod|remainder|remquo|modf|copysign|nextafter|fmin|fmax|fabs|fdim)f?$'

mathematics=$("$compiler" -print-file-name=libm.so.6)
offered=$(nm -D --defined-only "$mathematics" |
  awk '$2 ~ /[TWi]/ { sub(/@.*/, "", $3); print $3 }' | sort -u)
grep -qx sin <<<"$offered" || { echo "no sine in $mathematics"; exit 2; }

status=0
for library in "$@"; do
  imported=$(nm --undefined-only "$library" 2>/dev/null | awk 'NF == 2 { print $2 }' | sort -u)
  grep -q memcpy <<<"$imported" || { echo "nothing is imported by $library"; exit 2; }
  wrong=$(comm -12 <(echo "$offered") <(echo "$imported") | grep -vE "$exact" || true)
  [[ -z $wrong ]] || {
    echo "$library takes from the C library (crt/elementary.hpp has its own): ${wrong//$'\n'/ }"
    status=1
  }
  # The sources never ask for these instructions of x86-64.
  fused=$(objdump -d --no-show-raw-insn "$library" | grep -cE '\svfm(addsub|subadd)' || true)
  [[ $fused == 0 ]] || {
    echo "$library has $fused fused products that no source says: see src/core/CMakeLists.txt"
    status=1
  }
done
exit $status

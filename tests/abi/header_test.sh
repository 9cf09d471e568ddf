#!/usr/bin/env bash
# crt.h compiles on its own, strictly, as each C and C++ that it is for, by each installed compiler.
# shellcheck source=tests/abi/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

printf '#include <crt/crt.h>\n#include <crt/crt.h>\nint main(void) { return CRT_OK; }\n' >alone.c
cp alone.c alone.cpp
strict=(-pedantic-errors -Wall -Wextra -Wconversion -Wshadow -Werror -fsyntax-only
  -I "$SOURCE/include")

compilations=0
declare -A tried=()

# compile_as SOURCE COMPILER STANDARD... skips a compiler that is not installed or had its turn.
compile_as() {
  local compiler standard
  compiler=$(command -v "$2") || return 0
  [[ -z ${tried[$compiler]:-} ]] || return 0
  tried[$compiler]=1
  for standard in "${@:3}"; do
    "$compiler" "-std=$standard" "${strict[@]}" "$1" || fail "$2 does not take crt.h as $standard"
    echo "$compiler as $standard: fine"
    compilations=$((compilations + 1))
  done
}

for compiler in "$CC" gcc clang; do
  compile_as alone.c "$compiler" c99 c11 c17
done
for compiler in "$CXX" g++ clang++; do
  compile_as alone.cpp "$compiler" c++11 c++20
done
((compilations >= 5)) || fail "only $compilations compilations"

#!/usr/bin/env bash
# Compares the interface of libcrt.so as built with the dump that is kept here. There may be more
# functions, and nothing else may differ. If another change is meant (a field was appended to a
# struct that may grow), `./dev abi-dump` records it.
# shellcheck source=tests/abi/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
[[ $(uname -m) == x86_64 ]] || skip "the dump is of x86-64"
need abidw abigail-tools

here=$SOURCE/tests/abi
kept=$here/libcrt.abi

# The bits of abidiff's exit code are 1 for an error, 2 for wrong usage, 4 for a change, 8 for an
# incompatible one. Functions that were added do not count. Changes that it calls harmless (an
# enumerator, a const) do.
compare() {
  local code=0
  abidiff --no-added-syms --harmless "$1" "$2" >abidiff.txt 2>&1 || code=$?
  (((code & 3) == 0)) || fail "abidiff could not compare $1 and $2: $(cat abidiff.txt)"
  return "$code"
}

"$here/dump.sh" "$LIBRARY" now.abi
! grep -nF -e "$SOURCE" -e "$(dirname "$LIBRARY")" now.abi ||
  fail "the dump names folders of this build"

# First the comparison must see what it should: a missing function and a longer struct. It must
# ignore a further function.
sed -e "/<elf-symbol name='crt_version'/d" \
  -e "/<function-decl name='crt_version'/,/<\/function-decl>/d" now.abi >fewer.abi
sed "/class-decl name='crt_hit'/s/size-in-bits='448'/size-in-bits='512'/" now.abi >longer.abi
! cmp -s now.abi fewer.abi || fail "the dump has no crt_version"
! cmp -s now.abi longer.abi || fail "the dump has no crt_hit"
compare fewer.abi now.abi || fail "a function more counts as a change: $(cat abidiff.txt)"
! compare now.abi fewer.abi || fail "a function less goes unseen"
! compare now.abi longer.abi || fail "a longer struct goes unseen"

compare "$kept" now.abi || fail "programs built with version 1.0 may not run with this library:
$(cat abidiff.txt)"

#!/usr/bin/env bash
# Compares the interface of libcrt.so as built with the dump that is kept here: there may be functions more,
# and nothing else may differ. If that is meant (a field was appended to a struct that may grow): ./dev abi-dump.
# shellcheck source=tests/abi/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
[[ $(uname -m) == x86_64 ]] || skip "the dump is of x86-64"
need abidw abigail-tools

here=$SOURCE/tests/abi
kept=$here/libcrt.abi

# abidiff's exit code, in bits: 1 an error, 2 wrong usage, 4 a change, 8 an incompatible one. Functions that
# were added are not looked at; changes that it calls harmless (an enumerator, a const) are.
compare() {
  local code=0
  abidiff --no-added-syms --harmless "$1" "$2" >abidiff.txt 2>&1 || code=$?
  (((code & 3) == 0)) || fail "abidiff could not compare $1 and $2: $(cat abidiff.txt)"
  return "$code"
}

"$here/dump.sh" "$LIBRARY" now.abi
if grep -nF -e "$SOURCE" -e "$(dirname "$LIBRARY")" now.abi; then fail "the dump names folders of this build"; fi

# First, that the comparison sees what it should: a function less, a struct that is longer; and passes over one more.
sed -e "/<elf-symbol name='crt_version'/d" -e "/<function-decl name='crt_version'/,/<\/function-decl>/d" now.abi >fewer.abi
sed "s/class-decl name='crt_hit' size-in-bits='448'/class-decl name='crt_hit' size-in-bits='512'/" now.abi >longer.abi
if cmp -s now.abi fewer.abi || cmp -s now.abi longer.abi; then fail "the dump has no crt_version or no crt_hit"; fi
compare fewer.abi now.abi || fail "a function more counts as a change: $(cat abidiff.txt)"
! compare now.abi fewer.abi || fail "a function less goes unseen"
! compare now.abi longer.abi || fail "a longer struct goes unseen"

compare "$kept" now.abi || fail "programs built with version 1.0 may not run with this library:
$(cat abidiff.txt)"

#!/usr/bin/env bash
# libcrt.so exports the functions of crt.h under their version, has its soname, and needs no library
# that is not on the list.
# shellcheck source=tests/abi/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
need nm binutils

# All symbols are functions crt_*@@CRT_1.x, and the versions themselves. A function stays in the
# version that it came with: those of 1.0 are what the program of 1.0 calls.
nm -D --defined-only "$LIBRARY" | awk '{ print $2, $3 }' >symbols.txt
! grep -vxE 'T crt_[a-z0-9_]+@@CRT_1\.[01]|A CRT_1\.[01]' symbols.txt ||
  fail "libcrt.so shows these too"
grep -qxF 'T crt_affine_product@@CRT_1.1' symbols.txt || fail "crt_affine_product is not of 1.1"
grep -oE '\bcrt_[a-z0-9_]+\(' "$SOURCE/tests/abi/1.0/program.c" | tr -d '(' | sort -u >of_1_0.txt
[[ -s of_1_0.txt ]] || fail "the program of 1.0 calls nothing"
while IFS= read -r name; do
  ! grep -qE "^T $name@@" symbols.txt || grep -qxF "T $name@@CRT_1.0" symbols.txt ||
    fail "$name is no longer of 1.0"
done <of_1_0.txt

# The header says so of each function.
awk '/^ *\/\*\*/ { comment = "" }
     { comment = comment " " $0 }
     /^CRT_API/ { open = 1 }
     open && match($0, /crt_[a-z0-9_]+\(/) {
       name = substr($0, RSTART, RLENGTH - 1)
       print (comment ~ /Since[ *]+1\.1\./ ? "CRT_1.1" : "CRT_1.0"), name
       open = 0
       comment = ""
     }' "$header" | sort >said.txt
diff said.txt <(sed -nE 's/^T (.*)@@(.*)/\2 \1/p' symbols.txt | sort) ||
  fail "< is what crt.h says of when a function came, > what libcrt.so has"

# This is the header without comments and directives, each declaration on a line.
sed '/^#/d' "$header" | "$CC" -E -P -x c - | tr '\n' ' ' | tr ';' '\n' >header.txt
grep -oE 'CRT_API.*\bcrt_[a-z0-9_]+ ?\(' header.txt | grep -oE 'crt_[a-z0-9_]+ ?\($' | tr -d ' (' |
  sort >declared.txt
grep -oE '\bcrt_[a-z0-9_]+ ?\(' header.txt | tr -d ' (' | sort >functions.txt
diff declared.txt functions.txt || fail "not all functions of crt.h are CRT_API"
[[ $(uniq -d declared.txt) == "" && -s declared.txt ]] ||
  fail "crt.h declares a function twice, or none"
diff declared.txt <(exported_functions) ||
  fail "< is declared and not exported, > exported and not declared"

readelf -d "$LIBRARY" >dynamic.txt
grep -qF 'soname: [libcrt.so.1]' dynamic.txt || fail "the soname is not libcrt.so.1"
! grep TEXTREL dynamic.txt || fail "its code is changed when it is loaded"

allowed='libembree[34]\.so\.[0-9]+|libtbb\.so\.[0-9]+|libstdc\+\+\.so\.6'
allowed+='|libz\.so\.1|libexpat\.so\.1|libm\.so\.6|libgcc_s\.so\.1|libc\.so\.6|ld-linux.*'
[[ -z ${SANITIZE:-} ]] || allowed+='|lib(a|ub|t)san\.so\.[0-9]+'
grep -oP 'NEEDED.*\[\K[^]]+' dynamic.txt >needed.txt
! grep -vxE "$allowed" needed.txt || fail "libcrt.so is not to need these"

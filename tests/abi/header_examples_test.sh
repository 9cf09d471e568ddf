#!/usr/bin/env bash
# The code in crt.h's comments compiles as C99. The first piece is a program, which must make its
# picture.
# shellcheck source=tests/abi/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

# Writes each @code{.c} ... @endcode, without the comment's asterisks, into 1.txt, 2.txt, ...
awk '/@endcode/ { out = "" }
     out != "" { sub(/^ \* ?/, ""); print > out }
     /@code\{\.c\}/ { out = ++count ".txt"; printf "" > out }' "$header"
pieces=$(find . -name '*.txt' | wc -l)
((pieces >= 6)) || fail "found only $pieces pieces of code in crt.h"

compile=("$CC" -std=c99 -Wall -Wextra -Werror -I "$SOURCE/include")
[[ -z ${SANITIZE:-} ]] || compile+=("-fsanitize=$SANITIZE")

cp 1.txt program.c
"${compile[@]}" -pedantic program.c -o program "$LIBRARY" "-Wl,-rpath,$(dirname "$LIBRARY")"
./program
[[ $(od -An -tx1 -N8 sphere.png | tr -d ' ') == 89504e470d0a1a0a ]] ||
  fail "the first program leaves no sphere.png"

# The others go into a function whose parameters are what they take for granted. Their own functions
# stand before it.
given='crt_entity *entity, crt_entity *sphere, crt_entity *glass_sphere, crt_entity *plate,
  crt_entity *hole_a, crt_entity *hole_b, crt_entity *part, crt_scene *scene,
  crt_prepared *prepared, crt_image *image, size_t x, size_t y'
for ((piece = 2; piece <= pieces; ++piece)); do
  {
    printf '#include <crt/crt.h>\n#include <math.h>\n#include <stdio.h>\n'
    grep '^static' "$piece.txt" || true
    printf 'void piece(%s);\nvoid piece(%s) {\n' "$given" "$given"
    grep -v '^static' "$piece.txt"
    printf '}\n'
  } >"$piece.c"
  "${compile[@]}" -Wno-unused -Wno-unused-parameter -c "$piece.c" ||
    fail "piece $piece of the code in crt.h does not compile"
done

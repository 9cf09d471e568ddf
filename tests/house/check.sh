#!/usr/bin/env bash
# The rules of the house that no compiler checks: which part may see which, how long a file may
# grow, what no file may say. Prints each breach as file:line and fails if there is one.
# Looks at what git tracks; see CONTRIBUTING.md for the rules and their reasons.
set -euo pipefail
shopt -s lastpipe # so that complain can count, at the end of a pipe
trap 'echo "${BASH_SOURCE[0]}: failed by itself at line $LINENO" >&2' ERR
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

breaches=0

# complain RULE: takes breaches on standard input, a line each (nothing is fine).
complain() {
  local found
  found=$(cat)
  [[ -n $found ]] || return 0
  printf '%s:\n' "$1"
  printf '  %s\n' "${found//$'\n'/$'\n  '}"
  breaches=$((breaches + 1))
}

# tracked PATTERN...: the tracked files that match and exist.
tracked() {
  git ls-files -- "$@" | while IFS= read -r file; do [[ ! -f $file ]] || printf '%s\n' "$file"; done
}

# lines_with REGEX PATTERN...: file:line:text for each match in the tracked files that match.
lines_with() {
  local regex=$1
  shift
  tracked "$@" | xargs -r -d '\n' grep -nHE -- "$regex" || true
}

# without REGEX: the lines that do not match, be there none.
without() {
  grep -vE -- "$1" || true
}

code=('src/*.cpp' 'src/*.hpp' 'src/*.y' 'src/*.re' 'include/*.hpp' 'include/*.h')
users=('tests/*.cpp' 'tests/*.hpp' 'tests/*.c' 'tests/*.h'
  'examples/*.cpp' 'examples/*.hpp' 'examples/*.c' 'examples/*.h')
scripts=('*.sh' '*.py' '*.rs' '*.cmake' '*.cmake.in' '*CMakeLists.txt' dev .ci/run docs/make-gallery)
recorded='^tests/abi/(1\.0|older/older_crt\.h)' # kept as it was released

# A folder of src/core uses those before it in this list, and itself.
layers=(base simd math ray tasks sampling geometry csg shading camera compile accel intersect prepare render image)
check_layers() {
  local position later
  for position in "${!layers[@]}"; do
    later=$(IFS='|' && echo "${layers[*]:position+1}")
    [[ -n $later ]] || continue
    lines_with "^#include [<\"]core/($later)/" "src/core/${layers[position]}/*"
  done
  lines_with '^#include [<"](lang|cli|capi)/' 'src/core/*'
}

# only_in THING REGEX FOLDER...: includes of a library that stand outside its folders.
only_in() {
  local regex=$1
  shift
  lines_with "^#include [<\"]($regex)" "${code[@]}" 'examples/*' |
    without "^($(IFS='|' && echo "$*"))/"
}

# What the public headers offer is all that lang, the command and the examples may see.
check_public_only() {
  lines_with '^#include [<"]core/' 'src/lang/*' 'src/cli/*' 'src/capi/*' 'examples/*'
  lines_with '^#include [<"](core|lang|cli|capi)/' 'include/*'
  lines_with '^#include <glm/' 'include/*' | without '<glm/vec3.hpp>'
  lines_with '^#include <(fmt|tbb|embree|OpenImageIO|CLI)' 'include/*'
}

# crt.hpp holds every public header but script.hpp, which belongs to the library crt::lang.
check_umbrella() {
  local header
  tracked 'include/crt/*.hpp' | while IFS= read -r header; do
    case ${header##*/} in crt.hpp | script.hpp) continue ;; esac
    grep -qF "#include <crt/${header##*/}>" include/crt/crt.hpp || echo "$header is not in crt.hpp"
  done
}

limit_of_lines=450
wish_of_lines=400
long_files() {
  tracked "${code[@]}" "${users[@]}" 'tests/*.sh' '*.cmake' '*CMakeLists.txt' dev |
    without '^include/crt/crt\.h$' | # one header is what C programs are promised
    xargs -r -d '\n' awk -v least="$1" -v most="$2" \
      'FNR == 1 { if (last && n > least && n <= most) print last ": " n " lines"; last = FILENAME } { n = FNR }
       END { if (n > least && n <= most) print last ": " n " lines" }'
}

check_scripts() {
  local file
  { git grep -lIE '^#!.*\b(ba)?sh$' || true; } | while IFS= read -r file; do
    bash -n "$file" 2>&1 || true
    ! command -v shellcheck >/dev/null || shellcheck -x -f gcc "$file" || true
    [[ -x $file ]] || echo "$file: is a script and not executable"
  done
}

# docs/abi.md names the test of each promise: programs that CTest knows, and cases that they have.
check_promises() {
  local name tests
  # A name may go on in the next line, as two strings.
  tests=$(tracked 'tests/*.cpp' 'tests/*.c' | xargs -r -d '\n' cat | tr -s '[:space:]' ' ' | sed 's/" "//g')
  grep '^|' docs/abi.md | grep -oE '"[^"]+"' | tr -d '"' | while IFS= read -r name; do
    grep -qF "\"$name\")" <<<"$tests" || echo "docs/abi.md: no test has the case \"$name\""
  done
}

check_ends() {
  local file
  git ls-files -z --eol | tr '\0' '\n' | awk '$1 ~ /crlf|mixed/ { print $NF ": line ends are not \\n" }'
  tracked "${code[@]}" "${users[@]}" '*.md' '*.txt' | while IFS= read -r file; do
    [[ ! -s $file || -z $(tail -c 1 "$file") ]] || echo "$file: the last line has no end"
  done
}

# Lines end at this column. A line with a URL may be longer, and so may the tables that the oracle writes.
most_columns=100
check_columns() {
  LC_ALL=C.UTF-8 lines_with "^.{$((most_columns + 1))}" "${code[@]}" "${users[@]}" "${scripts[@]}" '*.md' |
    without "$recorded|^docs/accuracy\.md:[0-9]+:\||https?://" | cut -c 1-120
}

# The subject of a commit fits a line of `git log`. Older ones stay as they are.
most_in_subject=72
check_subjects() {
  git log --no-merges --since=2026-11-25T12:00:00Z --format='%h %s' 2>/dev/null |
    awk -v most="$most_in_subject" '{ n = length($0) - length($1) - 1 } n > most { print $0 " (" n " characters)" }' || true
}

# Words that say nothing to a reader who knows the field, and what the field says instead.
banned_words=(outlines? 'judges?' Verdict told has_company company_width 'lamps?' 'eye rays?'
  FirstBalls BallSearch Spine CsgSketch RayBundle small_things leaf_tree box_row node_paths
  going_on go_back users_rays expect_points squared_speed leaf_told are_told)
check_words() {
  lines_with "\b($(IFS='|' && echo "${banned_words[*]}"))\b" 'src/*' 'include/*' 'tests/*' 'docs/*.md' |
    without "$recorded|^docs/design/|^tests/house/check\.sh:|\.(json|abi):" | cut -c 1-160
}

# A documentation comment is a sentence with a subject and a verb, not an answer to a question that is not there.
sentences_in=('include/*' 'src/lang/*' 'src/cli/*' 'src/capi/*')
check_sentences() {
  local opening='(The same|Of|Likewise|As before|Ditto)\b'
  # With /// the first line of a comment is the one after a line that is none.
  tracked "${sentences_in[@]}" | xargs -r -d '\n' awk -v opening="^[[:space:]]*(///|/\\*\\*)<? $opening" '
    FNR == 1 { inside = 0 }
    $0 ~ opening && !inside { print FILENAME ":" FNR ":" $0 }
    { inside = $0 ~ /^[[:space:]]*\/\/\/ / }'
}

check_layers | complain "A layer uses one above it (${layers[*]})"
only_in 'embree' src/core/accel | complain "Embree outside src/core/accel"
only_in 'tbb|oneapi/tbb' src/core/tasks src/core/accel | complain "TBB outside src/core/tasks and src/core/accel"
only_in 'OpenImageIO' src/core/image | complain "OpenImageIO outside src/core/image"
lines_with '^#include <CLI/' "${code[@]}" | without '^src/cli/options.cpp:' |
  complain "CLI11 outside src/cli/options.cpp: one source is enough to wait for"
tracked '*.y' '*.re' | without '^src/lang/' | complain "Bison or re2c outside src/lang"
check_public_only | complain "Only crt/*.hpp may be seen from here"
check_umbrella | complain "A public header is missing from crt.hpp"
tracked 'include/*.hpp' 'src/*.hpp' | { xargs -r -d '\n' grep -L '^#pragma once' || true; } | complain "No #pragma once"
lines_with '#include <format>|std::views::|std::ranges::views' "${code[@]}" |
  complain "Not with the compilers that we support"
lines_with '\bgetenv\b' 'src/core/*' 'src/lang/*' 'src/capi/*' | complain "The library reads the environment"
lines_with 'std::(cout|cerr|clog)|[^n]printf\(|\b(abort|exit|quick_exit)\(' 'src/core/*' 'src/lang/*' 'src/capi/*' |
  complain "The library prints or ends the process: log to a callback, throw crt::Error"
lines_with '\b(TODO|FIXME|XXX|HACK)\b' "${code[@]}" "${users[@]}" 'examples/*' '*.cmake' '*CMakeLists.txt' |
  complain "Unfinished work is not committed"
lines_with '^#include ' 'include/crt/crt.h' | without '<std(def|int)\.h>' | complain "crt.h includes more than it must"
lines_with '^#include [<"]crt/' 'examples/*.c' 'examples/*.h' 'tests/abi/*.c' 'tests/package/consumers/c/*' |
  without '<crt/crt\.h>' | complain "A C program sees crt.h alone"
lines_with '\.\./shared' . | without '^tests/house/check.sh:' | complain "The project stands alone"
long_files "$limit_of_lines" 1000000 | complain "Over $limit_of_lines lines: split by subject"
check_scripts | complain "Shell scripts"
check_ends | complain "Line ends"
check_promises | complain "A promise without its test"
check_columns | complain "Over $most_columns columns"
check_subjects | complain "A commit's subject has over $most_in_subject characters"
check_words | complain "A word that is not the field's: see docs/glossary.md and CONTRIBUTING.md"
check_sentences | complain "A comment that is no sentence: say what the thing is or does"

long_files "$wish_of_lines" "$limit_of_lines" | sed "s/^/note: over $wish_of_lines lines, think of splitting: /"

((breaches == 0)) || exit 1
echo "house rules: kept"

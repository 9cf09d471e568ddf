#!/usr/bin/env bash
# Checks the rules of the house that no compiler checks: which part may see which, how long a file
# and a line may grow, what no file may say. Prints each breach as file:line and fails if there is
# one. It reads what git tracks. CONTRIBUTING.md has the rules and their reasons.
set -euo pipefail
shopt -s lastpipe # complain counts at the end of a pipe
trap 'echo "${BASH_SOURCE[0]}: failed by itself at line $LINENO" >&2' ERR
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

breaches=0

# complain RULE prints the breaches on standard input, a line each. There may be none.
complain() {
  local found
  found=$(cat)
  [[ -n $found ]] || return 0
  printf '%s:\n' "$1"
  printf '  %s\n' "${found//$'\n'/$'\n  '}"
  breaches=$((breaches + 1))
}

# tracked PATTERN... prints the tracked files that match and exist. What npm makes is no source, and
# style sheets have words of their own.
tracked() {
  git ls-files -- "$@" | while IFS= read -r file; do
    case $file in src/studio/page/dist/* | */package-lock.json | *.css) continue ;; esac
    [[ ! -f $file ]] || printf '%s\n' "$file"
  done
}

# lines_with REGEX PATTERN... prints file:line:text for each match in the tracked files that match.
lines_with() {
  local regex=$1
  shift
  tracked "$@" | xargs -r -d '\n' grep -nHE -- "$regex" || true
}

# without REGEX prints the lines that do not match, of which there may be none.
without() {
  grep -vE -- "$1" || true
}

code=('src/*.cpp' 'src/*.hpp' 'src/*.y' 'src/*.re' 'include/*.hpp' 'include/*.h' 'python/*.cpp')
users=('tests/*.cpp' 'tests/*.hpp' 'tests/*.c' 'tests/*.h'
  'examples/*.cpp' 'examples/*.hpp' 'examples/*.c' 'examples/*.h')
scripts=('*.sh' '*.py' '*.rs' '*.cmake' '*.cmake.in' '*CMakeLists.txt' dev .ci/run
  docs/make-gallery .clang-tidy)
recorded='^tests/abi/(1\.0|older/older_crt\.h)' # kept as it was released

# A folder of src/core uses those before it in this list, and itself.
layers=(base simd math ray tasks sampling denoise geometry entity csg shading camera compile accel
  intersect prepare queries render image mesh_files contours left_out)
check_layers() {
  local position later
  for position in "${!layers[@]}"; do
    later=$(IFS='|' && echo "${layers[*]:position+1}")
    [[ -n $later ]] || continue
    lines_with "^#include [<\"]core/($later)/" "src/core/${layers[position]}/*"
  done
  lines_with '^#include [<"](lang|farm|cli|capi|format|service|source|lsp|studio)/' 'src/core/*'
  # Source code is written of scenes, however they were made.
  lines_with '^#include [<"](lang|farm|cli|capi|format|service|lsp|studio)/' 'src/source/*'
  # Jobs use the renderer and run scripts as any program does.
  lines_with '^#include [<"](lang|cli|capi|format|service|lsp|studio)/' 'src/farm/*'
  lines_with '^#include [<"]farm/' 'src/lang/*' 'src/format/*' 'src/service/*' 'src/lsp/*' \
    'src/studio/*' 'src/capi/*' 'src/cli/*'
  # Anybody may see what is about words, which sees nothing.
  lines_with '^#include [<"](crt|core|lang|format|service|lsp|studio|cli|capi)/' 'src/text/*'
  # The front end is seen by what lays scripts out and by what editors ask. The language server and
  # the studio see the public headers alone, and the command one header of two of these besides.
  lines_with '^#include [<"](format|service|lsp|studio|cli|capi)/' 'src/lang/*'
  lines_with '^#include [<"](format|service|lsp|studio|cli)/' 'src/capi/*'
  lines_with '^#include [<"](service|lsp|studio|cli|capi)/' 'src/format/*'
  lines_with '^#include [<"](lsp|studio|cli|capi)/' 'src/service/*'
  lines_with '^#include [<"](lang|format|service|studio|cli|capi)/' 'src/lsp/*'
  lines_with '^#include [<"](lang|format|service|lsp|cli|capi)/' 'src/studio/*'
  lines_with '^#include [<"](lang|format|service|lsp|studio|import)/' 'src/cli/*' |
    without '"(format/format|lsp/server|import/import)\.hpp"'
  # What is imported becomes a script, which any program may run.
  lines_with '^#include [<"](lang|farm|cli|capi|format|service|source|lsp|studio)/' 'src/import/*'
  lines_with '^#include [<"]import/' 'src/core/*' 'src/lang/*' 'src/farm/*' 'src/source/*' \
    'src/format/*' 'src/service/*' 'src/lsp/*' 'src/studio/*' 'src/capi/*'
  lines_with '^#include [<"]format/' 'src/service/*' | without '"format/format\.hpp"'
}

# only_in REGEX FOLDER... prints includes of a library that stand outside its folders.
only_in() {
  local regex=$1
  shift
  lines_with "^#include [<\"]($regex)" "${code[@]}" 'examples/*' |
    without "^($(IFS='|' && echo "$*"))/"
}

# What the public headers offer is all that lang, the command and the examples may see.
check_public_only() {
  lines_with '^#include [<"]core/' 'src/lang/*' 'src/format/*' 'src/service/*' 'src/lsp/*' \
    'src/studio/*' 'src/cli/*' 'src/capi/*' 'src/import/*' 'examples/*'
  lines_with '^#include [<"](core|lang|cli|capi)/' 'include/*'
  lines_with '^#include <glm/' 'include/*' | without '<glm/vec3.hpp>'
  lines_with '^#include <(fmt|tbb|embree|OpenImageIO|CLI)' 'include/*'
}

# crt.hpp holds every public header but those that belong to libraries beside crt::core: crt::lang,
# crt::farm, crt::service, crt::source and crt::studio. Few programs look at the schema.
check_umbrella() {
  local header
  tracked 'include/crt/*.hpp' | while IFS= read -r header; do
    case ${header##*/} in
      crt.hpp | script.hpp | farm.hpp | language_service.hpp) continue ;;
      text_places.hpp | source_code.hpp | studio.hpp | schema*.hpp) continue ;;
    esac
    grep -qF "#include <crt/${header##*/}>" include/crt/crt.hpp || echo "$header is not in crt.hpp"
  done
}

# What a primitive is, its own folder knows. Meshes have facets besides, and two kinds of solids
# also stand for others as bounds.
check_kinds() {
  lines_with '^#include "core/geometry/[a-z_]+/' 'src/core/*' |
    without '^src/core/geometry/|"core/geometry/(mesh/|(sphere|frustum)/enclose\.hpp)'
  lines_with '\b(get|get_if|holds_alternative)<(const )?(Sphere|Box|Plane|HalfPlane|Cylinder)\b' \
    'src/core/*'
  lines_with '\b(get|get_if|holds_alternative)<(const )?(Cone|Capsule|Torus|Disc|Triangle)\b' \
    'src/core/*'
}

limit_of_lines=450
wish_of_lines=400
long_files() {
  tracked "${code[@]}" "${users[@]}" 'tests/*.sh' '*.cmake' '*CMakeLists.txt' dev |
    without '^include/crt/crt\.h$' | # one header is what C programs are promised
    xargs -r -d '\n' awk -v least="$1" -v most="$2" \
      'FNR == 1 { if (last && n > least && n <= most) print last ": " n " lines"; last = FILENAME }
       { n = FNR }
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
  # A name may continue in the next line, as two strings.
  tests=$(tracked 'tests/*.cpp' 'tests/*.c' | xargs -r -d '\n' cat |
    tr -s '[:space:]' ' ' | sed 's/" "//g')
  grep '^|' docs/abi.md | grep -oE '"[^"]+"' | tr -d '"' | while IFS= read -r name; do
    grep -qF "\"$name\")" <<<"$tests" || echo "docs/abi.md: no test has the case \"$name\""
  done
}

# CMakeLists.txt has the version, and the tests compare it with crt.h and Python's.
check_versions() {
  local file version
  version=$(sed -nE 's/^project\(crt VERSION ([0-9.]+) .*/\1/p' CMakeLists.txt)
  for file in python/crt/_version.py editors/vscode/package.json src/studio/page/package.json; do
    grep -qF "\"$version\"" "$file" || echo "$file: is not of version '$version'"
  done
}

# docs/installing.md has a row for each option that leaves out a part.
check_parts() {
  local option
  sed -nE 's/^crt_part\((CRT_[A-Z_]+) .*/\1/p; s/^crt_part\((CRT_[A-Z_]+)$/\1/p' \
    cmake/CrtOptions.cmake | while IFS= read -r option; do
    grep -qF "| \`$option\` |" docs/installing.md || echo "docs/installing.md: no $option"
  done
}

check_ends() {
  local file
  git ls-files -z --eol | tr '\0' '\n' |
    awk '$1 ~ /crlf|mixed/ { print $NF ": line ends are not \\n" }'
  tracked "${code[@]}" "${users[@]}" '*.md' '*.txt' | while IFS= read -r file; do
    [[ ! -s $file || -z $(tail -c 1 "$file") ]] || echo "$file: the last line has no end"
  done
}

# Lines end at this column. Lines with a URL may be longer, and so may the tables that the oracle
# writes into docs/accuracy.md.
most_columns=100
check_columns() {
  LC_ALL=C.UTF-8 lines_with "^.{$((most_columns + 1))}" \
    "${code[@]}" "${users[@]}" "${scripts[@]}" '*.md' |
    without "$recorded|^docs/accuracy\.md:[0-9]+:\||https?://" | cut -c 1-120
}

# The subject of a commit fits a line of `git log`. Commits before the rule stay as they are, and a
# tree without a history has none to check.
most_in_subject=72
check_subjects() {
  { git log --no-merges --since=2026-11-25T12:00:00Z --format='%h %s' 2>/dev/null || true; } |
    LC_ALL=C.UTF-8 grep -E "^[0-9a-f]+ .{$((most_in_subject + 1))}" || true
}

# These words say nothing to a reader who knows the field. docs/glossary.md has the field's words.
# The gallery's scripts may have lamps in their pictures.
banned_words=(told are_told leaf_told has_company company_width 'outlines?' Verdict 'judges?'
  'lamps?' 'eye rays?' 'eye-rays?' FirstBalls BallSearch Spine CsgSketch RayBundle small_things
  leaf_tree box_row node_paths going_on go_back users_rays expect_points squared_speed
  first_above asked_above farthest_start flattest_start is_first_asked
  no_face no_item no_arc Stay Stayed BoundaryChanges ChangeCrossing change_of comes_back goes_into
  EnclosedSolid TypedShape plain_sphere)
check_words() {
  lines_with "\b($(IFS='|' && echo "${banned_words[*]}"))\b" \
    'src/*' 'include/*' 'python/*' 'tests/*' 'docs/*.md' 'README.md' 'CONTRIBUTING.md' |
    without "$recorded|^docs/(design/|gallery\.md:)|^tests/house/check\.sh:|\.abi:" |
    # FreeType has a field of this name, and OpenCue a Python module.
    without 'glyph->outline|^tests/farm/templates_test\.py:' |
    cut -c 1-160
}

# A documentation comment is a sentence with a subject and a verb. Such a beginning shows that it
# hangs on another comment. Only the first line of a comment counts.
sentences_in=('include/*' 'src/*' 'tests/math/*' 'tests/geometry/*' 'tests/intersect/*'
  'tests/csg/*' 'tests/accel/*' 'tests/simd/*')
check_sentences() {
  # shellcheck disable=SC2016 # $0 is awk's
  tracked "${sentences_in[@]}" | xargs -r -d '\n' awk '
    FNR == 1 { inside = 0 }
    !inside && /^ *(\/\/\/|\/\*\*) (The same|Of|Likewise|Ditto|As before|Whether)[ :;,.]/ {
      print FILENAME ":" FNR ":" $0
    }
    { inside = /^ *\/\/\// }'
}

check_layers | complain "A layer uses one above it (${layers[*]})"
only_in 'embree' src/core/accel | complain "Embree outside src/core/accel"
only_in 'tbb|oneapi/tbb' src/core/tasks src/core/accel |
  complain "TBB outside src/core/tasks and src/core/accel"
only_in 'png\.h' python/native | complain "libpng outside python/native"
only_in 'fmt/' src/cli |
  complain "The library fmt outside the command: libraries use text::format of text/format.hpp"
only_in 'zlib' src/core/image src/core/mesh_files |
  complain "zlib outside src/core/image and src/core/mesh_files"
only_in 'expat' src/core/mesh_files | complain "Expat outside src/core/mesh_files"
only_in '(ft2build|freetype)' src/core/contours | complain "FreeType outside src/core/contours"
only_in 'OpenImageIO' src/core/image | complain "OpenImageIO outside src/core/image"
lines_with '^#include <CLI/' "${code[@]}" | without '^src/cli/options.cpp:' |
  complain "CLI11 outside src/cli/options.cpp: one source is enough to wait for"
lines_with '^#include (<nlohmann/json\.hpp>|"text/json\.hpp")' "${code[@]}" |
  without '^src/text/json\.hpp:' |
  without '^src/(lsp/(server|requests|json_values)|farm/manifest|cli/(stats|measure)_json)\.cpp:' |
  without '^src/studio/(messages|view_messages|solid_messages|listing|scene_server)\.cpp:' |
  without '^src/studio/(studio_client|view_client)\.cpp:' |
  complain "JSON outside the sources that have to wait for it"
lines_with '\b([jJ]son::(parse|accept|sax_parse)|parse_json)\(' "${code[@]}" |
  without '^src/text/json\.hpp:|\btext::parse_json\(' |
  complain "JSON is read by text::parse_json() alone, which has limits"
lines_with '^#include <boost/' "${code[@]}" |
  without '^src/studio/(session\.hpp|tls\.cpp|web_server\.cpp):' |
  complain "Boost outside the studio's server: few sources are enough to wait for"
lines_with '^#include "studio/(session|tls)\.hpp"' "${code[@]}" |
  without '^src/studio/(main|session|tls|web_server)\.cpp:' |
  complain "Boost or OpenSSL seen outside the studio's server"
tracked '*.y' '*.re' | without '^src/lang/' | complain "Bison or re2c outside src/lang"
check_kinds | complain "A primitive's kind is known outside of its folder: ask the shape"
check_public_only | complain "Only crt/*.hpp may be seen from here"
tracked 'src/*.cpp' | xargs -r -d '\n' awk -f tests/house/twins.awk |
  complain "Two functions of a folder have one name"

# Two meanings of one name in a namespace are one symbol, and no linker complains of that.
{
  git grep -hoE '^(class|struct) [A-Z][A-Za-z]*( final)?( :| \{)' -- 'src/core/*.hpp' |
    awk '{ print $2 }'
  git grep -hoE '^inline constexpr [a-z:_0-9]+ [a-z_0-9]+ =' -- 'src/core/*.hpp' |
    awk '{ print $(NF - 1) }'
} | sort | uniq -d | complain "Two types or constants of src/core have one name"
check_umbrella | complain "A public header is missing from crt.hpp"
tracked 'include/*.hpp' 'src/*.hpp' | { xargs -r -d '\n' grep -L '^#pragma once' || true; } |
  complain "No #pragma once"
lines_with '#include <format>|std::views::|std::ranges::views' "${code[@]}" |
  complain "Not with the compilers that we support"
lines_with '\bgetenv\b' 'src/core/*' 'src/lang/*' 'src/farm/*' 'src/capi/*' 'src/format/*' \
  'src/service/*' 'src/source/*' 'src/lsp/*' 'src/import/*' |
  complain "The library reads the environment"
lines_with 'std::(cout|cerr|clog)|[^n]printf\(|\b(abort|exit|quick_exit)\(' 'src/core/*' \
  'src/lang/*' 'src/farm/*' 'src/capi/*' 'src/format/*' 'src/service/*' 'src/source/*' 'src/lsp/*' \
  'src/import/*' |
  without '^src/source/templates\.hpp:' | # programs that are written may do so
  complain "The library prints or ends the process: log to a callback, throw crt::Error"
lines_with '\b(TODO|FIXME|XXX|HACK)\b' \
  "${code[@]}" "${users[@]}" 'examples/*' '*.cmake' '*CMakeLists.txt' |
  complain "Unfinished work is not committed"
lines_with '^#include ' 'include/crt/crt.h' | without '<std(def|int)\.h>' |
  complain "crt.h includes more than it must"
lines_with '^#include [<"]crt/' \
  'examples/*.c' 'examples/*.h' 'tests/abi/*.c' 'tests/package/consumers/c/*' |
  without '<crt/crt\.h>' | complain "A C program sees crt.h alone"
lines_with '\.\./shared' . | without '^tests/house/check.sh:' | complain "The project stands alone"
long_files "$limit_of_lines" 1000000 | complain "Over $limit_of_lines lines: split by subject"
check_scripts | complain "Shell scripts"
check_ends | complain "Line ends"
check_parts | complain "An option that is not documented"
check_versions | complain "Not the version of CMakeLists.txt"
check_promises | complain "A promise without its test"
check_columns | complain "Over $most_columns columns"
check_subjects | complain "A commit's subject has over $most_in_subject characters"
check_words | complain "A word that is not the field's: see docs/glossary.md"
check_sentences | complain "A comment that is no sentence: say what the thing is or does"

long_files "$wish_of_lines" "$limit_of_lines" |
  sed "s/^/note: over $wish_of_lines lines, think of splitting: /"

((breaches == 0)) || exit 1
echo "house rules: kept"

#!/usr/bin/env bash
# What docs/installing.md tells readers to write and to type does what it says, word for word.
# shellcheck source=tests/package/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
need pkg-config pkg-config

work=$WORK/document
rm -rf "$work"
mkdir -p "$work"
cd "$work"

# Writes each piece of code into a file of its own, named for its number and language.
awk '/^```/ && out != "" { out = ""; next }
     /^```/ { out = sprintf("%02d.%s", ++count, substr($0, 4)); next }
     out != "" { print > out }' "$SOURCE/docs/installing.md"
module=$(grep -l 'TARGET_FILE:crt::image_files' ./*.cmake) || fail "nothing brings the module along"

# prepare FOLDER makes a folder with the consumers' sources under the names that the document uses.
prepare() {
  mkdir "$work/$1"
  cd "$work/$1"
  cp "$SOURCE/tests/package/consumers/c/program.c" my_program.c
  cp "$SOURCE/tests/package/consumers/cpp/program.cpp" my_program.cpp
}

projects=0
for piece in "$work"/*.cmake; do
  grep -q '^project(' "$piece" || continue
  projects=$((projects + 1))
  prepare "project_$projects"
  cat "$piece" >CMakeLists.txt
  cmake -S . -B . -DCMAKE_PREFIX_PATH="$moved" \
    -DCMAKE_C_COMPILER="$CC" -DCMAKE_CXX_COMPILER="$CXX" \
    -DCMAKE_BUILD_TYPE=Release --no-warn-unused-cli >configure.log 2>&1 ||
    fail "$piece: $(cat configure.log)"
  cmake --build . >build.log 2>&1 || fail "$piece: $(cat build.log)"
  run_program ./my_program
done
((projects == 3)) || fail "$projects CMake projects in the document, not 3"

# A C++ program brings the module along.
prepare with_module
cat "$(grep -l 'COMPONENTS core' "$work"/*.cmake)" "$work/$module" >CMakeLists.txt
cmake -S . -B . -DCMAKE_PREFIX_PATH="$moved" -DCMAKE_CXX_COMPILER="$CXX" \
  -DCMAKE_BUILD_TYPE=Release --no-warn-unused-cli >configure.log 2>&1 || fail "$(cat configure.log)"
cmake --build . >build.log 2>&1 || fail "$(cat build.log)"
[[ -e crt/crt_image_files.so ]] || fail "the module does not come along"
run_program ./my_program

lines=0
while IFS= read -r line; do
  lines=$((lines + 1))
  prepare "line_$lines"
  PKG_CONFIG_PATH=$moved/$LIBDIR/pkgconfig bash -euc "$line" || fail "$line"
  run_program LD_LIBRARY_PATH="$moved/$LIBDIR" ./my_program
done < <(cat "$work"/*.sh | grep '^cc ')
((lines == 2)) || fail "$lines lines to compile with in the document, not 2"

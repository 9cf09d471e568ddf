#!/usr/bin/env bash
# Builds and runs a consumer against the installed, moved tree.
# usage: consumer_test.sh KIND, one of the cases below.
# shellcheck source=tests/package/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

kind=$1
consumers=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/consumers
build=$WORK/consumers/$kind
rm -rf "$build"
mkdir -p "$build"
cd "$build"

# with_cmake PROJECT TREE [ARGUMENT...] builds a consumer by CMake.
with_cmake() {
  cmake -S "$consumers/$1" -B . -DCMAKE_PREFIX_PATH="$2" \
    -DCMAKE_C_COMPILER="$CC" -DCMAKE_CXX_COMPILER="$CXX" \
    -DCMAKE_BUILD_TYPE=Release --no-warn-unused-cli "${@:3}" >configure.log 2>&1 ||
    fail "$(cat configure.log)"
  cmake --build . >build.log 2>&1 || fail "$(cat build.log)"
  run_program ./program
}

# with_pkg_config TREE [FLAG...] builds one by a plain compiler, as strict C99.
with_pkg_config() {
  need pkg-config pkg-config
  export PKG_CONFIG_PATH=$1/$LIBDIR/pkgconfig
  # shellcheck disable=SC2046 # flags are words
  "$CC" -std=c99 -pedantic -Wall -Wextra -Werror "$consumers/c/program.c" -o program \
    $(pkg-config --cflags --libs "${@:2}" crt)
}

# This stands for a machine that has libcrt-dev and none of what the C++ libraries need.
without_dependencies=()
for package in glm fmt TBB embree ZLIB EXPAT OpenImageIO Threads; do
  without_dependencies+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
done

case $kind in
  cmake)
    with_cmake c "$moved" "${without_dependencies[@]}"
    tr -s '[:space:]' ' ' <configure.log |
      grep -qF 'find_package(crt COMPONENTS core lang static)' ||
      fail "nothing says how to ask for the other targets: $(cat configure.log)"
    ;;
  cmake_cpp) with_cmake cpp "$moved" ;;
  cmake_whole) with_cmake whole "$moved" ;;
  cmake_static) with_cmake c "$moved" -DSTATIC=ON ;;
  cmake_static_only) with_cmake c "$static_only" ;;
  pkg_config)
    with_pkg_config "$moved"
    run_program LD_LIBRARY_PATH="$moved/$LIBDIR" ./program
    ;;
  pkg_config_static)
    with_pkg_config "$static_only" --static
    run_program ./program
    # Where both libraries are, the static one is named.
    # shellcheck disable=SC2046 # flags are words
    PKG_CONFIG_PATH=$moved/$LIBDIR/pkgconfig "$CC" -std=c99 "$consumers/c/program.c" -o program \
      $(PKG_CONFIG_PATH=$moved/$LIBDIR/pkgconfig pkg-config --static --cflags --libs crt |
        sed s/-lcrt/-l:libcrt.a/)
    ! readelf -d ./program | grep -F 'libcrt.so' || fail "the program needs libcrt.so"
    run_program ./program
    ;;
  examples)
    # Two stand for all, which take long to build.
    cmake -S "$moved/share/doc/crt/examples" -B . -DCMAKE_PREFIX_PATH="$moved" \
      -DCMAKE_C_COMPILER="$CC" -DCMAKE_CXX_COMPILER="$CXX" -DCMAKE_BUILD_TYPE=Release \
      >configure.log 2>&1 || fail "$(cat configure.log)"
    cmake --build . --target example_queries hello >build.log 2>&1 || fail "$(cat build.log)"
    [[ -x hello && -x c/queries ]] || fail "the examples are not built"
    exit
    ;;
  subdirectory)
    # Building all of CRT once more would take too long.
    cmake -S "$consumers/subdirectory" -B . -DCRT_SOURCE="$SOURCE" \
      -DCMAKE_C_COMPILER="$CC" -DCMAKE_CXX_COMPILER="$CXX" \
      >configure.log 2>&1 || fail "$(cat configure.log)"
    cmake --build . --target help >targets.txt
    ! grep -E '(test_|abi_|\bhello\b)' targets.txt ||
      fail "a project with CRT in it has CRT's tests and examples"
    exit
    ;;
  *) fail "no kind $kind" ;;
esac

if [[ $kind == *static* || $kind == *cpp || $kind == *whole ]]; then
  ! readelf -d program | grep -F libcrt || fail "the program was to have libcrt in it"
else
  readelf -d program | grep -qF 'NEEDED' || fail "the program has no libraries"
  readelf -d program | grep -qF '[libcrt.so.1]' || fail "the program does not need libcrt.so.1"
  ! readelf -d program | grep -E 'NEEDED.*(embree|tbb|fmt|stdc)' ||
    fail "it needs the libraries that libcrt uses"
fi

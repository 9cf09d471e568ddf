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

# without PACKAGE... prints the arguments by which CMake does not find packages.
without() {
  printf -- '-DCMAKE_DISABLE_FIND_PACKAGE_%s=ON\n' "$@"
}

# What the renderer alone does not need. What else it needs is a compiler.
mapfile -t without_features < <(without fmt ZLIB EXPAT Freetype OpenImageIO nlohmann_json Boost \
  OpenSSL CLI11 BISON PNG doctest)
# This stands for a machine that has libcrt-dev and none of what the C++ libraries need.
mapfile -t without_dependencies < <(without glm TBB embree ZLIB EXPAT OpenImageIO Threads)

# expect_components COMPONENTS OPTIONAL REGEX... asks the installed CRT for components, and checks
# what CMake says of it.
expect_components() {
  cmake -S "$consumers/components" -B . -DCMAKE_PREFIX_PATH="$tree" -DCMAKE_CXX_COMPILER="$CXX" \
    -DCOMPONENTS="$1" -DOPTIONAL="$2" "${without[@]}" >configure.log 2>&1 ||
    fail "$(cat configure.log)"
  tr -s '[:space:]' ' ' <configure.log >said.txt
  local regex
  for regex in "${@:3}"; do
    grep -qE -- "$regex" said.txt || fail "CMake does not say '$regex': $(cat configure.log)"
  done
  rm -r CMakeCache.txt
}

case $kind in
  cmake)
    with_cmake c "$moved" "${without_dependencies[@]}"
    tr -s '[:space:]' ' ' <configure.log |
      grep -qF 'find_package(crt COMPONENTS core lang static)' ||
      fail "nothing says how to ask for the other targets: $(cat configure.log)"
    ;;
  components)
    tree=$moved
    without=()
    expect_components 'crt;static;core;lang;source;farm;service;studio' '' 'crt_FOUND 1' \
      'crt_studio_FOUND TRUE'
    expect_components 'core;cheese' '' 'crt_FOUND 0' 'crt has no component cheese, but crt, static,'
    mapfile -t without < <(without embree TBB)
    expect_components 'crt' 'lang' 'crt_FOUND 1' 'crt_crt_FOUND TRUE' 'crt_lang_FOUND FALSE' \
      'the component lang of crt needs TBB, embree, not found here'
    expect_components 'crt;core' '' 'crt_FOUND 0' 'the component core of crt needs TBB, embree, not'
    exit
    ;;
  core)
    # README's recipe, where nothing is installed that the renderer alone does not need. It is not
    # optimized, and a folder is compiled as one source, which takes a fifth of the time.
    ! command -v ccache || export CMAKE_CXX_COMPILER_LAUNCHER=ccache
    cmake -S "$consumers/core" -B . -DCRT_SOURCE="$SOURCE" -DCRT_INSTALL=ON -DCRT_ISA=baseline \
      -DCMAKE_C_COMPILER="$CC" -DCMAKE_CXX_COMPILER="$CXX" -DCMAKE_BUILD_TYPE=None \
      -DCMAKE_UNITY_BUILD=ON "${without_features[@]}" >configure.log 2>&1 ||
      fail "$(cat configure.log)"
    cmake --build . -j 2 >build.log 2>&1 || fail "$(cat build.log)"
    env -i ./program "$PWD/program.png"
    expect_png program.png
    "$CC" -I "$moved/include" "$SOURCE/examples/check_picture.c" -o check_picture \
      -L "$moved/$LIBDIR" -lcrt
    LD_LIBRARY_PATH=$moved/$LIBDIR ./check_picture program.png || fail "others cannot read it"
    ./left_out
    ! readelf -d program lib/libcrt.so | grep -E 'NEEDED.*(fmt|libz|expat)' ||
      fail "they need libraries that were not asked for"
    # What is installed of that knows what it has.
    cmake --install . --prefix "$PWD/tree" >install.log || fail "$(cat install.log)"
    mkdir installed
    cd installed
    tree=$build/tree
    without=("${without_features[@]}")
    expect_components 'core;crt' 'lang' 'crt_FOUND 1' 'crt_core_FOUND TRUE' \
      'crt was built without the component lang \(CRT_WITH_LANG was OFF\)'
    expect_components 'core;studio;farm' '' 'crt_FOUND 0' \
      'without the component studio \(CRT_WITH_STUDIO was OFF\)' 'CRT_WITH_FARM was OFF'
    cmake -S "$consumers/core" -B . -DCMAKE_PREFIX_PATH="$tree" -DCMAKE_C_COMPILER="$CC" \
      -DCMAKE_CXX_COMPILER="$CXX" "${without[@]}" >configure.log 2>&1 ||
      fail "$(cat configure.log)"
    cmake --build . >build.log 2>&1 || fail "$(cat build.log)"
    ./program "$PWD/program.png"
    cmp program.png ../program.png || fail "not the same picture"
    ./left_out
    exit
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
    # A part brings what it needs, unless that is switched off.
    rm CMakeCache.txt
    cmake -S "$consumers/subdirectory" -B . -DCRT_SOURCE="$SOURCE" -DCRT_WITH_STUDIO=ON \
      -DCRT_WITH_SERVICE=OFF >configure.log 2>&1 && fail "CRT_WITH_SERVICE is not missed"
    grep -qF 'CRT_WITH_STUDIO is ON, and needs CRT_WITH_SERVICE, which is OFF' configure.log ||
      fail "$(cat configure.log)"
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

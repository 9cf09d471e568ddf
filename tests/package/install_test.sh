#!/usr/bin/env bash
# Installs CRT, moves the tree, and checks what is in it. The consumers use the moved tree.
# shellcheck source=tests/package/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

rm -rf "$WORK"
mkdir -p "$WORK"

# install_to PREFIX [ARGUMENT...] installs the build.
install_to() {
  local prefix=$1
  shift
  cmake --install "$BUILD" --prefix "$prefix" "$@" >"$WORK/install.log" ||
    fail "$(cat "$WORK/install.log")"
}

# files_in FOLDER prints all files and links, by name.
files_in() {
  (cd "$1" && find . ! -type d | sort)
}

install_to "$WORK/first"
mv "$WORK/first" "$moved"

DESTDIR=$WORK/staged install_to /opt/crt
diff -r "$moved" "$WORK/staged/opt/crt" || fail "what is installed depends on the prefix"

# The copyright files belong to packages, which are made of components one by one.
for component in runtime development command studio; do
  install_to "$WORK/component/$component" --component $component
  files_in "$WORK/component/$component"
done | grep -v '/copyright$' | sort >"$WORK/components.txt"
diff "$WORK/components.txt" <(files_in "$moved") ||
  fail "the components are not a partition of the whole"

# expect COMPONENT FILE... checks that the component has the files.
expect() {
  local file folder=$WORK/component/$1
  shift
  for file in "$@"; do
    [[ -e $folder/$file || -L $folder/$file ]] || fail "$file is not in $folder"
  done
}
expect runtime "$LIBDIR/libcrt.so.1" "$LIBDIR/crt/crt_image_files.so"
expect development include/crt/crt.h include/crt/crt.hpp "$LIBDIR/libcrt.so" \
  "$LIBDIR"/libcrt{,_core,_lang}.a share/doc/crt/LICENSE "$LIBDIR/pkgconfig/crt.pc" \
  "$LIBDIR/cmake/crt/crtConfig.cmake"
expect command bin/crt share/man/man1/crt.1 share/bash-completion/completions/crt \
  share/zsh/site-functions/_crt share/fish/vendor_completions.d/crt.fish
diff <(files_in "$SOURCE/include") <(files_in "$moved/include") ||
  fail "not the headers of the source"

[[ $(readlink "$moved/$LIBDIR/libcrt.so") == libcrt.so.1 ]] ||
  fail "libcrt.so is not a link to libcrt.so.1"
[[ $(readlink "$moved/$LIBDIR/libcrt.so.1") == libcrt.so.1.* ]] ||
  fail "libcrt.so.1 is not a link to the version"

for binary in "$moved/bin/crt" "$moved/$LIBDIR/libcrt.so" \
  "$moved/$LIBDIR/crt/crt_image_files.so"; do
  ! readelf -d "$binary" | grep -E 'R(UN)?PATH' || fail "$binary has a path to libraries"
done
# Debug information names the source files, which is what it is for.
[[ $BUILD_TYPE == *Deb* ]] || ! grep -rlF -e "$BUILD/" -e "$SOURCE/" "$moved" ||
  fail "they name folders of this build"

# README.md installs for a user alone.
line=$(grep -m 1 -oE '^cmake --install build/release [^#]*' "$SOURCE/README.md") ||
  fail "README.md installs nothing"
HOME=$WORK/home bash -euc "${line/build\/release/\"\$BUILD\"}" >"$WORK/install.log" ||
  fail "$(cat "$WORK/install.log")"
diff -r "$moved" "$WORK/home/.local" || fail "README.md installs something else"

# docs/installing.md has a table of what lies where.
row='^| [[:punct:]]\([^ ]*\)[[:punct:]] | [a-z]* |.*'
documented=$(sed -n "s/$row/\\1/p" "$SOURCE/docs/installing.md")
[[ $(wc -l <<<"$documented") -ge 10 ]] || fail "docs/installing.md has no table of files"
while IFS= read -r file; do
  [[ -e $moved/${file/#LIB\//$LIBDIR/} ]] ||
    fail "docs/installing.md names $file, which is not there"
done <<<"$documented"

# The command finds its module relative to itself.
cd "$WORK"
echo 'Scene { Sphere { center -> vec3(0, 0, 2) radius -> 1 } }' >sphere.crt
env -i "$moved/bin/crt" render sphere.crt -o sphere.jpg --width 64 --height 48 --quiet
[[ $(od -An -tx1 -N3 sphere.jpg | tr -d ' ') == ffd8ff ]] || fail "sphere.jpg is no JPEG file"

# This is what a build with BUILD_SHARED_LIBS=OFF installs.
cp -a "$moved" "$static_only"
rm "$static_only/$LIBDIR"/libcrt.so* "$static_only/$LIBDIR"/cmake/crt/crtShared*.cmake

#!/usr/bin/env bash
# Makes the Debian packages, checks what they have and ask for, unpacks them side by side, and runs
# the command and a consumer from there. With CRT_RELEASE in the environment, the packages are those
# in that folder, which are to be released.
# shellcheck source=tests/package/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
need dpkg-shlibdeps dpkg-dev
need file file
need pkg-config pkg-config

work=$WORK.debian
rm -rf "$work"
mkdir -p "$work/root"
cd "$work"
if [[ -n ${CRT_RELEASE:-} ]]; then
  cp "$CRT_RELEASE"/*.deb .
else
  cpack --config "$BUILD/CPackConfig.cmake" -B . >cpack.log 2>&1 || fail "$(cat cpack.log)"
  rm -r _CPack_Packages
fi
version=$(sed -nE 's/^project\(crt VERSION ([0-9.]+) .*/\1/p' "$SOURCE/CMakeLists.txt")

# package NAME prints its file, of which there is one.
package() {
  local files=("$1"_[0-9]*.deb)
  [[ ${#files[@]} -eq 1 && -f ${files[0]} ]] || fail "not one file of the package $1"
  echo "${files[0]}"
}

# expect_field PACKAGE FIELD REGEX... checks that the field has all of them.
expect_field() {
  local regex value
  value=$(dpkg-deb -f "$(package "$1")" "$2")
  for regex in "${@:3}"; do
    grep -qE "$regex" <<<"$value" || fail "the $2 of $1 have no $regex: $value"
  done
}

# expect_files PACKAGE REGEX... checks that each of its files matches one, and each matches some
# file.
expect_files() {
  local files regex
  files=$(dpkg-deb --fsys-tarfile "$(package "$1")" | tar -t | grep -v '/$')
  for regex in "${@:2}"; do
    grep -qxE "$regex" <<<"$files" || fail "$1 has no $regex"
  done
  ! grep -vxE "$(IFS='|' && echo "${*:2}")" <<<"$files" || fail "$1 was not to have these"
}

library=$(basename libcrt[0-9]*_*.deb)
library=${library%%_*}
major=${library#libcrt}
expect_field "$library" Depends 'libembree[34]-[34]' 'libtbb12' 'libc6' 'libstdc\+\+6'
# What is loaded when it is first needed is not asked for. OpenImageIO brings some 240 packages.
expect_field "$library" Recommends 'libfreetype6' 'libopenimageio'
for name in "$library" libcrt-dev crt crt-studio; do
  expect_field "$name" Version "^${version//./\\.}\$"
done
for name in "$library" crt crt-studio; do
  ! dpkg-deb -f "$(package "$name")" Depends | grep -E 'openimageio|freetype' ||
    fail "$name is not to depend on these"
done
expect_field libcrt-dev Depends "^$library \(= [0-9.]+\)$"
expect_field libcrt-dev Recommends libglm-dev libtbb-dev libembree-dev \
  zlib1g-dev libexpat1-dev
expect_field crt Depends "$library \(= [0-9.]+\)" 'libembree' 'libtbb12' 'libc6'
expect_field crt Suggests '^ffmpeg$'
expect_field crt-studio Depends "$library \(= [0-9.]+\)" '(^|, )crt \(= [0-9.]+\)' 'libembree'
expect_field "$library" Description '^ray tracer .*library'
expect_field libcrt-dev Description '^ray tracer .*development'
expect_field crt Description '^ray tracer .*command'
expect_field crt-studio Description '^ray tracer .*studio'
dpkg-deb -I "$(package "$library")" shlibs | grep -qE "^libcrt $major $library \(>= " ||
  fail "$library has no shlibs"
dpkg-deb -I "$(package "$library")" postinst | grep -q ldconfig ||
  fail "$library leaves ldconfig to others"

lib=\\./usr/$LIBDIR
doc=\\./usr/share/doc
expect_files "$library" "$lib/libcrt\\.so\\.$major(\\.[0-9.]+)?" "$lib/crt/crt_image_files\\.so" \
  "$doc/$library/copyright"
expect_files libcrt-dev '\./usr/include/crt/[a-z_]+\.(h|hpp)' \
  "$lib/libcrt(_core|_farm|_format|_lang|_service|_source|_studio|)\\.(so|a)" \
  "$lib/cmake/crt/.*\\.cmake" "$lib/pkgconfig/crt\\.pc" "$doc/crt/.*" "$doc/libcrt-dev/copyright"
expect_files crt '\./usr/bin/crt' '\./usr/share/man/man1/crt\.1' \
  '\./usr/share/bash-completion/completions/crt' '\./usr/share/zsh/site-functions/_crt' \
  '\./usr/share/fish/vendor_completions\.d/crt\.fish' "$doc/crt/copyright"
expect_files crt-studio '\./usr/bin/crt-studio' "$doc/crt-studio/copyright"

for deb in *.deb; do dpkg-deb -x "$deb" root; done
for binary in "root/usr/bin/crt" "root/usr/$LIBDIR/libcrt.so" \
  "root/usr/$LIBDIR/crt/crt_image_files.so" \
  "root/usr/$LIBDIR/libcrt.a"; do
  ! readelf -S "$binary" | grep -qF .debug_info || fail "$binary is not stripped"
done

echo 'Scene { Sphere { center -> vec3(0, 0, 2) radius -> 1 } }' >sphere.crt
env -i root/usr/bin/crt render sphere.crt -o sphere.png --width 64 --height 48 --quiet
expect_png sphere.png
[[ $(env -i root/usr/bin/crt --version) == "crt $version" ]] || fail "crt is not of $version"

export PKG_CONFIG_PATH=$work/root/usr/$LIBDIR/pkgconfig
# shellcheck disable=SC2046 # flags are words
"$CC" "$SOURCE/tests/package/consumers/c/program.c" -o program $(pkg-config --cflags --libs crt)
run_program LD_LIBRARY_PATH="$work/root/usr/$LIBDIR" ./program

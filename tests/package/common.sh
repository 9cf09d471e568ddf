# The tests of installing and packaging share this. They get these from CTest, in the environment:
#   BUILD, SOURCE  CRT's build tree and source
#   WORK           a folder for what they make
#   CC, CXX        the compilers that CRT was built with
#   LIBDIR         where libraries go, such as lib
#   BUILD_TYPE     such as Release
#   UNFIT          why this build cannot be installed and used by others, if so
# shellcheck shell=bash
# shellcheck source=tests/support/shell.sh
source "$SOURCE/tests/support/shell.sh"

moved=$WORK/moved             # the installed tree, not where it was installed to
static_only=$WORK/static_only # the same as a build without libcrt.so installs it

expect_png() {
  [[ $(od -An -tx1 -N8 "$1" | tr -d ' ') == 89504e470d0a1a0a ]] || fail "$1 is no PNG file"
}

# run_program COMMAND... has a consumer write program.png and program.tif in its folder, with an
# environment of its own. The second needs the module for image files.
run_program() {
  rm -f program.png program.tif
  env -u LD_LIBRARY_PATH "$@" "$PWD/program.png"
  expect_png program.png
  env -u LD_LIBRARY_PATH "$@" "$PWD/program.tif"
  [[ $(od -An -tx1 -N4 program.tif | tr -d ' ') == 49492a00 ]] || fail "program.tif is no TIFF file"
}

[[ -z ${UNFIT:-} ]] || skip "$UNFIT"

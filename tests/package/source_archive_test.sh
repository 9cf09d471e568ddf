#!/usr/bin/env bash
# Makes source archives of small repositories, as cmake/make-release.sh does of CRT: what is in
# them, that they have the same bytes wherever they are made, and what is refused.
# shellcheck source=tests/support/shell.sh
source "$SOURCE/tests/support/shell.sh"
need git git
need xz xz-utils

version=$(sed -nE 's/^project\(crt VERSION ([0-9.]+) .*/\1/p' "$SOURCE/CMakeLists.txt")
made=$WORK.archive
rm -rf "$made"
mkdir -p "$made/first/cmake"
cd "$made/first"

# Nothing of this machine's git is of any account.
export HOME=$made GIT_CONFIG_NOSYSTEM=1 GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a GIT_COMMITTER_NAME=a \
  GIT_COMMITTER_EMAIL=a
unset GIT_DIR GIT_WORK_TREE GIT_INDEX_FILE

commit() {
  git add --all
  git commit --quiet --message "$1"
}

# expect_refused REGEX checks that no archive is made, and that the message matches.
expect_refused() {
  local message
  ! message=$(cmake/make-release.sh archive "$made/refused" 2>&1) || fail "made, in spite of: $1"
  grep -qE "$1" <<<"$message" || fail "refused, but not for $1: $message"
  [[ ! -e $made/refused ]] || fail "refused for $1, and yet there is a folder"
}

cp "$SOURCE"/{CMakeLists.txt,CHANGELOG.md} .
cp "$SOURCE/cmake/make-release.sh" cmake
echo '/build/' >.gitignore
echo 'a name' >'with a space.txt'
expect_refused 'no checkout of git'
git init --quiet
commit "Begin"

echo >>CMakeLists.txt
expect_refused '^ M CMakeLists\.txt$'
git checkout --quiet CMakeLists.txt
echo >new.txt
expect_refused '^\?\? new\.txt$'
rm new.txt

archive=crt-$version.tar.xz
mkdir build
echo >build/made.txt # which git ignores
cmake/make-release.sh archive
(umask 077 && git clone --quiet . "$made/second" && cd "$made/second" &&
  git config tar.umask user && cmake/make-release.sh archive "$made/elsewhere")
cmp "build/release-$version/$archive" "$made/elsewhere/$archive" ||
  fail "one commit, and two archives"
files=$(tar -tJf "$made/elsewhere/$archive" | grep -v '/$' | LC_ALL=C sort)
diff <(printf "crt-$version/%s\n" .gitignore CHANGELOG.md CMakeLists.txt cmake/make-release.sh \
  'with a space.txt') - <<<"$files" || fail "not the files of the commit"
tar -xJf "$made/elsewhere/$archive" -C "$made"
[[ -x $made/crt-$version/cmake/make-release.sh ]] || fail "scripts are not executable"
grep -qF "project(crt VERSION $version " "$made/crt-$version/CMakeLists.txt" || fail "no version"

! cmake/make-release.sh archive "$made/elsewhere" 2>/dev/null ||
  fail "what was in the folder is overwritten"

git tag "v$version"
cmake/make-release.sh archive
sed -i "s/VERSION $version /VERSION 99.0.0 /" CMakeLists.txt
commit "Raise the version, and do not say what is new"
expect_refused "begin with '## 99\.0\.0', and begins with '## ${version//./\\.}'"
git tag v99.0.0 HEAD^
expect_refused '^v99\.0\.0 is the tag of another commit'

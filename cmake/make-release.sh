#!/usr/bin/env bash
# Makes what a release consists of, and checks it. Nothing is tagged or published.
#   make-release.sh archive [FOLDER]   makes the source archive alone
#   make-release.sh all [FOLDER]       makes the Debian packages, the Python wheel and SHA256SUMS,
#                                      too, from what is in the archive
# Without a FOLDER all goes into build/release-VERSION, which is made anew.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

fail() {
  printf '%s\n' "$@" >&2
  exit 1
}

verb=${1:-}
[[ $verb == archive || $verb == all ]] || fail "usage: make-release.sh archive|all [FOLDER]"

version=$(sed -nE 's/^project\(crt VERSION ([0-9]+\.[0-9]+\.[0-9]+) .*/\1/p' CMakeLists.txt)
[[ -n $version ]] || fail "project() of CMakeLists.txt has no version of three numbers."
name=crt-$version
tag=v$version

# What is released is a commit, the same for everybody.
[[ $(git rev-parse --show-toplevel 2>/dev/null) == "$PWD" ]] ||
  fail "$PWD is no checkout of git: a release is made of a commit."
changes=$(git status --porcelain --untracked-files=all)
[[ -z $changes ]] || fail "A release is made of a commit, and this is not committed:" "$changes"
commit=$(git rev-parse HEAD)
tagged=$(git rev-parse --quiet --verify "refs/tags/$tag^{commit}" || true)
[[ -z $tagged || $tagged == "$commit" ]] ||
  fail "$tag is the tag of another commit, ${tagged:0:8}: raise the version in CMakeLists.txt."
newest=$(grep -m 1 '^## ' CHANGELOG.md || true)
[[ $newest == "## $version" ]] ||
  fail "CHANGELOG.md has to begin with '## $version', and begins with '$newest'."

folder=build/release-$version
if (($# > 1)); then
  folder=$2
  [[ -z $(ls -A "$folder" 2>/dev/null) ]] || fail "$folder is not empty."
else
  rm -rf "$folder"
fi
mkdir -p "$folder"
folder=$(realpath "$folder")
archive=$folder/$name.tar.xz

# With one version of xz the bytes of the archive depend on the commit alone: git takes times from
# it, and modes and line ends are not left to how git is configured here.
git -c tar.umask=0022 -c core.autocrlf=false archive --format=tar --prefix="$name/" "$commit" |
  xz -9 --threads=1 >"$archive"
diff <(git ls-tree -r --name-only -z "$commit" | tr '\0' '\n' | sed "s|^|$name/|" | sort) \
  <(tar -tJf "$archive" | grep -v '/$' | sort) ||
  fail "The archive has other files than the commit."
[[ $verb == all ]] || exit 0

tests/house/check.sh

# The archive builds by itself, and what others get is made of what they find in it.
unpacked=build/from-archive
rm -rf "$unpacked"
mkdir -p "$unpacked"
tar -xJf "$archive" -C "$unpacked"
source=$unpacked/$name
"$source/dev" package
"$source/dev" wheel
cp "$source"/build/packages/*.deb "$source"/build/wheels/*.whl "$folder"

# These tests take the packages and the wheel that are in the folder. Skipped tests check nothing.
CRT_RELEASE=$folder ctest --test-dir "$source/build/release" --output-on-failure --no-tests=error \
  -R '^(install|installed_links|debian_packages|python_wheel)$' | tee "$unpacked/tests.log"
! grep -F '***Skipped' "$unpacked/tests.log" || fail "These tests are needed, and were skipped."

(cd "$folder" && sha256sum -- * >SHA256SUMS && sha256sum --quiet -c SHA256SUMS)
rm -rf "$unpacked"

echo "CRT $version is in $folder, made of commit ${commit:0:8}:"
cat "$folder/SHA256SUMS"
cat <<TEXT
Where .ci/run has passed at this commit, there remains, by hand:
  git tag -a $tag -m "CRT $version" $commit
  git push origin $tag
  and to publish these files beside the part "$version" of CHANGELOG.md.
TEXT

#!/usr/bin/env bash
# Every relative link of the documentation leads somewhere, in the installed tree and in the source.
# shellcheck source=tests/package/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
need python3 python3

installed=$moved/share/doc/crt
python3 "$SOURCE/tests/package/links.py" "$installed" || fail "links in the installed tree"
python3 "$SOURCE/tests/package/links.py" "$SOURCE"/{README,CHANGELOG,CONTRIBUTING}.md \
  "$SOURCE/docs" || fail "links in the source"

# The test sees a link that leads nowhere.
broken=$WORK/broken_links
mkdir -p "$broken"
echo '[gone](gone.md) [here](page.md#no-such-heading)' >"$broken/page.md"
! python3 "$SOURCE/tests/package/links.py" "$broken" 2>"$broken/complaints" ||
  fail "dead links were not seen"
[[ $(wc -l <"$broken/complaints") -eq 2 ]] ||
  fail "not both dead links: $(cat "$broken/complaints")"

#!/usr/bin/env bash
# Writes what libabigail sees of libcrt's interface. All builds of one interface give the same file.
# usage: dump.sh LIBRARY FILE
set -euo pipefail
abidw --headers-dir "$(dirname "${BASH_SOURCE[0]}")/../../include/crt" \
  --drop-private-types --exported-interfaces-only --no-elf-needed --no-corpus-path \
  --no-comp-dir-path --no-show-locs --type-id-style hash --out-file "$2" "$1"

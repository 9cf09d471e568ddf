#!/usr/bin/env bash
# Runs one fuzzer for a while, from its seeds and with its dictionary, if it has these. `./dev fuzz`
# runs all of them so:
#   run.sh FUZZER SECONDS
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

name=$(basename "$1")
seeds=()
[[ ! -d tests/fuzz/seeds/${name#fuzz_} ]] || seeds=("tests/fuzz/seeds/${name#fuzz_}")
[[ ! -f tests/fuzz/${name#fuzz_}.dict ]] || seeds+=("-dict=tests/fuzz/${name#fuzz_}.dict")
mkdir -p "build/corpus/$name"
"$1" -max_total_time="$2" -artifact_prefix="build/fuzz/findings/$name-" \
  -rss_limit_mb=4096 -timeout=20 -print_final_stats=1 "build/corpus/$name" "${seeds[@]}" 2>&1 |
  tail -n 25 | sed "s/^/$name: /"

#!/usr/bin/env bash
# Has jobs done by processes of this machine and by GNU parallel, and kills some of them. The merged
# files must be those of `crt render`. The argument is the command crt.
set -euo pipefail
crt=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

cat >film.crt <<'END'
Settings {
  width -> 64 height -> 48 supersampling -> 3
  camera -> Camera { position -> vec3(0, 1, -5) pointing -> vec3(0, 0, 0) }
}
Scene {
  Sphere { center -> vec3(t / 8 - 1, 0, 0) radius -> 1
           material -> Material { reflectivity -> 0.5 } }
  Sphere { center -> vec3(1, 0, 0) radius -> 1 }
}
END
"$crt" render film.crt --frames 1-12 -o 'whole_##.png' --reproducible --threads 1 -q

# check JOB compares the merged frames of a job.
check() {
  local number
  for number in $(seq -w 1 12); do
    cmp "whole_$number.png" "$1/film_00$number.png"
  done
}

"$crt" farm plan film.crt --frames 1-12 --tasks 17 -o local -q
"$crt" farm submit local --local --processes 3 -q
check local

# The frames of the script's Settings begin with 0.
sed 's/^Settings {/Settings { frames -> 3/' film.crt >short.crt
"$crt" farm plan short.crt --film --tasks 2 -o short -q
"$crt" farm submit short --local --processes 2 -q
"$crt" render short.crt --frames 2-2 -o 'alone_##.png' --reproducible -q
cmp alone_02.png short/short_0002.png
pictures=(short/*.png)
[[ ${#pictures[@]} == 3 ]]

# A job that is there is not done again, and one whose part is damaged is mended.
cp -r local cut
rm cut/*.png
truncate -s 1000 cut/parts/000003.part
if "$crt" farm merge cut -q 2>errors; then
  echo "a part cut short was merged" >&2
  exit 1
fi
grep -q '000003.part' errors
"$crt" farm submit cut --local -q
check cut

# One that is damaged in its middle is found by who works on all tasks, too.
printf 'x' | dd of=cut/parts/000002.part bs=1 seek=500 conv=notrunc status=none
rm cut/*.png
"$crt" farm work cut -q
"$crt" farm merge cut -q
check cut

# A full disk leaves no part, and says so.
if (
  ulimit -f 1
  trap '' XFSZ
  rm cut/parts/000003.part
  "$crt" farm work cut --task 3 -q 2>errors
); then
  echo "a part was written that had no room" >&2
  exit 1
fi
grep -q '000003.part' errors
[[ ! -e cut/parts/000003.part ]]

# A merge that is ended in its midst is repeated.
rm cut/*.png
"$crt" farm work cut --task 3 -q
timeout --signal=KILL 0.02 "$crt" farm merge cut -q || true
"$crt" farm merge cut -q
check cut

# Parts may come in while merging.
"$crt" farm plan film.crt --frames 1-12 --tasks 5 -o later -q
"$crt" farm merge later --follow -q &
for task in 4 2 0 1 3 2; do "$crt" farm work later --task "$task" -q; done
wait $!
check later

if ! command -v parallel >/dev/null; then
  echo "skipped the rest: GNU parallel is not installed" >&2
  exit 77
fi
"$crt" farm plan film.crt --frames 1-12 --tasks 9 -o parallel -q
"$crt" farm submit parallel --parallel -q
check parallel

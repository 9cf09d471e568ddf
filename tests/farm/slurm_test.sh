#!/usr/bin/env bash
# Has 240 small frames and one large poster of 64 tiles rendered by a Slurm of its own. Workers
# are killed, a node goes down and comes back, tasks run twice, and a part is cut short. The merged
# files must be those of `crt render` on one thread. The argument is the command crt.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
# shellcheck source=tests/farm/slurm.sh
. ./slurm.sh
crt=$1
missing=$(slurm_missing)
if [[ -n $missing ]]; then
  echo "skipped: $missing" >&2
  exit 77
fi
folder=$(mktemp -d)
killer=
end_trouble() {
  [[ -z $killer ]] || pkill -P "$killer" || true
  [[ -z $killer ]] || kill "$killer" 2>/dev/null || true
  killer=
}
trap 'end_trouble; stop_slurm; rm -rf "$folder"' EXIT
trap 'exit 1' INT TERM
cd "$folder"

cat >film.crt <<'END'
Settings {
  width -> 48 height -> 32 supersampling -> 2
  camera -> Camera { position -> vec3(0, 1, -5) pointing -> vec3(0, 0, 0) }
}
Scene {
  Sphere { center -> vec3(t / 120 - 1, 0, 0) radius -> 1
           material -> Material { reflectivity -> 0.5 } }
  Sphere { center -> vec3(1, 0, 0) radius -> 1 }
}
END
cat >poster.crt <<'END'
Settings {
  width -> 1024 height -> 1024 targeterror -> 0.01 maxsamples -> 64
  camera -> Camera { position -> vec3(0, 1, -5) pointing -> vec3(0, 0, 0) }
}
Scene {
  Sphere { center -> vec3(-1, 0, 0) radius -> 1
           material -> Material { transparency -> 0.8 refractiveindex -> 1.5 } }
  Sphere { center -> vec3(1, 0, 0) radius -> 1 material -> Material { reflectivity -> 0.5 } }
}
END
"$crt" render film.crt --frames 1-240 -o 'whole_###.png' --reproducible --threads 1 -q
"$crt" render poster.crt -o whole.png --reproducible --threads 1 -q
"$crt" farm plan film.crt --frames 1-240 --tasks 60 -o film -q
"$crt" farm plan poster.crt --tiles 128x128 --tasks 64 -o poster -q
"$crt" farm work film --task 7 -q # one part is there already, and not whole
truncate -s -9 film/parts/000007.part

if ! start_slurm "$folder/slurm"; then
  tail -n 5 slurm/*.log slurm/*.out >&2
  echo "Slurm did not start" >&2
  exit 1
fi

# This kills a fifth of the workers soon after they have begun, while a node goes down and comes
# back, and runs every twentieth task a second time.
trouble() {
  local victims=0 worker
  local -A seen=()
  while ((victims < 25)); do
    for worker in $(pgrep -f "farm work '?$folder/(film|poster)" || true); do
      [[ -z ${seen[$worker]:-} ]] || continue
      seen[$worker]=1
      ((${#seen[@]} % 5)) || { kill -KILL "$worker" 2>/dev/null && ((++victims)); } || true
    done
    sleep 0.02
  done &
  sleep 1
  scontrol update NodeName=node2 State=DOWN Reason=test
  for task in 0 20 40; do "$crt" farm work film --task "$task" -q; done
  for task in 3 23 43; do "$crt" farm work poster --task "$task" --threads 1 -q; done
  scontrol update NodeName=node2 State=RESUME 2>/dev/null || true # it may have come by itself
  # Slurm would have what ran there wait for two minutes.
  while sleep 0.3; do
    for job in $(squeue --noheader --states=PENDING --array --format=%A); do
      scontrol update JobId="$job" StartTime=now 2>/dev/null || true
    done
  done
}
trouble &
killer=$!
# Who is unlucky three times is submitted again.
for job in film poster; do
  "$crt" farm submit "$job" --slurm -q || "$crt" farm submit "$job" --slurm -q
done
end_trouble

for number in $(seq -w 1 240); do cmp "whole_$number.png" "film/film_0$number.png"; done
cmp whole.png poster/poster.png

# Without --no-wait it has followed the jobs. With it, a job behind the array merges.
"$crt" farm plan film.crt --frames 1-3 --tasks 3 -o later -q
"$crt" farm submit later --slurm --no-wait -q
for _ in $(seq 300); do
  [[ ! -e later/film_0003.png ]] || break
  sleep 0.1
done
until [[ -z $(squeue --noheader) ]]; do sleep 0.1; done
for number in 001 002 003; do cmp "whole_$number.png" "later/film_0$number.png"; done

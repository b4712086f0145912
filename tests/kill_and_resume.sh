#!/usr/bin/env bash
# Kills runs at random moments (SIGKILL), lets them go on, and compares all files with those of runs left alone:
#
#   bash tests/kill_and_resume.sh TRACE_PATH [TIMES [SEED]]
set -euo pipefail
program=$(realpath "${1:?the program}")
times=${2:-5}
RANDOM=${3:-$$}
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

# Decks of some tenths of a second: contact that slides, contact at nodes with all branches, frames, increments.
options=(--quiet --checkpoint-pause 0)
arguments() {
  case "$1" in
    channel) echo "$root/examples/channel.toml" ;;
    nodes) echo "$root/examples/channel.toml" --set 'contact.points="nodes"' --set 'path.branches="all"' ;;
    lee) echo "$root/examples/lee.toml" --set path.max_step=0.01 ;;
    increments) echo "$root/examples/foundation.toml" --set 'path.method="incremental"' --set path.step=0.005 --set 'path.land={lambda=[0.5]}' ;;
  esac
}
decks=(channel nodes lee increments)

declare -A milliseconds
for deck in "${decks[@]}"; do
  read -ra words < <(arguments "$deck")
  begin=$(date +%s%N)
  "$program" run "${words[@]}" "${options[@]}" --out "whole-$deck" 2>/dev/null
  milliseconds[$deck]=$((($(date +%s%N) - begin) / 1000000))
done

same=0
anew=0
ended=0
for ((k = 0; k < times; ++k)); do
  deck=${decks[$((k % ${#decks[@]}))]}
  read -ra words < <(arguments "$deck")
  rm -rf cut
  moment=$((RANDOM * ${milliseconds[$deck]} / 32768))
  "$program" run "${words[@]}" "${options[@]}" --out cut 2>/dev/null &
  child=$!
  sleep "$(printf '%d.%03d' $((moment / 1000)) $((moment % 1000)))"
  kill -KILL "$child" 2>/dev/null || ended=$((ended + 1))
  wait "$child" 2>/dev/null || true
  if [[ -e cut/checkpoint ]]; then
    "$program" resume cut "${options[@]}" 2>/dev/null
  else  # killed before the first point
    anew=$((anew + 1))
    "$program" run "${words[@]}" "${options[@]}" --out cut 2>/dev/null
  fi
  if diff -r --exclude=result.json "whole-$deck" cut; then same=$((same + 1)); fi
done
echo "$same of $times killed runs have the files of runs left alone ($anew begun anew, $ended had ended before)"
[[ $same == "$times" ]]

#!/usr/bin/env bash
# Kills runs at random moments (SIGKILL), lets them go on, and compares all files with those of runs left alone:
#
#   bash tests/kill_and_resume.sh TRACE_PATH [TIMES [SEED]]
#
# The seven kinds of runs take turns: with 5 times, which is what the tests do, the first five are killed once, with 200
# curves of events and sweeps some thirty times each, too.
set -euo pipefail
program=$(realpath "${1:?the program}")
times=${2:-5}
RANDOM=${3:-$$}
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

# Some tenths of a second each: contact that slides, contact at nodes with all branches, frames, increments, stages; a
# curve of events, which begins anew; and cases of a sweep.
kinds=(channel nodes lee increments stages curve sweep)
options=(--quiet --checkpoint-pause 0)
arguments() {
  case "$1" in
    channel) echo "$root/examples/channel.toml" ;;
    nodes) echo "$root/examples/channel.toml" --set 'contact.points="nodes"' --set 'path.branches="all"' ;;
    lee) echo "$root/examples/lee.toml" --set path.max_step=0.01 ;;
    increments) echo "$root/examples/foundation.toml" --set 'path.method="incremental"' --set path.step=0.005 --set 'path.land={lambda=[0.5]}' ;;
    stages) echo "$root/examples/harvester.toml" ;;
    curve) echo "$root/examples/channel.toml" --set member.column.elements=20 ;;
  esac
}

# begin KIND FOLDER: in a process of its own, which may be killed. Status 3 of a sweep: cases failed, which is a result.
begin() {
  local words
  read -ra words < <(arguments "$1")
  case "$1" in
    curve) exec "$program" curve "${words[@]}" --quiet --out "$2" ;;
    sweep) exec "$program" sweep run "$2" --quiet -- --set member.column.elements=10 ;;
    *) exec "$program" run "${words[@]}" "${options[@]}" --out "$2" ;;
  esac
}

prepare() {
  rm -rf "$2"
  if [[ $1 == sweep ]]; then "$program" sweep plan "$root/examples/sweep-channel.toml" --out "$2" >/dev/null; fi
}

# go_on KIND FOLDER: after a kill.
go_on() {
  case "$1" in
    sweep) (begin "$1" "$2") 2>/dev/null || [[ $? == 3 ]] ;;
    curve) [[ -e $2/curve.json ]] || (begin "$1" "$2") 2>/dev/null ;;
    *)
      if [[ -e $2/checkpoint ]]; then
        "$program" resume "$2" "${options[@]}" 2>/dev/null
      else # killed before the first point
        anew=$((anew + 1))
        (begin "$1" "$2") 2>/dev/null
      fi
      ;;
  esac
}

finish() {
  if [[ $1 == sweep ]]; then "$program" sweep collect "$2" >/dev/null; fi
}

# same KIND FOLDER: result.json has times, and cases of a sweep have them in their own.
same() {
  if [[ $1 == sweep ]]; then
    for file in cases.csv sweep.csv report.html; do cmp "whole-sweep/$file" "$2/$file" || return 1; done
    [[ -z $(find "$2/cases" -name '.*') ]]
  else
    diff -r --exclude=result.json "whole-$1" "$2"
  fi
}

declare -A milliseconds
for ((k = 0; k < times && k < ${#kinds[@]}; ++k)); do
  kind=${kinds[$k]}
  prepare "$kind" "whole-$kind"
  begin=$(date +%s%N)
  (begin "$kind" "whole-$kind") 2>/dev/null || [[ $kind == sweep && $? == 3 ]]
  milliseconds[$kind]=$((($(date +%s%N) - begin) / 1000000))
  finish "$kind" "whole-$kind"
done

alike=0
anew=0
ended=0
for ((k = 0; k < times; ++k)); do
  kind=${kinds[$((k % ${#kinds[@]}))]}
  prepare "$kind" cut
  moment=$((RANDOM * ${milliseconds[$kind]} / 32768))
  (begin "$kind" cut) 2>/dev/null &
  child=$!
  sleep "$(printf '%d.%03d' $((moment / 1000)) $((moment % 1000)))"
  kill -KILL "$child" 2>/dev/null || ended=$((ended + 1))
  wait "$child" 2>/dev/null || true
  go_on "$kind" cut
  finish "$kind" cut
  if same "$kind" cut; then alike=$((alike + 1)); else echo "not the same: $kind, killed after $moment ms" >&2; fi
done
echo "$alike of $times killed runs have the files of runs left alone ($anew begun anew, $ended had ended before)"
[[ $alike == "$times" ]]

#!/usr/bin/env bash
# Kills programs at random moments (SIGKILL), lets them go on, and compares all files with those of runs left alone:
#
#   bash tests/kill_and_resume.sh TRACE_PATH [TIMES [SEED]]
#
# Every one of the TIMES kills meets a process at work: one that has ended before is not counted, its time is taken for the
# time of its kind, and it is tried again. After every second kill the one that goes on is killed as well. The ten kinds take
# turns: with 5 kills, which is what the tests do, the first ones alone.
set -euo pipefail
program=$(realpath "${1:?the program}")
times=${2:-5}
RANDOM=${3:-$$}
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

# Some tenths of a second each: contact that slides, increments, stages, a curve of events, cases of a sweep in folders and in
# records, contact at nodes with all branches, frames, a search for other equilibria, and a sweep of curves.
kinds=(channel increments stages curve sweep records nodes lee search curves)
options=(--quiet --checkpoint-pause 0)
arguments() {
  case "$1" in
    channel) echo "$root/examples/channel.toml" ;;
    nodes) echo "$root/examples/channel.toml" --set 'contact.points="nodes"' --set 'path.branches="all"' ;;
    lee) echo "$root/examples/lee.toml" --set path.max_step=0.01 ;;
    increments) echo "$root/examples/foundation.toml" --set 'path.method="incremental"' --set path.step=0.005 --set 'path.output_at={lambda=[0.5]}' ;;
    stages) echo "$root/examples/harvester.toml" ;;
    curve) echo "$root/examples/channel.toml" --set member.column.elements=20 ;;
    search) echo "$root/examples/channel.toml" --set member.column.elements=20 --set path.search=true --set path.search_at=[6.5] --set path.search_guesses=2 ;;
  esac
}

# begin KIND FOLDER: in the process of the caller, which may be killed.
begin() {
  local words
  read -ra words < <(arguments "$1")
  case "$1" in
    curve) exec "$program" curve "${words[@]}" "${options[@]}" --out "$2" ;;
    sweep) exec "$program" sweep run "$2" --quiet -- --set member.column.elements=10 ;;
    records) exec "$program" sweep run "$2" --quiet --records -- --set member.column.elements=10 ;;
    curves) exec "$program" sweep run "$2" --quiet ;;
    *) exec "$program" run "${words[@]}" "${options[@]}" --out "$2" ;;
  esac
}

prepare() {
  rm -rf "$2"
  case "$1" in
    sweep | records) "$program" sweep plan "$root/examples/sweep-channel.toml" --out "$2" >/dev/null ;;
    curves)
      printf 'title = "Curves"\ndeck = "%s"\ncommand = "curve"\n[grid]\nmember.column.elements = [6, 8, 10]\n' \
        "$root/examples/channel.toml" >curves.toml
      "$program" sweep plan curves.toml --out "$2" >/dev/null
      ;;
  esac
}

# go_on KIND FOLDER: as begin, after a kill.
go_on() {
  case "$1" in
    sweep | records | curves) begin "$1" "$2" ;;
    *)
      if [[ ! -e $2/checkpoint ]]; then begin "$1" "$2"; fi # killed before the first point
      exec "$program" resume "$2" "${options[@]}"
      ;;
  esac
}

finish() {
  case "$1" in sweep | records | curves) "$program" sweep collect "$2" >/dev/null ;; esac
}

# same KIND FOLDER: result.json has times, and cases of a sweep have them in their own.
same() {
  case "$1" in
    sweep | records | curves)
      for file in cases.csv sweep.csv report.html; do cmp "whole-$1/$file" "$2/$file" || return 1; done
      if [[ -e whole-$1/curves.csv ]]; then cmp "whole-$1/curves.csv" "$2/curves.csv" || return 1; fi
      [[ -z $(find "$2" -name '.*' ! -name '.lock*') ]]
      ;;
    *) diff -r --exclude=result.json "whole-$1" "$2" ;;
  esac
}

# to_the_end WHAT KIND FOLDER: begin or go_on, in a process of its own. Status 3 of a sweep: cases failed, which is a result.
to_the_end() {
  local status=0
  ("$@") 2>/dev/null || status=$?
  [[ $status == 0 || ($status == 3 && $2 =~ ^(sweep|records|curves)$) ]] || echo "$* ended with status $status" >&2
}

now() { echo $((${EPOCHREALTIME/./} / 1000)); }

declare -A milliseconds at_work again anew quarters alike
# killed WHAT KIND FOLDER: whether the process was at work when the kill came, somewhere within the time of its kind.
killed() {
  local kind=$2 moment begin child status=0
  moment=$((RANDOM * ${milliseconds[$kind]} / 32768))
  begin=$(now)
  ("$@") 2>/dev/null &
  child=$!
  sleep "$(printf '%d.%03d' $((moment / 1000)) $((moment % 1000)))"
  kill -KILL "$child" 2>/dev/null || true
  wait "$child" 2>/dev/null || status=$?
  if [[ $status != 137 ]]; then
    local taken=$(($(now) - begin))
    if [[ $1 == begin && $taken -lt ${milliseconds[$kind]} ]]; then milliseconds[$kind]=$taken; fi
    return 1
  fi
  kills=$((kills + 1))
  at_work[$kind]=$((${at_work[$kind]:-0} + 1))
  local quarter=$((4 * moment / (${milliseconds[$kind]} + 1)))
  quarters[$quarter]=$((${quarters[$quarter]:-0} + 1))
}

kills=0 failed=0 ended=0 used=()
for ((k = 0; kills < times; ++k)); do
  kind=${kinds[$((k % ${#kinds[@]}))]}
  if [[ -z ${milliseconds[$kind]:-} ]]; then
    used+=("$kind")
    prepare "$kind" "whole-$kind"
    begin=$(now)
    to_the_end begin "$kind" "whole-$kind"
    milliseconds[$kind]=$(($(now) - begin))
    finish "$kind" "whole-$kind"
  fi
  until prepare "$kind" cut && killed begin "$kind" cut; do ended=$((ended + 1)); done
  if [[ ! -e cut/checkpoint && ! -e cut/cases.jsonl ]]; then anew[$kind]=$((${anew[$kind]:-0} + 1)); fi
  if (((k + k / ${#kinds[@]}) % 2 == 1 && kills < times)); then # of each kind every second time
    if killed go_on "$kind" cut; then again[$kind]=$((${again[$kind]:-0} + 1)); else ended=$((ended + 1)); fi
  fi
  to_the_end go_on "$kind" cut
  finish "$kind" cut
  if same "$kind" cut; then
    alike[$kind]=$((${alike[$kind]:-0} + 1))
  else
    echo "not the same: $kind, folder $k" >&2
    failed=$((failed + 1))
  fi
done

printf '%-12s %8s %18s %20s %8s %6s\n' kind 'ms whole' 'killed at work' 'of them going on' anew alike
for kind in "${used[@]}"; do
  printf '%-12s %8d %18d %20d %8d %6d\n' "$kind" "${milliseconds[$kind]}" "${at_work[$kind]}" "${again[$kind]:-0}" "${anew[$kind]:-0}" \
    "${alike[$kind]:-0}"
done
echo "$kills kills at work, ${quarters[0]:-0}, ${quarters[1]:-0}, ${quarters[2]:-0} and ${quarters[3]:-0} in the quarters of the time;" \
  "$ended others came after the end and are not counted; $failed folders are not those of runs left alone"
[[ $failed == 0 ]]

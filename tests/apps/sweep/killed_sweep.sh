#!/usr/bin/env bash
# Runs a sweep undisturbed, a second time killed twice and resumed, and a third time by GNU parallel where that is there:
#
#   bash killed_sweep.sh PROGRAM SWEEP.toml [options of run …]
#
# What `collect` writes must be the same to the byte, and the memory of the process that starts the cases must not grow.
set -euo pipefail

program=$1
sweep=$2
shift 2
options=("$@")
files=(cases.csv sweep.csv report.html)
scratch=$(mktemp -d)
runner=
trap '[[ -z $runner ]] || kill -KILL -- "-$runner" 2>/dev/null || true; rm -rf "$scratch"' EXIT
cd "$scratch"

fail() {
  echo "error: $1" >&2
  exit 1
}

# Status 3: cases failed, which is a result.
run() {
  local status=0
  "$program" sweep run "$1" --jobs 2 --quiet -- "${options[@]}" || status=$?
  [[ $status == 0 || $status == 3 ]] || fail "sweep run ended with status $status"
}

count() { find "$1/cases" -mindepth 1 -maxdepth 1 -name '[0-9]*' 2>/dev/null | wc -l; }

# Fails where the process is over.
resident_kb() { awk '/^VmRSS:/ { print $2; found = 1 } END { exit !found }' "/proc/$1/status" 2>/dev/null; }

# start_in_group DIR: the sweep in a process group of its own, whose number is in `runner`.
start_in_group() {
  setsid "$program" sweep run "$1" --jobs 2 --quiet -- "${options[@]}" &
  runner=$!
}

# These fail where the sweep was over first.
wait_for() {
  while [[ $(count "$1") -lt $2 ]]; do
    kill -0 "$runner" 2>/dev/null || return 1
    sleep 0.002
  done
}

kill_group() {
  kill -KILL -- "-$runner" 2>/dev/null || return 1
  wait "$runner" 2>/dev/null || true
  runner=
}

# kill_twice DIR: false if the sweep came to its end between two looks, as on a fast machine with other work.
kill_twice() {
  start_in_group "$1"
  wait_for "$1" $((cases / 20)) || return 1
  early=$(resident_kb "$runner") || return 1
  wait_for "$1" $((cases * 2 / 5)) || return 1
  late=$(resident_kb "$runner") || return 1
  kill_group || return 1
  first=$(count "$1")
  start_in_group "$1"
  local more=$((cases * 3 / 4))  # it may have come further than was waited for
  wait_for "$1" $((more > first ? more : first + 1)) || return 1
  kill_group || return 1
  second=$(count "$1")
  [[ $first -lt $second && $second -lt $cases ]]
}

# compare DIR WHAT
compare() {
  "$program" sweep collect "$1" >"$1.txt"
  for file in "${files[@]}"; do
    cmp "whole/$file" "$1/$file" && continue
    if [[ $file == *.csv ]]; then diff "whole/$file" "$1/$file" >&2 || true; fi
    fail "$file differs: $2"
  done
  [[ -z $(find "$1/cases" -name '.*') ]] || fail "something is left in $1/cases: $2"
}

"$program" sweep plan "$sweep" --out whole >/dev/null
cases=$(wc -l <whole/cases.jsonl)

SECONDS=0
run whole
"$program" sweep collect whole
echo "$cases cases undisturbed: $SECONDS s"

attempts=5
for ((attempt = 1; ; ++attempt)); do
  killed=killed-$attempt
  "$program" sweep plan "$sweep" --out "$killed" >/dev/null
  ! kill_twice "$killed" || break
  runner=
  [[ $attempt -lt $attempts ]] || fail "the sweep was not killed on its way, $attempts times"
done
run "$killed"
compare "$killed" "killed at $first and $second of $cases cases"
echo "killed at $first and $second cases, resumed: the same to the byte"
echo "resident memory of the parent: $early kB at a twentieth, $late kB at two fifths of the cases"
[[ $late -le $((early + 1024)) ]] || fail "the memory of the parent grows"

if command -v parallel >/dev/null; then
  "$program" sweep plan "$sweep" --out by-parallel >/dev/null
  "$program" sweep emit by-parallel --engine parallel --jobs 2 -- "${options[@]}" >by-parallel.sh
  # parallel tells how many of its jobs failed.
  sh by-parallel.sh 2>parallel.txt || true
  compare by-parallel "run by GNU parallel"
  echo "by GNU parallel: the same to the byte"
else
  echo "note: GNU parallel is not installed"
fi

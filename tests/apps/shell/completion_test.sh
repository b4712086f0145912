#!/usr/bin/env bash
# What bash proposes for command lines of trace-path: bash completion_test.sh trace-path.bash
set -uo pipefail

source "$1" || exit 1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch" || exit 1
mkdir 'my decks' study
touch channel.toml 'my decks/frame.toml' notes.txt

failures=0

# proposals WORD…: what is proposed for the last word, one a line, sorted.
proposals() {
  COMP_WORDS=("$@")
  COMP_CWORD=$(($# - 1))
  COMPREPLY=()
  _trace_path
  printf '%s\n' "${COMPREPLY[@]}" | sort
}

# expect LIST WORD…: exactly the words of LIST, which a comma parts.
expect() {
  local wanted found
  wanted=$(tr ',' '\n' <<<"$1" | sort)
  shift
  found=$(proposals "$@")
  if [[ $wanted != "$found" ]]; then
    printf 'for "%s"\nwanted: %s\nfound:  %s\n' "$*" "${wanted//$'\n'/, }" "${found//$'\n'/, }" >&2
    failures=$((failures + 1))
  fi
}

# expect_among WORD WORD…: the first word is one of what is proposed for the others.
expect_among() {
  local wanted=$1
  shift
  if ! proposals "$@" | grep -qxF -- "$wanted"; then
    printf 'for "%s"\nwanted among the proposals: %s\n' "$*" "$wanted" >&2
    failures=$((failures + 1))
  fi
}

expect 'run' trace-path ru
expect '--help' trace-path --h
expect_among 'channel.toml' trace-path ''
expect 'channel.toml' trace-path chan
expect '--max-points,--max-time' trace-path run channel.toml --max
expect 'channel.toml,my decks,study' trace-path run ''
expect 'my decks/frame.toml' trace-path run 'my decks/f'
expect 'my decks,study' trace-path run channel.toml --out ''
expect 'study' trace-path run channel.toml --out = stu
expect 'my decks,study' trace-path run channel.toml --out =
expect '' trace-path run channel.toml --max-points ''
expect '--quiet' trace-path channel.toml --qu
expect 'path.max_points=,path.max_step=' trace-path run channel.toml --set path.max
expect 'monitor.0.at=' trace-path run channel.toml --set path.step=0.1 --set monitor.0.a
expect 'material.' trace-path run channel.toml --set mat
expect 'channel' trace-path examples chan
expect 'sweep-channel' trace-path examples sw
expect 'channel.toml,my decks,notes.txt,study' trace-path examples channel --out ''
expect 'collect,emit,plan,run,status' trace-path sweep ''
expect 'plan' trace-path sweep pl
expect '--help' trace-path sweep --he
expect 'my decks,study' trace-path sweep run ''
expect '--jobs' trace-path sweep run study --jo
expect '--max-points,--max-time' trace-path sweep run study -- --max
expect 'parallel,slurm' trace-path sweep emit study --engine ''
expect 'slurm' trace-path sweep emit study --engine s
expect '' trace-path nonsense --ou

[[ $failures == 0 ]]

#!/usr/bin/env bash
# Builds the fuzz targets and runs each for some seconds (20), two at a time; fails on a finding:
#
#   bash tests/fuzz/run.sh [SECONDS] [deck_text] [deck_model] [deck_path] [checkpoint] [command_line]
#
# What is learned stays in build/sanitize/fuzz/TARGET, where the next run begins. For millions of runs add to the time:
# in a second of a core deck_text and checkpoint do some thousands, deck_model and command_line
# some hundreds, deck_path some tens.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

seconds=${1:-20}
shift || true
targets=("$@")
[[ ${#targets[@]} -gt 0 ]] || targets=(deck_text deck_model deck_path checkpoint command_line)

options_of() {
  case "$1" in
    deck_text) echo "-max_len=4500 -dict=build/sanitize/fuzz/deck.dict" ;;
    deck_model) echo "-max_len=100" ;;
    deck_path) echo "-max_len=200" ;;
    checkpoint) echo "-max_len=6000" ;;
    command_line) echo "-max_len=60 -len_control=0" ;;
    *)
      echo "tests/fuzz/run.sh: no target is called \"$1\"; there are deck_text, deck_model, deck_path, checkpoint and" \
        "command_line" >&2
      return 2
      ;;
  esac
}
for target in "${targets[@]}"; do options_of "$target" >/dev/null; done

bash tests/configure.sh --sanitize
folder=$PWD/build/sanitize  # command_line works in a folder of its own
cmake --build "$folder" --parallel 2 --target fuzz_seeds "${targets[@]/#/fuzz_}"
mkdir -p "$folder/fuzz/findings"
TMPDIR=$(mktemp -d)  # what a target leaves
export TMPDIR
trap 'rm -rf "$TMPDIR"' EXIT
"$folder/tests/fuzz/fuzz_seeds" "$folder/fuzz/seeds"
cat tests/fuzz/syntax.dict "$folder/fuzz/seeds/deck.dict" >"$folder/fuzz/deck.dict"

# Traces of allocations and memory that is long free cost half the time; whoever repeats a finding has them.
quick=detect_leaks=0:malloc_context_size=1:quarantine_size_mb=8:thread_local_quarantine_size_kb=256
export ASAN_OPTIONS=${ASAN_OPTIONS:-$quick}
fuzz() {
  local target=$1 options folders found log findings
  read -ra options < <(options_of "$target")
  log=$folder/fuzz/$target.log findings=$folder/fuzz/findings/$target-
  folders=("$folder/fuzz/$target")
  mkdir -p "${folders[0]}"
  if [[ -d $folder/fuzz/seeds/$target ]]; then folders+=("$folder/fuzz/seeds/$target"); fi
  if ! "$folder/tests/fuzz/fuzz_$target" "${options[@]}" -entropic=0 -print_funcs=0 -reload=0 -timeout=20 \
    -rss_limit_mb=1500 -malloc_limit_mb=256 -max_total_time="$seconds" -print_final_stats=1 \
    -artifact_prefix="$findings" "${folders[@]}" >"$log" 2>&1; then
    tail -n 60 "$log"
    mapfile -t found < <(ls -t "$findings"*)
    echo "error: $target has a finding; repeat it with" >&2
    echo "  ARCWALL_FUZZ_SHOW=1 $folder/tests/fuzz/fuzz_$target ${found[0]:-}" >&2
    return 1
  fi
  echo "$target: $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") runs without a finding"
}

# Two at a time: each takes a core.
status=0
for ((i = 0; i < ${#targets[@]}; ++i)); do
  if ((i >= 2)); then wait -n || status=1; fi
  fuzz "${targets[$i]}" &
done
while [[ -n $(jobs -p) ]]; do wait -n || status=1; done
exit "$status"

#!/usr/bin/env bash
# Builds the fuzz targets and runs each for some seconds (20); fails on a finding:
#
#   bash tests/fuzz/run.sh [SECONDS] [TARGET …]
#
# Targets: deck_text, deck_model. What is learned stays in build/sanitize/fuzz/TARGET and is where the next run begins.
# The build is that of `tests/run.sh --sanitize`.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

seconds=${1:-20}
shift || true
targets=("$@")
[[ ${#targets[@]} -gt 0 ]] || targets=(deck_text deck_model)

folder=build/sanitize
bash tests/configure.sh --sanitize
cmake --build "$folder" --parallel 2 --target fuzz_seeds "${targets[@]/#/fuzz_}"

options_of() {
  case "$1" in
    deck_text) echo "-max_len=6000 -dict=tests/fuzz/deck.dict" ;;
    deck_model) echo "-max_len=400" ;;
    *)
      echo "tests/fuzz/run.sh: no target is called \"$1\"; there are deck_text and deck_model" >&2
      return 2
      ;;
  esac
}

for target in "${targets[@]}"; do
  options=$(options_of "$target")
  corpus=$folder/fuzz/$target findings=$folder/fuzz/findings/$target-
  mkdir -p "$corpus" "$folder/fuzz/findings" "$folder/fuzz/seeds"
  "$folder/tests/fuzz/fuzz_seeds" "$folder/fuzz/seeds"
  echo "$target, $seconds s"
  # shellcheck disable=SC2086
  if ! "$folder/tests/fuzz/fuzz_$target" $options -timeout=10 -rss_limit_mb=1024 -malloc_limit_mb=256 \
    -max_total_time="$seconds" -print_final_stats=1 -artifact_prefix="$findings" "$corpus" "$folder/fuzz/seeds" \
    >"$folder/fuzz/$target.log" 2>&1; then
    tail -n 60 "$folder/fuzz/$target.log"
    echo "error: $target has a finding; repeat it with" >&2
    echo "  ARCWALL_FUZZ_SHOW=1 $folder/tests/fuzz/fuzz_$target $(ls -t "$findings"* | head -n 1)" >&2
    exit 1
  fi
  grep -E "stat::(number_of_executed_units|average_exec_per_sec)" "$folder/fuzz/$target.log"
done

#!/usr/bin/env bash
# Builds everything with warnings as errors and runs the tests:
#
#   bash tests/run.sh [--sanitize] [--long] [arguments of ctest …]
#
# --sanitize builds with clang and the address and undefined-behaviour sanitizers, in a folder of its own. --long also runs
# the long suite, which is for the night: more cases at random, more states, a sweep of 1000 cases.
# Examples: bash tests/run.sh -R Tracer; bash tests/run.sh -L python; bash tests/run.sh --sanitize -LE slow;
# bash tests/run.sh --long -L long
set -euo pipefail
export PATH  # bash has one where the environment has none; CMake finds its own files by it

cd "$(dirname "${BASH_SOURCE[0]}")/.."
folder=build/tests
build=()
suites=()
while [[ ${1:-} == --sanitize || ${1:-} == --long ]]; do
  case $1 in
    --sanitize) folder=build/sanitize build=(--sanitize) ;;
    --long) suites=(-C long) ;;
  esac
  shift
done

# Without a home ccache needs another place for its files.
if [[ -z ${HOME:-} ]]; then export CCACHE_DIR=${CCACHE_DIR:-$PWD/build/ccache}; fi
bash tests/configure.sh "${build[@]}"
cmake --build "$folder" --parallel 2

# LeakSanitizer stops other threads by ptrace, which containers may forbid.
leaks=1
if [[ $folder == build/sanitize ]]; then
  probe=$folder/leak_probe
  echo 'int main() {}' | clang++ -fsanitize=address -x c++ - -o "$probe"
  ASAN_OPTIONS=detect_leaks=1 "$probe" >/dev/null 2>&1 || leaks=0
  if [[ $leaks == 0 ]]; then echo "note: no ptrace here, so leaks are not looked for" >&2; fi
fi
export ASAN_OPTIONS=${ASAN_OPTIONS:-detect_leaks=$leaks}
export UBSAN_OPTIONS=${UBSAN_OPTIONS:-print_stacktrace=1}
# Three at a time on two cores: the browser and the killed programs wait more than they work.
exec ctest --test-dir "$folder" --output-on-failure -j3 "${suites[@]}" "$@"

#!/usr/bin/env bash
# Builds the benchmarks, runs them and writes what they measured:
#
#   bash benchmarks/run.sh [--quick] [--peers] [--skip REGEX]
#
# Figures go into build/benchmarks/performance.csv. The whole suite takes half an hour, most of it for 10⁶ unknowns, and
# writes docs/performance.md. --quick leaves the large sizes out, takes some minutes and writes
# build/benchmarks/performance.md. --peers installs and runs other programs beside; --skip leaves out what "case size"
# matches.
set -euo pipefail
export PATH  # bash has one where the environment has none; CMake finds its own files by it
cd "$(dirname "${BASH_SOURCE[0]}")/.."

folder=build/benchmarks
page=docs/performance.md
groups=(build benchmark)
options=("$@")
usage() {
  echo "usage: bash benchmarks/run.sh [--quick] [--peers] [--skip REGEX]" >&2
  exit 2
}
while [[ $# -gt 0 ]]; do
  case "$1" in
    --quick) page=$folder/performance.md ;;
    --peers) groups+=(peers) ;;
    --skip)
      [[ $# -ge 2 ]] || usage
      shift
      ;;
    *) usage ;;
  esac
  shift
done

bash cmake/install_debian_packages.sh "${groups[@]}"
launcher=()
if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
# Without a home ccache needs another place for its files.
if [[ -z ${HOME:-} ]]; then export CCACHE_DIR=${CCACHE_DIR:-$PWD/build/ccache}; fi
cmake -S . -B "$folder" -G Ninja --log-level=WARNING -DCMAKE_BUILD_TYPE=Release -DARCWALL_BUILD_APPS=ON \
  -DARCWALL_BUILD_TESTS=OFF -DARCWALL_BUILD_BENCHMARKS=ON -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=16 \
  "${launcher[@]}"
cmake --build "$folder" --parallel 2 --target trace-path benchmarks

python3 benchmarks/suite.py "$folder" "${options[@]}"
python3 docs/make_performance.py "$folder/performance.csv" >"$folder/page"
mv "$folder/page" "$page"
echo "the figures are in $folder/performance.csv and $page" >&2

#!/usr/bin/env bash
# Installs what the tests need and configures their build, with warnings as errors:
#
#   bash tests/configure.sh [--sanitize]
#
# --sanitize: with clang, the address and undefined-behaviour sanitizers, assertions and the fuzz targets, in
# build/sanitize; else in build/tests.
#
# A new folder compiles eight sources at a time, which halves the time of a whole build. Whoever changes one source after
# the other says `cmake -DCMAKE_UNITY_BUILD=OFF build/tests`, and that stays. clang finds that names of files which are
# compiled together shadow each other, so it may warn.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

folder=build/tests
groups=(build test report benchmark)
options=(-DCMAKE_BUILD_TYPE=Release -DARCWALL_WERROR=ON -DARCWALL_BUILD_BENCHMARKS=ON)
if [[ ${1:-} == --sanitize ]]; then
  folder=build/sanitize
  groups=(build test report sanitize)
  options=(-DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_COMPILER=clang++ -DARCWALL_SANITIZE=ON -DARCWALL_FUZZ=ON)
fi
[[ -f $folder/CMakeCache.txt ]] || options+=(-DCMAKE_UNITY_BUILD=ON)

bash cmake/install_debian_packages.sh "${groups[@]}"
if command -v ccache >/dev/null; then options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
cmake -S . -B "$folder" -G Ninja --log-level=WARNING -DARCWALL_BUILD_APPS=ON -DARCWALL_BUILD_TESTS=ON \
  "${options[@]}"

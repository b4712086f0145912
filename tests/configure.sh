#!/usr/bin/env bash
# Installs what the tests need and configures their build, with warnings as errors:
#
#   bash tests/configure.sh [--sanitize]
#
# --sanitize: with clang, the address and undefined-behaviour sanitizers, assertions and the fuzz targets, in
# build/sanitize; else in build/tests. There sources are compiled eight at a time, which halves the time; names of
# files shadow each other then, so warnings are left to the other build.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

folder=build/tests
groups=(build test report benchmark)
options=(-DCMAKE_BUILD_TYPE=Release -DARCWALL_WERROR=ON -DARCWALL_BUILD_BENCHMARKS=ON)
if [[ ${1:-} == --sanitize ]]; then
  folder=build/sanitize
  groups=(build test report sanitize)
  options=(-DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_COMPILER=clang++ -DARCWALL_SANITIZE=ON -DARCWALL_FUZZ=ON
    -DCMAKE_UNITY_BUILD=ON)
fi

bash cmake/install_debian_packages.sh "${groups[@]}"
if command -v ccache >/dev/null; then options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
cmake -S . -B "$folder" -G Ninja --log-level=WARNING -DARCWALL_BUILD_APPS=ON -DARCWALL_BUILD_TESTS=ON \
  "${options[@]}"

#!/usr/bin/env bash
# Installs a built tree into a prefix of its own and builds and runs the project beside this script against it:
#
#   bash tests/package/run.sh BUILD_FOLDER
set -euo pipefail

build=$(cd "${1:?the build folder}" && pwd)
cd "$(dirname "${BASH_SOURCE[0]}")"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

cmake --install "$build" --prefix "$scratch/prefix" >/dev/null
cmake -S . -B "$scratch/build" -G Ninja --log-level=WARNING -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$scratch/prefix"
cmake --build "$scratch/build"
"$scratch/build/limit_load"

#!/usr/bin/env bash
# Installs what the tests need and configures their build by a preset of CMakePresets.json:
#
#   bash tests/configure.sh [--sanitize]
#
# --sanitize: preset `sanitize` (clang, sanitizers, assertions, fuzz targets) in build/sanitize; else preset `tests`
# (warnings are errors) in build/tests.
#
# The presets compile up to sixteen sources at a time, which more than halves the time of a whole build. Whoever changes
# one source after the other says `cmake -DCMAKE_UNITY_BUILD=OFF build/tests`; a folder that exists keeps what it was
# told.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

preset=tests
groups=(build test python report benchmark)
if [[ ${1:-} == --sanitize ]]; then
  preset=sanitize
  groups=(build test python report sanitize)
fi

bash cmake/install_debian_packages.sh "${groups[@]}"
if [[ -f build/$preset/CMakeCache.txt ]]; then
  # One that was made before it had the Python module gets it.
  python=()
  if ! grep -q '^ARCWALL_PYTHON:.*=ON' "build/$preset/CMakeCache.txt"; then python=(-DARCWALL_PYTHON=ON); fi
  cmake --log-level=WARNING "${python[@]}" "build/$preset"
else
  cmake --preset "$preset" --log-level=WARNING
fi

#!/usr/bin/env bash
# A sweep of 1000 cases, undisturbed, killed twice and resumed, and by GNU parallel, with times and memory:
#
#   bash tests/long/sweep.sh BUILD_FOLDER
#
# Takes a few minutes, and is not part of tests/run.sh.
set -euo pipefail

build=$(cd "${1:?the build folder}" && pwd)
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
exec bash "$here/../apps/sweep/killed_sweep.sh" "$build/apps/trace-path" "$here/sweep.toml" --set member.column.elements=20

#!/usr/bin/env bash
# Builds trace-path and traces the channel example: bash apps/demo.sh [DIR]
#
# The results go into out/channel of the source folder, or into DIR.
set -euo pipefail
export PATH  # bash has one where the environment has none; CMake finds its own files by it

caller=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")/.."
out=out/channel
if [[ $# -gt 1 || ${1:-} == -* ]]; then
  echo "usage: bash apps/demo.sh [DIR]" >&2
  exit 2
fi
if [[ $# == 1 ]]; then
  case "$1" in
    /*) out=$1 ;;
    *) out=$caller/$1 ;;
  esac
fi

bash cmake/install_debian_packages.sh build
# Without a home ccache needs another place for its files.
if [[ -z ${HOME:-} ]]; then export CCACHE_DIR=${CCACHE_DIR:-$PWD/build/ccache}; fi

cmake --preset release --log-level=WARNING >&2
cmake --build build/release >&2

mkdir -p "$(dirname "$out")"
status=0
build/release/apps/trace-path run examples/channel.toml --out "$out" --force || status=$?

# 3 and 6: what was traced is written all the same.
if [[ $status == 0 || $status == 3 || $status == 6 ]]; then
  cat <<END

The results are in $out:
  report.html  open this in a browser: the curve, the events and the deformed shapes, to play and click
  events.txt   the table above: where the column touches the walls, snaps and lets go
  path.csv     one row a point; plot the column lambda (the load) over mid or over shortening
  events.json  the same events for programs
  deck.toml    the deck with every default written out
Try another:   build/release/apps/trace-path examples
END
fi
exit "$status"

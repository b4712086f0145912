#!/usr/bin/env bash
# Builds trace-path and traces the channel example: bash apps/demo.sh [--python] [DIR]
#
# The results go into out/channel of the source folder, or into DIR. --python: builds the Python package as well, and traces
# with that.
set -euo pipefail
export PATH  # bash has one where the environment has none; CMake finds its own files by it

caller=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")/.."
out=out/channel
python=OFF
groups=(build)
if [[ ${1:-} == --python ]]; then
  shift
  python=ON
  groups=(build python)
fi
if [[ $# -gt 1 || ${1:-} == -* ]]; then
  echo "usage: bash apps/demo.sh [--python] [DIR]" >&2
  exit 2
fi
if [[ $# == 1 ]]; then
  case "$1" in
    /*) out=$1 ;;
    *) out=$caller/$1 ;;
  esac
fi

bash cmake/install_debian_packages.sh "${groups[@]}"
# Without a home ccache needs another place for its files.
if [[ -z ${HOME:-} ]]; then export CCACHE_DIR=${CCACHE_DIR:-$PWD/build/ccache}; fi

cmake --preset release --log-level=WARNING -DARCWALL_PYTHON=$python >&2
cmake --build build/release >&2

mkdir -p "$(dirname "$out")"
status=0
if [[ $python == ON ]]; then
  export PYTHONPATH=$PWD/build/release/python/package
  interpreter=$(sed -n 's/^Python_EXECUTABLE:.*=//p' build/release/CMakeCache.txt)
  "${interpreter:-python3}" - "$out" <<'END' || status=$?
import sys
import arcwall
path = arcwall.Deck.load("examples/channel.toml").trace()
path.save(sys.argv[1], force=True)
print(path.events)
END
else
  build/release/apps/trace-path run examples/channel.toml --out "$out" --force || status=$?
fi

# 3 and 6: what was traced is written all the same.
if [[ $status == 0 || $status == 3 || $status == 6 ]]; then
  cat <<END

The results are in $out:
  report.html  open this in a browser: the curve, the events and the deformed shapes, to play and click
  events.txt   the table above: where the column touches the walls, snaps and lets go
  path.csv     one row a point; plot the column lambda (the load) over mid or over shortening
  events.json  the same events for programs
  branches.json   which states there are over the load, and what leads from one to another
  deck.toml    the deck with every default written out
Try another:   build/release/apps/trace-path examples
END
fi
if [[ $python == ON ]]; then
  cat <<END

The same in Python, where numpy, pandas and matplotlib are (docs/reference/python.md; notebooks in python/notebooks):
  export PYTHONPATH=$PYTHONPATH
  ${interpreter:-python3} -c 'import arcwall; print(arcwall.Deck.load("examples/channel.toml").trace().table)'
END
fi
exit "$status"

#!/usr/bin/env bash
# Runs the tests of the Python package under the address and undefined-behaviour sanitizers:
#
#   bash tests/python/sanitized.sh [arguments of pytest …]
#
# Without arguments all of them, which takes some minutes; `bash tests/run.sh --sanitize` runs those of hostile use.
# Needs what `bash tests/run.sh --sanitize` has built, and builds the module and the program if they are older than their
# sources.
#
# The interpreter is built without the sanitizer, whose runtime has to be loaded before all else, and libstdc++ behind it,
# whose exceptions it looks into. Python keeps memory until it ends, which is no leak of ours: these are not looked for.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

bash tests/configure.sh --sanitize >&2
cmake --build build/sanitize --parallel 2 --target arcwall_python trace-path >&2
runtime=$(clang++ -print-file-name="libclang_rt.asan-$(uname -m).so")
export PYTHONPATH=$PWD/build/sanitize/python/package PYTHONDONTWRITEBYTECODE=1 PYTHONMALLOC=malloc MPLBACKEND=Agg
export TRACE_PATH=$PWD/build/sanitize/apps/trace-path ARCWALL_SOURCE=$PWD
export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1
interpreter=$(sed -n 's/^Python_EXECUTABLE:.*=//p' build/sanitize/CMakeCache.txt)
[[ $# -gt 0 ]] || set -- tests/python
LD_PRELOAD="$runtime $(clang++ -print-file-name=libstdc++.so)" exec "${interpreter:-python3}" -m pytest -q -p no:cacheprovider "$@"

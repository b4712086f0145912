#!/usr/bin/env bash
# The code in docs/library.md is the code that event_detector_test.cpp compiles and runs.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)

in_docs=$(sed -n '/^```cpp$/,/^```$/p' "$root/docs/library.md" | sed '/^```/d')
in_test=$(sed -n '/\/\/ example begins$/,/\/\/ example ends$/p' "$root/tests/continuation/event_detector_test.cpp" |
  sed '/\/\/ example/d')
[[ -n $in_docs ]] || { echo "docs/library.md has no example"; exit 1; }
diff <(echo "$in_docs") <(echo "$in_test")

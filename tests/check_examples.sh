#!/usr/bin/env bash
# The C++ programs that pages show are compiled and run, and print what the pages say. For the build's use:
#
#   bash tests/check_examples.sh extract PAGE FOLDER     # writes them as 1.cpp, 2.cpp, … and what they print as 1.txt, …
#   bash tests/check_examples.sh run PROGRAM OUTPUT      # runs one where the examples' decks are, and compares
#
# A program is a block ```cpp; what it prints is the next block, ```text.
set -euo pipefail

case "$1" in
  extract)
    # Programs that are the same are left as they are, so that they are not compiled again.
    new="$(mktemp -d)" && trap 'rm -rf "$new"' EXIT
    awk -v folder="$new" '
      file != "" && /^```/ { close(file); file = ""; next }
      file != "" { print >file; next }
      /^```cpp$/ { file = folder "/" ++programs ".cpp" }
      /^```text$/ && programs > outputs { file = folder "/" ++outputs ".txt" }
      END { if (programs == 0 || programs != outputs) exit 1 }
    ' "$2" || { echo "$2 does not show a program and what it prints, as often as the other" >&2; exit 1; }
    diff -qr "$new" "$3" >/dev/null 2>&1 || { rm -rf "$3" && mkdir -p "$(dirname "$3")" && cp -r "$new" "$3"; }
    ;;
  run)
    cd "$(dirname "$0")/../examples"
    printed="$("$2")" # ends here where the program fails
    diff <(echo "$printed") "$3"
    ;;
esac

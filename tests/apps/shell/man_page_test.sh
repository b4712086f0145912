#!/usr/bin/env bash
# The man page is roff without a warning, and has every command and its options:
#
#   bash man_page_test.sh trace-path.1 PROGRAM
set -euo pipefail

page=$1
program=$2
warnings=$(groff -ww -man -Tutf8 "$page" 2>&1 >/dev/null)
[[ -z $warnings ]] || { echo "$warnings" >&2; exit 1; }

text=$(groff -man -Tascii -P-cbou "$page" | tr -s ' \n' ' ')
for command in run check resume report verify examples 'sweep plan' 'sweep run' 'sweep emit' 'sweep collect'; do
  [[ $text == *"trace-path $command "* ]] || { echo "no $command" >&2; exit 1; }
  # shellcheck disable=SC2086  # `sweep run` is two words
  "$program" $command --help | sed -n '/^  --\(help\|version\) /d; s/^  \(--[a-z-]*\).*/\1/p' | while read -r option; do
    [[ $text == *"$option "* ]] || { echo "no $option of $command" >&2; exit 1; }
  done
done

#!/usr/bin/env bash
# Makes docs/report.png, docs/sweep.png and docs/curve.png, the pictures of pages in README.md, docs/reference/sweep.md and
# docs/how-to: bash docs/make_screenshot.sh TRACE_PATH
#
# Needs chromium; the group report of cmake/install_debian_packages.sh has it.
set -euo pipefail

if [[ $# != 1 ]]; then
  echo "usage: bash docs/make_screenshot.sh TRACE_PATH" >&2
  exit 2
fi
trace_path=$(realpath "$1")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# picture NAME HEIGHT PAGE
picture() {
  chromium --headless=old --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking \
    --disable-component-update --disable-sync --user-data-dir="$work/profile" --hide-scrollbars --window-size="1280,$2" \
    --virtual-time-budget=5000 --screenshot="$PWD/docs/$1.png" "file://$work/$3" 2>/dev/null
}

"$trace_path" run examples/channel.toml --out "$work/channel" --quiet
picture report 1010 'channel/report.html#point=38'
"$trace_path" curve examples/channel.toml --out "$work/curve" --quiet
picture curve 900 curve/report.html
"$trace_path" sweep plan examples/sweep-channel.toml --out "$work/study" >/dev/null
"$trace_path" sweep run "$work/study" --quiet
"$trace_path" sweep collect "$work/study" >/dev/null
picture sweep 1130 study/report.html
ls -l docs/{report,curve,sweep}.png

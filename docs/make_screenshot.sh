#!/usr/bin/env bash
# Makes docs/report.png, the picture of report.html in README.md: bash docs/make_screenshot.sh TRACE_PATH
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

"$trace_path" run examples/channel.toml --out "$work/channel" --quiet
chromium --headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking \
  --disable-component-update --disable-sync --user-data-dir="$work/profile" --hide-scrollbars --window-size=1280,1010 \
  --virtual-time-budget=5000 --screenshot="$PWD/docs/report.png" "file://$work/channel/report.html#point=38" 2>/dev/null
ls -l docs/report.png

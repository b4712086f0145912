#!/usr/bin/env bash
# Makes docs/explore.png, docs/report.png, docs/sweep.png and docs/curve.png, the pictures of pages in README.md and the
# docs: bash docs/make_screenshot.sh TRACE_PATH
#
# Needs chromium and npm; the group report of cmake/install_debian_packages.sh has them.
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
"$trace_path" curve examples/channel.toml --out "$work/curve" --quiet
"$trace_path" sweep plan examples/sweep-channel.toml --out "$work/study" >/dev/null
"$trace_path" sweep run "$work/study" --quiet
"$trace_path" sweep collect "$work/study" >/dev/null
# The channel with a variable, which has a slider from the start.
sed 's/z = 0\.2 }/z = "gap \/ 2" }/; s/z = -0\.2 }/z = "-gap \/ 2" }/' examples/channel.toml >"$work/channel.toml"
printf '\n[variables]\ngap = 0.4\n' >>"$work/channel.toml"

docs=$PWD/docs
cp docs/pictures_of_pages.mjs tests/report/{package.json,package-lock.json,.npmrc} "$work"
cd "$work"
npm ci >/dev/null
node pictures_of_pages.mjs "$trace_path" "$docs"
ls -l "$docs"/{explore,report,curve,sweep}.png

#!/usr/bin/env bash
# Installs the package of the program in a bare Debian 12 and traces an example there:
#
#   bash tests/package/bare_debian.sh BUILD_FOLDER
#
# tests/package/run.sh has made the package. The bare system is made by mmdebstrap in a scratch folder, from the mirror of
# this machine, which takes a minute. Without root, mmdebstrap or a mirror it says so and tests nothing.
set -euo pipefail

build=$(cd "${1:?the build folder}" && pwd)
mapfile -t made < <(find "$build/packages" -maxdepth 1 -name 'arcwall_*.deb')
[[ ${#made[@]} == 1 ]] || { echo "error: $build/packages has no package arcwall; tests/package/run.sh makes it" >&2; exit 1; }
skip() {
  echo "note: the package is not tried in a bare Debian: $1"
  exit 0
}
[[ $(id -u) == 0 ]] || skip "that needs root"
command -v mmdebstrap >/dev/null || skip "there is no mmdebstrap"

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cp "${made[0]}" "$scratch/arcwall.deb"
mirror=$(sed -nE 's/^URIs: *([^ ]*debian)\/?$/\1/p; s/^deb (\[[^]]*\] )?(http[^ ]*debian)\/? .*/\2/p' \
  /etc/apt/sources.list /etc/apt/sources.list.d/* 2>/dev/null | head -1 || true)
mirror=${mirror:-http://deb.debian.org/debian}
curl --silent --fail --max-time 20 --output /dev/null "$mirror/dists/bookworm/Release" 2>/dev/null ||
  skip "$mirror cannot be reached"

# The packages that the program depends on come from the mirror, as for anybody who installs it.
trace='trace-path examples channel --out channel.toml && trace-path run channel.toml --out results --quiet &&
  trace-path verify results --quiet && grep -c limit-point results/events.txt'
mmdebstrap --quiet --variant=apt --mode=root \
  --customize-hook="copy-in '$scratch/arcwall.deb' /tmp" \
  --customize-hook='chroot "$1" apt-get install --quiet --yes /tmp/arcwall.deb >/dev/null' \
  --customize-hook="chroot \"\$1\" sh -c 'cd /srv && $trace'" \
  bookworm "$scratch/system" "$mirror"
[[ -e $scratch/system/srv/results/report.html ]]
echo "installed in a bare Debian 12, the program traces and verifies an example"

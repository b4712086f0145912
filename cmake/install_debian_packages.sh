#!/usr/bin/env bash
# Installs those Debian 12 packages of the named groups that are missing:
#
#   bash cmake/install_debian_packages.sh build [test] [python] [sanitize] [report] [format] [benchmark] [peers]
#
# report: a browser for the tests of report.html, and Node.js with npm if these commands are missing; npm also fetches
# plotly.js for the page. python: what the Python module is built with, used with and tested by. peers: other programs that
# benchmarks/run.sh can measure beside this one.
# Needs root or sudo only if something is missing. Works without HOME, USER and TERM.
set -euo pipefail

packages_of() {
  case "$1" in
    build)
      echo g++ cmake ninja-build libeigen3-dev libsuitesparse-dev libopenblas0-serial \
        libboost-dev libboost-program-options-dev libboost-math-dev libtomlplusplus-dev nlohmann-json3-dev libfmt-dev libpugixml-dev zlib1g-dev
      ;;
    test) echo libgtest-dev librapidcheck-dev python3 python3-meshio parallel groff-base dpkg-dev curl mmdebstrap ;;
    python)
      echo python3-dev pybind11-dev python3-numpy python3-pandas python3-matplotlib python3-scipy python3-pytest \
        python3-nbclient python3-ipykernel mypy
      ;;
    report)
      echo chromium
      command -v node >/dev/null || echo nodejs
      command -v npm >/dev/null || echo npm
      ;;
    sanitize) echo clang libclang-rt-14-dev ;;
    format) echo clang-format git ;;
    benchmark) echo libbenchmark-dev python3 ;;
    peers) echo auto-07p octave python3-scipy python3-getfem ;;
    *)
      echo "install_debian_packages.sh: no group of packages is called \"$1\"; there are build, test, python, sanitize, report," \
        "format, benchmark and peers" >&2
      return 2
      ;;
  esac
}

is_installed() {
  local status
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$1" 2>/dev/null) || return 1
  [[ $status == installed ]]
}

as_root() {
  if [[ $(id -u) == 0 ]]; then
    "$@"
  else
    sudo "$@"
  fi
}

if [[ $# == 0 ]]; then
  echo "usage: bash cmake/install_debian_packages.sh build [test] [python] [sanitize] [report] [format] [benchmark] [peers]" >&2
  exit 2
fi

if ! command -v dpkg-query >/dev/null; then
  echo "note: this is not a Debian system; install the libraries that README.md lists by yourself" >&2
  exit 0
fi

missing=()
for group in "$@"; do
  packages=$(packages_of "$group")
  for package in $packages; do
    is_installed "$package" || missing+=("$package")
  done
done
[[ ${#missing[@]} == 0 ]] && exit 0

if [[ $(id -u) != 0 ]] && ! command -v sudo >/dev/null; then
  echo "error: these packages are missing: ${missing[*]}" >&2
  echo "       neither root nor sudo is available to install them; have root run" >&2
  echo "       apt-get install --no-install-recommends ${missing[*]}" >&2
  exit 1
fi

# sbin holds what dpkg's maintainer scripts call; a bare environment may lack it.
export PATH="$PATH:/usr/local/sbin:/usr/sbin:/sbin"
echo "installing ${missing[*]}" >&2
as_root env DEBIAN_FRONTEND=noninteractive PATH="$PATH" apt-get update --quiet
as_root env DEBIAN_FRONTEND=noninteractive PATH="$PATH" \
  apt-get install --yes --quiet --no-install-recommends "${missing[@]}"

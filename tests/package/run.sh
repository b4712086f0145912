#!/usr/bin/env bash
# Builds and runs the project beside this script against what a built tree installs:
#
#   bash tests/package/run.sh BUILD_FOLDER
#
# On Debian that is what the packages hold, which are made, looked at and unpacked; elsewhere an installed tree.
set -euo pipefail

build=$(cd "${1:?the build folder}" && pwd)
cd "$(dirname "${BASH_SOURCE[0]}")"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# The Python module has a package of its own where it was built.
packages=(arcwall libarcwall-dev)
if grep -q '^ARCWALL_PYTHON:BOOL=ON' "$build/CMakeCache.txt"; then packages+=(python3-arcwall); fi

fail() {
  echo "error: $1" >&2
  exit 1
}

# has FILE: the unpacked packages have it, readable by all.
has() {
  [[ -e $scratch/root$1 ]] || fail "the packages have no $1"
}

# depends_on PACKAGE PATTERN
depends_on() {
  dpkg-deb --field "$scratch/$1.deb" Depends | grep -q -- "$2"
}

# depends PACKAGE ON
depends() {
  depends_on "$1" "$2" || fail "$1 does not depend on $2"
}

make_packages() {
  # Only the place of the libraries depends on the prefix; nothing is compiled again.
  cmake -S ../.. -B "$build" --log-level=WARNING -DCMAKE_INSTALL_PREFIX=/usr
  local targets=(trace-path shell_files arcwall_core arcwall_continuation arcwall_elements arcwall_contact arcwall_model
    arcwall_answers)
  if [[ " ${packages[*]} " == *" python3-arcwall "* ]]; then targets+=(arcwall_python); fi
  cmake --build "$build" --parallel 2 --target "${targets[@]}" >/dev/null
  rm -rf "$build/packages"
  cpack --config "$build/CPackConfig.cmake" >/dev/null
  local name
  for name in "${packages[@]}"; do
    cp "$build/packages/${name}"_*.deb "$scratch/$name.deb" || fail "there is no package $name"
    dpkg-deb --extract "$scratch/$name.deb" "$scratch/root"
    has "/usr/share/doc/$name/copyright"
    has "/usr/share/doc/$name/changelog.Debian.gz"
    gzip --test "$scratch/root/usr/share/doc/$name/changelog.Debian.gz"
  done
}

look_at_packages() {
  local libraries
  libraries=/usr/lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH)
  for file in /usr/bin/trace-path /usr/share/man/man1/trace-path.1.gz /usr/share/bash-completion/completions/trace-path \
    /usr/include/arcwall/core/system.hpp /usr/include/arcwall/answers/sessions.hpp /usr/include/arcwall/model/deck/reader.hpp \
    "$libraries/libarcwall_core.a" "$libraries/libarcwall_model.a" "$libraries/libarcwall_answers.a" "$libraries/cmake/arcwall/arcwallConfig.cmake"; do
    has "$file"
  done
  # All below /usr, owned by root, folders and programs 755, other files 644.
  for name in "${packages[@]}"; do
    dpkg-deb --contents "$scratch/$name.deb" | awk '
      $2 != "root/root" || ($1 != "drwxr-xr-x" && $1 != "-rw-r--r--" && !($1 == "-rwxr-xr-x" && $6 ~ "^./usr/bin/")) ||
      $6 !~ "^./usr/" || $6 ~ "^./usr/local" { print; wrong = 1 } END { exit wrong }' || fail "wrong owner, mode or place"
  done
  depends arcwall libc6
  # SuiteSparse is inside, or brings these.
  if grep -q '^ARCWALL_STATIC_LIBRARIES:BOOL=ON' "$build/CMakeCache.txt"; then
    for name in libblas3 liblapack3 libmetis5; do depends arcwall "$name"; done
    if depends_on arcwall 'libcholmod\|libumfpack\|libstdc++'; then fail "arcwall depends on libraries that it has inside"; fi
  else
    depends arcwall libcholmod3
    depends arcwall libumfpack5
  fi
  dpkg-deb --field "$scratch/arcwall.deb" Recommends | grep -qF libopenblas0 || fail "arcwall does not recommend OpenBLAS"
  depends libarcwall-dev libsuitesparse-dev
  depends libarcwall-dev libeigen3-dev
  depends libarcwall-dev zlib1g-dev
  "$scratch/root/usr/bin/trace-path" --version
  [[ " ${packages[*]} " == *" python3-arcwall "* ]] || return 0
  depends python3-arcwall python3-numpy
  depends python3-arcwall libcholmod3
  (cd / && PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$scratch/root/usr/lib/python3/dist-packages /usr/bin/python3 -c \
    'import arcwall; print("arcwall for Python", arcwall.__version__)')
}

if command -v dpkg-deb >/dev/null; then
  make_packages
  look_at_packages
  prefix=$scratch/root/usr
else
  prefix=$scratch/prefix
  cmake --install "$build" --prefix "$prefix" >/dev/null
fi
bash ../check_examples.sh extract ../../docs/reference/library.md "$scratch/examples"
cmake -S . -B "$scratch/build" -G Ninja --log-level=WARNING -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$prefix" \
  -DRUN_DECK="$scratch/examples/1.cpp"
cmake --build "$scratch/build"
"$scratch/build/limit_load"
bash ../check_examples.sh run "$scratch/build/run_deck" "$scratch/examples/1.txt"

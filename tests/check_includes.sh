#!/usr/bin/env bash
# Checks the star of the libraries in the sources' #include lines, and that libraries neither print nor exit.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

failures=0
fail() {
  echo "$1" >&2
  failures=$((failures + 1))
}

# check FOLDER ALLOWED…: files of FOLDER include project headers of the allowed folders only.
check() {
  local folder=$1 line
  shift
  local allowed
  allowed=$(IFS='|' && echo "$*")
  while IFS= read -r line; do
    fail "$line   (of this project, $folder may include $* only)"
  done < <(grep -rnE --include='*.[ch]pp' '^[[:space:]]*#[[:space:]]*include[[:space:]]*["<](\.\./)*(arcwall/)?(core|continuation|elements|contact|apps|tests|benchmarks)/' "$folder" |
    grep -vE "#[[:space:]]*include[[:space:]]*\"($allowed)/" || true)
  # A name without a folder, or a way up, would hide where the header is.
  while IFS= read -r line; do
    fail "$line   (write the header's folder: \"$folder/…\")"
  done < <(grep -rnE --include='*.[ch]pp' '^[[:space:]]*#[[:space:]]*include[[:space:]]*"([^/"]*"|[^"]*\.\.)' "$folder" || true)
  while IFS= read -r line; do
    fail "$line   (libraries return; they do not print or exit)"
  done < <(grep -rnE --include='*.[ch]pp' \
    'std::(cout|cerr|clog)|\b(printf|fprintf|puts|fputs|putchar)[[:space:]]*\(|\b(exit|_Exit|quick_exit|abort)[[:space:]]*\(|#[[:space:]]*include[[:space:]]*<iostream>' \
    "$folder" || true)
}

check core core
check continuation core continuation
check elements core elements
check contact core contact

# Which factorization is taken, and how it works, is core/algebra's own matter: others see its interfaces alone.
while IFS= read -r line; do
  fail "$line   (only core, tests and benchmarks may include core/algebra/solvers and core/algebra/block_tridiagonal)"
done < <(grep -rnE --include='*.[ch]pp' '^#include "core/algebra/(solvers|block_tridiagonal)/' continuation elements contact apps || true)

# What an installed header includes is installed, too: the headers that a library lists, with their folders inside it.
installed_headers() {
  sed -n '/HEADERS/,/)/p' "$1/CMakeLists.txt" | sed 's/.*HEADERS//' | grep -oE '[a-z0-9_/]+\.hpp' | sed "s|^|$1/|"
}
installed=$(for library in core continuation elements contact; do installed_headers "$library"; done)
while IFS=: read -r file _ line; do
  header=$(sed -E 's/.*"([^"]*)".*/\1/' <<< "$line")
  grep -qxF "$header" <<< "$installed" ||
    fail "$file includes $header, which ${header%%/*}/CMakeLists.txt does not list among its HEADERS"
done < <(grep -nE '^#include "(core|continuation|elements|contact)/' $installed)

if [[ $failures -gt 0 ]]; then
  echo "$failures lines break the star" >&2
  exit 1
fi
echo "continuation, elements and contact use core alone; no library prints or exits"

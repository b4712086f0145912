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
  done < <(grep -rnE --include='*.[ch]pp' '^[[:space:]]*#[[:space:]]*include[[:space:]]*["<](\.\./)*(arcwall/)?(core|continuation|elements|contact|model|answers|apps|tests|benchmarks)/' "$folder" |
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

check model core continuation elements contact model
check answers core continuation elements contact model answers

# Which factorization is taken, and how it works, is core/algebra's own matter: others see its interfaces alone.
while IFS= read -r line; do
  fail "$line   (only core, tests and benchmarks may include core/algebra/solvers and core/algebra/block_tridiagonal)"
done < <(grep -rnE --include='*.[ch]pp' '^#include "core/algebra/(solvers|block_tridiagonal)/' continuation elements contact model answers apps || true)

# Contact that slides is made in a room of its own, of which others see the layout alone.
while IFS= read -r line; do
  fail "$line   (only contact may include contact/sliding; others may include its layout.hpp)"
done < <(grep -rnE --include='*.[ch]pp' '^#include "contact/sliding/' continuation elements model answers apps |
  grep -v '"contact/sliding/layout.hpp"' || true)

# What an element is checked by is not the element: verify has energies of its own.
while IFS= read -r line; do
  fail "$line   (apps/verify evaluates no element: strain_energy.hpp and line_energy.hpp have energies of its own)"
done < <(grep -rnE --include='*.[ch]pp' '\b(ClassicBeam|ElasticaBeam|ReissnerBeam|EssenburgBeam|EssenburgElement|Truss|HeatedBeam|StretchLoad|StretchFoundation|CubicAxis|BeamPressure|ExactPressure|element_energy)\b|structure\(\)\.energy' apps/verify || true)

# installed LIBRARY: its headers that are installed, with their folders inside it.
installed() {
  sed -n '/HEADERS/,/)/p' "$1/CMakeLists.txt" | sed 's/.*HEADERS//' | grep -oE '[a-z0-9_/]+\.hpp' | sed "s|^|$1/|"
}

# What an installed header includes is installed, too; and users need neither TOML nor JSON headers.
for library in core continuation elements contact model answers; do
  for header in $(installed "$library"); do
    while IFS= read -r included; do
      installed "${included%%/*}" | grep -qxF "$included" ||
        fail "$header includes $included, which ${included%%/*}/CMakeLists.txt does not list among its HEADERS"
    done < <(sed -nE 's/^#include "((core|continuation|elements|contact|model|answers)\/[^"]*)".*/\1/p' "$header")
    ! grep -nE '^#include <(toml\+\+|nlohmann|fmt|zlib)' "$header" || fail "$header shows what the library is made with"
  done
done

# Inside the model and the program folders form no cycles: what FOLDER/SUBFOLDER includes of FOLDER, as a graph. A file
# beside the subfolders belongs to FOLDER itself; in the program, where main() stands there, each is by itself.
check_no_cycles() {
  local folder=$1 loop
  loop=$(grep -rnE --include='*.[ch]pp' "^#include \"$folder/" "$folder" |
    sed -E 's|^([^:]*):[0-9]+:#include "([^"]*)".*|\1 \2|' |
    if [[ $folder == apps ]]; then cat; else sed -E "s#(^| )$folder/[^/ ]*\\.[ch]pp#\1$folder/.#g"; fi |
    sed -E "s#($folder/[^/ ]+)/[^ ]*#\1#g" | awk '$1 != $2' | sort -u | tsort 2>&1 >/dev/null || true)
  [[ -z $loop ]] || fail "the folders of $folder include each other in a circle: $(echo $loop)"
}

check_no_cycles model
check_no_cycles answers
check_no_cycles apps

if [[ $failures -gt 0 ]]; then
  echo "$failures lines break the star" >&2
  exit 1
fi
echo "continuation, elements and contact use core alone, the model uses these, answers the model; no library prints or exits; no circles"

#!/usr/bin/env bash
# Checks that the files and folders which pages name are there, and that links between pages lead somewhere.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

failures=0
fail() {
  echo "$1" >&2
  failures=$((failures + 1))
}

folders='answers|apps|benchmarks|cmake|contact|continuation|core|docs|elements|examples|model|python|tests'
# A page without its blocks of code.
text_of() { awk '/^ *```/ { code = !code; next } !code' "$1"; }

for page in README.md CHANGELOG.md docs/*.md docs/*/*.md core/algebra/*/README.md; do
  while IFS= read -r name; do
    [[ -e ${name%/} ]] || fail "$page names $name, which is not there"
  done < <(grep -oE "\`($folders)/[A-Za-z0-9_./-]*\`" <(text_of "$page") | tr -d '`' | sort -u || true)
  while IFS= read -r link; do
    [[ -e $(dirname "$page")/$link ]] || fail "$page links to $link, which is not there"
  done < <(grep -oE '\]\([^):#]+[)#]' <(text_of "$page") | sed -E 's/^\]\(//; s/[)#]$//' | sort -u || true)
done

[[ $failures == 0 ]] || exit 1
echo "pages name files that are there"

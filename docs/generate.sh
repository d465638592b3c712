#!/usr/bin/env bash
# Writes the pages of docs/ that are made from the program: generate.sh [GMSIM] [FOLDER].
# `generate.sh GMSIM --check` says which pages are out of date instead.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
gmsim="${1:-$here/../build/release/gmsim}"
target="${2:-$here}"
[ "$target" = --check ] && target="$(mktemp -d)" && trap 'rm -rf "$target"' EXIT

"$gmsim" list diagnostics --markdown > "$target/diagnostics.md"
{
  for what in rules operations interactions criteria families embeddings functions patterns; do
    "$gmsim" list "$what" --markdown
    echo
  done
} > "$target/stdlib.md"
"$gmsim" list builtins --markdown > "$target/builtins.md"
"$gmsim" list scene --markdown > "$target/scenes.md"

if [ "${2:-}" = --check ]; then
  status=0
  for page in diagnostics stdlib builtins scenes; do
    cmp -s "$target/$page.md" "$here/$page.md" || { echo "docs/$page.md is out of date: run docs/generate.sh"; status=1; }
  done
  exit $status
fi

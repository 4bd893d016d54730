#!/usr/bin/env bash
# No source file is longer than 400 lines, no test longer than 600 (CONTRIBUTING.md, rule 10).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

git ls-files -- '*.cpp' '*.hpp' '*.inl' '*.idl' | while read -r file; do
    limit=400
    [[ $file != tests/* ]] || limit=600
    lines=$(wc -l <"$file")
    ((lines <= limit)) || echo "$file: $lines lines, at most $limit"
done | tee /dev/stderr | (! grep -q .)

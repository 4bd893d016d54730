#!/usr/bin/env bash
# Every hard case that is not struck has a test of its name, and every mutation names a test that there is.
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}"

names=$(grep -rhoE '^(TEST|TEST_F|TEST_P|TYPED_TEST|TYPED_TEST_P)\([A-Za-z0-9_]+, *[A-Za-z0-9_]+' --include='*_test.cpp' . |
    sed -E 's/^[A-Z_]+\(//; s/, */./')

{
    awk '/^\[/ { name = substr($0, 2, 3); tested[name] = 1 } /^struck/ { delete tested[name] }
         END { for (name in tested) print name }' stability/cases/*.toml | sort | while read -r case; do
        grep --quiet -F ".${case}_" <<<"$names" || echo "hard case $case: no test is named by it, and it is not struck"
    done
    # Of a filter of Google Test, each part without its instance and parameter, and a star for any text.
    sed -n 's/^test  *[^ ]*  *//p' mutations/mutations.txt | tr ':' '\n' | while read -r test; do
        plain=$(sed -E 's|^[^.*]*/([^./]*\.)|\1|; s|([^.])/[^.]*$|\1|; s|\*|.*|g' <<<"$test")
        grep --quiet -E "$plain" <<<"$names" || echo "mutation: there is no test $test"
    done
} | tee /dev/stderr | (! grep -q .)

#!/usr/bin/env bash
# Breaks the code in the places of mutations.txt, one at a time, and runs the test that has to notice. In a copy
# of the tree, build/mutations. Slow: by hand, ./dev mutations.
set -euo pipefail

usage() {
    cat <<END
usage: run.sh [--in DIR] [WORD]

Prints for each place what was broken, the test that is to catch it, and whether it does.
  --in DIR   the copy of the tree; default build/mutations
  WORD       only those mutations in whose file or description it is
Exit codes: 0 all are caught, 1 one survives, does not apply or does not build, 2 wrong usage.
END
}

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
copy=$root/build/mutations
word=
while (($# > 0)); do
    case $1 in
        --in)
            (($# > 1)) || { usage >&2 && exit 2; }
            copy=$2
            shift
            ;;
        -h | --help) usage && exit ;;
        -*) usage >&2 && exit 2 ;;
        *) word=$1 ;;
    esac
    shift
done
[[ ! $copy -ef $root ]] || { echo "run.sh: --in the tree itself; name another folder" >&2 && exit 2; }

# Only what differs, so that the rest need not be built again. What is copied is newer than what was built of it.
refresh() {
    local file
    mkdir -p "$copy"
    (cd "$root" && git ls-files -z) | while IFS= read -r -d '' file; do
        [[ -f $root/$file ]] || continue
        cmp --silent "$root/$file" "$copy/$file" && continue
        mkdir -p "$(dirname "$copy/$file")"
        cp "$root/$file" "$copy/$file"
    done
}

build() {
    ninja -C "$copy/build/release" ${SLOD_MUTATION_JOBS:+-j "$SLOD_MUTATION_JOBS"} "$@" >"$copy/build/mutations.log" 2>&1
}

# run PROGRAM TESTS
run() {
    (cd "$copy" && timeout 600 "build/release/bin/$1" --gtest_filter="$2" >"$copy/build/mutations.log" 2>&1)
}

# any PROGRAM TESTS: whether there are such
any() {
    "$copy/build/release/bin/$1" --gtest_list_tests --gtest_filter="$2" | grep '^  ' >/dev/null
}

# Of one paragraph: file, broken, from, to, program and tests; each line is a key and what follows it.
declare -A mutation
mutations=()
file="" broken="" from="" to=""
while IFS= read -r line; do
    value=${line#* }
    value=${value#"${value%%[! ]*}"}
    case $line in
        'file '*) file=$value ;;
        'broken '*) broken=$value ;;
        'from '*) from=$value ;;
        'to '*) to=$value ;;
        'test '*)
            [[ -z $word || "$file $broken" == *"$word"* ]] || continue
            id=${#mutations[@]}
            mutations+=("$id")
            mutation[$id.file]=$file mutation[$id.broken]=$broken mutation[$id.from]=$from mutation[$id.to]=$to
            mutation[$id.program]=${value%% *} mutation[$id.tests]=${value#* }
            ;;
        '' | '#'*) ;;
        *) echo "run.sh: mutations.txt has a line of no known key: $line" >&2 && exit 2 ;;
    esac
done <"$here/mutations.txt"
((${#mutations[@]} > 0)) || { echo "run.sh: no mutation has \"$word\" in its file or description" >&2 && exit 2; }

# Says on one line what became of mutation $1; fails unless it was caught.
try() {
    local file=${mutation[$1.file]} from=${mutation[$1.from]} to=${mutation[$1.to]} text rest
    local program=${mutation[$1.program]} tests=${mutation[$1.tests]}
    text=$(cat "$root/$file" && echo .)
    text=${text%.}
    rest=${text#*"$from"}
    if [[ $rest == "$text" || $rest == *"$from"* ]]; then
        echo "DOES NOT APPLY: the text is not there just once; renew the mutation"
        return 1
    fi
    if ! build "$program" || ! any "$program" "$tests" || ! run "$program" "$tests"; then
        echo "NO TEST: it is missing, or fails without it; see $copy/build/mutations.log"
        return 1
    fi
    printf '%s' "${text%%"$from"*}$to$rest" >"$copy/$file"
    local found=caught
    if ! build "$program"; then
        found="DOES NOT BUILD; see $copy/build/mutations.log"
    elif run "$program" "$tests"; then
        found=SURVIVED
    fi
    cp "$root/$file" "$copy/$file"
    echo "$found"
    [[ $found == caught ]]
}

refresh
[[ -f $copy/build/release/build.ninja ]] || (cd "$copy" && cmake --preset release --log-level=WARNING)
wrong=0
for id in "${mutations[@]}"; do
    result=$(try "$id") || wrong=$((wrong + 1))
    printf '%-38s %s\n%38s by %s\n%38s %s\n' "${mutation[$id.file]}" "${mutation[$id.broken]}" "" \
        "${mutation[$id.tests]}" "" "$result"
done
echo "$((${#mutations[@]} - wrong)) of ${#mutations[@]} mutations caught"
((wrong == 0))

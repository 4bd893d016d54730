#!/usr/bin/env bash
# E05_UnusedEffectsTakeNoInstruction: what a frame costs does not depend on how many effects the scene has
# switched off. Counted by valgrind, on one thread, within the step alone, without the sums over all clusters
# that are asked for by the clock.
# usage: instructions.sh SLOD_SERVER SCENE
set -euo pipefail
server=$1 scene=$2
most_per_effect=1e-4 # of a frame's instructions
frames=60

folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
command -v valgrind >/dev/null || {
    echo "valgrind is not installed; ./dev test e2e installs it" >&2
    exit 1
}

# with_unused COUNT: the scene with so many effects more, of five sorts, none of which runs
with_unused() {
    cat -- "$scene"
    (($1 > 0)) || return 0
    printf '\n[effects]\nattractor = false\nvortex = false\nspring = false\nturbulence = false\nquadratic_drag = false\n'
    printf '[turbulence]\n[quadratic_drag]\n'
    for ((i = 2; i < $1; ++i)); do
        case $((i % 3)) in
            0) printf '[[attractor]]\nstrength = 1e6\n' ;;
            1) printf '[[vortex]]\nstrength = 1e6\n' ;;
            2) printf '[[spring]]\nstiffness = 100\n' ;;
        esac
    done
}

# instructions COUNT: of a frame
instructions() {
    with_unused "$1" >"$folder/scene.toml"
    valgrind --tool=callgrind --callgrind-out-file=/dev/null --toggle-collect='slod::Simulation::step*' \
        --toggle-collect='slod::Simulation::State::observe*' \
        "$server" "$folder/scene.toml" --frames $frames --threads 1 --set emitter.0.rate=80000 \
        --set control.mode=off --no-dds --free-run --output-dir "$folder" >"$folder/out" 2>"$folder/err" || {
        cat -- "$folder/err" >&2
        exit 1
    }
    echo $(($(sed -n 's/.*Collected : \([0-9]*\).*/\1/p' "$folder/err") / frames))
}

without=
for count in 0 16 64; do
    frame=$(instructions "$count")
    : "${without:=$frame}"
    echo "$count unused effects: $frame instructions a frame"
    awk -v count="$count" -v frame="$frame" -v without="$without" -v most="$most_per_effect" 'BEGIN {
        per_effect = count == 0 ? 0 : (frame / without - 1) / count
        printf "  %.2e of a frame for each, at most %s\n", per_effect, most
        exit frame == 0 || per_effect > most || per_effect < -most
    }'
done

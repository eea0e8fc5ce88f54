#!/usr/bin/env bash
# Runs every fuzz target for a while, on stable Rust.
#
#   scripts/fuzz.sh SECONDS [TARGET...]
#
# The coverage that guides libFuzzer is an LLVM pass, which stable has too; sanitizers, which it has
# not, would find little where unsafe code is forbidden. With nightly and cargo-fuzz:
#
#   cargo +nightly fuzz run TARGET
#
# Needs a C++ compiler. What makes a target fail is written to fuzz/artifacts/.
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=${1:?usage: scripts/fuzz.sh SECONDS [TARGET...]}
shift
if [ $# -eq 0 ]; then
    set -- fuzz/fuzz_targets/*.rs
fi

host=$(rustc -vV | sed -n 's/^host: //p')
coverage=(
    -Cpasses=sancov-module
    -Cllvm-args=-sanitizer-coverage-level=4
    -Cllvm-args=-sanitizer-coverage-inline-8bit-counters
    -Cllvm-args=-sanitizer-coverage-pc-table
    -Cllvm-args=-sanitizer-coverage-trace-compares
    -Ccodegen-units=1 -Cdebug-assertions -Coverflow-checks --cfg=fuzzing
)
# A target is named, so that build scripts stay without coverage.
target_dir=${CARGO_TARGET_DIR:-target}/fuzz
RUSTFLAGS="${coverage[*]}" CARGO_TARGET_DIR=$target_dir \
    cargo build --locked --quiet --release --manifest-path fuzz/Cargo.toml --target "$host"

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
for target; do
    name=$(basename "$target" .rs)
    printf '%s: ' "$name"
    mkdir -p "fuzz/artifacts/$name" "$scratch/$name"
    corpora=("$scratch/$name")
    [ ! -d "fuzz/seeds/$name" ] || corpora+=("fuzz/seeds/$name")
    if ! TMPDIR=$scratch "$target_dir/$host/release/$name" -seed=1 -max_total_time="$seconds" \
        -max_len=4096 -timeout=10 -artifact_prefix="fuzz/artifacts/$name/" -print_final_stats=1 "${corpora[@]}" \
        2>"$scratch/log"; then
        tail -n 40 "$scratch/log" >&2
        exit 1
    fi
    sed -n 's/^stat::number_of_executed_units: *//p' "$scratch/log" | tr '\n' ' '
    echo runs
done

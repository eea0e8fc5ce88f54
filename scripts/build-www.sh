#!/usr/bin/env bash
# Builds the browser page: the core as WebAssembly, and the files that show it.
#
#   scripts/build-www.sh [OUT]        OUT: target/www unless said otherwise
#
# Takes the toolchain's own wasm32 target where there is one (`rustup target add
# wasm32-unknown-unknown`), else Debian's; see scripts/target-env.sh. Any server of static files can
# serve OUT; `halflight serve OUT` does on this machine.
set -euo pipefail
cd "$(dirname "$0")/.."

target_dir=${CARGO_TARGET_DIR:-target}
out=${1:-$target_dir/www}
cargo build --locked --quiet --package halflight-wasm --features bindgen --bin halflight-bindgen \
    --profile tool
mkdir -p "$out"
cp -R www/. "$out/"
# The module of the page, and the one with readers of files, which it fetches when it is handed some.
build() {
    local folder=$1
    shift
    # A variable of the target: build scripts and macros of this machine are not touched.
    CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS='-Ctarget-feature=+simd128' \
        scripts/target-env.sh wasm32-unknown-unknown \
        cargo build --locked --quiet --package halflight-wasm --lib --profile www "$@" \
        --target wasm32-unknown-unknown --target-dir "$target_dir/wasm"
    "$target_dir/tool/halflight-bindgen" \
        "$target_dir/wasm/wasm32-unknown-unknown/www/halflight_wasm.wasm" "$folder"
    bytes=$(gzip -9c "$folder/halflight_bg.wasm" | wc -c)
    echo "$folder: module of $((bytes / 1024)) KiB, gzipped"
}
build "$out" --no-default-features --features shared
if [ "$bytes" -gt $((300 * 1024)) ]; then
    echo "build-www: the page's module must not be larger than 300 KiB" >&2
    exit 1
fi
build "$out/files"

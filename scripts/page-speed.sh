#!/usr/bin/env bash
# How fast the browser page is on this machine: time to the first picture, frames per second while a light
# is dragged, seconds to an error of 1 %, and one worker against one thread of the command line.
#
#   scripts/page-speed.sh
#
# Needs chromedriver and Chromium. Of three runs the best counts; it takes a few minutes.
set -euo pipefail
cd "$(dirname "$0")/.."

target=${CARGO_TARGET_DIR:-target}
scripts/build-www.sh "$target/www"
cargo build --locked --quiet --release -p halflight-cli
HALFLIGHT_WWW=$(realpath "$target/www") HALFLIGHT_CLI=$(realpath "$target/release/halflight") \
    cargo test --locked --quiet -p halflight-tests --test browser -- --ignored --nocapture speed

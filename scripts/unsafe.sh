#!/usr/bin/env bash
# How many lines of the core and of what it links say `unsafe`, comments left out; for firmware, that is
# without features.
#
#   scripts/unsafe.sh [FEATURES]
set -euo pipefail
cd "$(dirname "$0")/.."

folders=$(cargo metadata --locked --format-version 1 | grep -o '"manifest_path":"[^"]*"' | cut -d'"' -f4 | xargs -n1 dirname)
printf '%-28s %s\n' crate 'lines with unsafe'
cargo tree --locked -p halflight --no-default-features --features "${1:-}" --edges normal,no-proc-macro \
    --prefix none --format '{p}' | awk '{ print $1, substr($2, 2) }' | sort -u | while read -r name version; do
    folder=core
    [ "$name" = halflight ] || folder=$(grep -m1 "/$name-$version\$" <<<"$folders")
    lines=$(grep -rhwE 'unsafe' --include='*.rs' "$folder/src" | grep -vcE '^ *//|unsafe_code' || true)
    printf '%-28s %s\n' "$name $version" "$lines"
done

#!/usr/bin/env bash
# Instructions for each sample of some built-in scenes, counted by valgrind's callgrind: unlike time, the
# same on a busy machine.
#
#   scripts/counts.sh          count; fails where tests/counts.txt is exceeded by more than 3 %
#   scripts/counts.sh accept   count and write tests/counts.txt
#
# Needs valgrind. What another compiler makes of the same source is another matter: then the counts are
# shown and not judged.
set -euo pipefail
cd "$(dirname "$0")/.."

file=tests/counts.txt
mode=${1:-check}
[[ $mode == check || $mode == accept ]] || { sed -n '5,6s/^# *//p' "$0" >&2; exit 2; }
command -v valgrind >/dev/null || { echo "counts.sh: needs valgrind" >&2; exit 1; }

cargo build --locked --quiet --release -p halflight-cli
program=$(realpath "${CARGO_TARGET_DIR:-target}/release/halflight")
compiler=$(rustc -V | cut -d' ' -f2)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

width=48 height=32 few=4 many=20
# All instructions of a render. The sequence is that of so many samples in both.
instructions() {
    valgrind --tool=callgrind --callgrind-out-file=/dev/null --log-file="$scratch/log" \
        "$program" render "$1" --spp "$2" --sequence sobol --threads 1 --width $width --height $height \
        --quiet -o "$scratch/out.exr" >/dev/null
    [ -s "$scratch/out.exr" ] && sed -n "s/.*refs: *//p" "$scratch/log" | tr -d ,
}

declare -A recorded
if [ -f $file ]; then
    while read -r scene count; do recorded[$scene]=$count; done <$file
fi
judged=$([ "${recorded[rustc]:-}" = "$compiler" ] && echo yes || echo no)

printf 'rustc %s\n' "$compiler" >"$scratch/counts"
printf '%-12s %12s %12s %8s\n' scene instructions recorded change
over=0
for scene in cornell still-life contact colours plates lanterns morning gallery; do
    less=$(instructions $scene $few)
    more=$(instructions $scene $many)
    count=$(((more - less) / ((many - few) * width * height)))
    printf '%s %d\n' $scene $count >>"$scratch/counts"
    before=${recorded[$scene]:-0}
    change=-
    if [ "$before" -gt 0 ]; then
        change=$(awk -v a="$count" -v b="$before" 'BEGIN { printf "%+.1f %%", 100 * (a / b - 1) }')
        [ $((100 * count)) -le $((103 * before)) ] || over=1
    fi
    printf '%-12s %12d %12s %8s\n' $scene "$count" "$before" "$change"
done

if [ "$mode" = accept ]; then
    cp "$scratch/counts" $file
elif [ "$judged" = no ]; then
    echo "counts.sh: not judged: $file is of rustc ${recorded[rustc]:-?}, this is $compiler" >&2
elif [ $over = 1 ]; then
    echo "counts.sh: more than 3 % above $file; if that is the price of something, say so and run: $0 accept" >&2
    exit 1
fi

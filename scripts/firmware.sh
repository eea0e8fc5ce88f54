#!/usr/bin/env bash
# Renders on microcontrollers under QEMU, and measures what the core takes there.
#
#   scripts/firmware.sh run TARGET     render on a machine; fails unless the pixels are those of this one
#   scripts/firmware.sh footprint      flash and stack beside tests/firmware/budget.txt
#   scripts/firmware.sh stacks         stack of each entry point
#   scripts/firmware.sh counts         instructions for each sample, by density
#
# TARGET: thumbv7em-none-eabihf, thumbv6m-none-eabi or riscv32imac-unknown-none-elf.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
CARGO_TARGET_DIR=$(realpath -m "${CARGO_TARGET_DIR:-$root/target}/firmware")
export CARGO_TARGET_DIR
cd "$root/tests/firmware"

# Its own workspace, with targets that the toolchain in use may not have.
for_target() {
    local target=$1
    shift
    local profile=(--release)
    [[ " $* " != *' --profile '* ]] || profile=()
    "$root/scripts/target-env.sh" "$target" cargo "$@" --quiet --locked "${profile[@]}" --target "$target"
}

run() {
    export -f for_target
    export root
    local program programs=(picture)
    # A scene in bytes may hold any kind of light and material: the smaller machines have no room for all.
    [ "$1" != $m4f ] || programs+=(stored)
    for program in "${programs[@]}"; do
        local features=()
        [ $program = picture ] || features=(--features bytes)
        for_target "$1" build "${features[@]}" --bin $program
        # Built already: this is the machine's time.
        timeout 300 bash -c 'for_target "$@"' run "$1" run "${features[@]}" --bin $program
    done
}

m4f=thumbv7em-none-eabihf
elf() {
    local profile=tiny
    [ "$1" != a ] || profile=release
    echo "$CARGO_TARGET_DIR/$m4f/$profile/footprint_$1"
}
qemu() { timeout 120 qemu-system-arm -M mps2-an386 -nographic -semihosting-config enable=on,target=native "$@"; }

# Bytes of the sections that stay in flash.
flash() {
    local sum=0 name size
    while read -r name size; do
        case $name in .vector_table | .text | .rodata | .data) sum=$((sum + 16#$size)) ;; esac
    done < <(readelf -SW "$1" | tr -d '[]' | awk '{ print $2, $6 }')
    echo $sum
}
# Bytes of the scene among them.
data() {
    readelf -sW "$1" | awk '$4 == "OBJECT" && $8 ~ /scenes/ { sum += $3 } END { print sum + 0 }'
}

# What has no tree is smallest in line; the rest out of line, each part once.
footprints() {
    local extra=$1
    for_target $m4f build --features "$extra" --bin footprint_a
    for_target $m4f build --profile tiny --features "small,$extra" --bin footprint_b --bin footprint_c --bin footprint_d
}

footprint() {
    local over=0 name most_flash most_stack bytes scene stack
    declare -A stacks
    # The stacks first: the programs without a word to say stay for a look with nm.
    footprints stack
    for name in a b c d; do
        stacks[$name]=$(qemu -kernel "$(elf $name)")
    done
    footprints ''
    printf '%-8s %10s %10s %10s %10s %10s\n' program flash 'at most' stack 'at most' scene
    while read -r name most_flash most_stack; do
        [[ $name != '#'* ]] || continue
        scene=$(data "$(elf "$name")")
        bytes=$(($(flash "$(elf "$name")") - scene))
        stack=${stacks[$name]}
        printf '%-8s %10d %10d %10d %10d %10d\n' "$name" "$bytes" "$most_flash" "$stack" "$most_stack" "$scene"
        [ "$bytes" -le "$most_flash" ] && [ "$stack" -le "$most_stack" ] || over=1
    done <budget.txt
    if [ $over = 1 ]; then
        echo "firmware.sh: more than tests/firmware/budget.txt allows" >&2
        return 1
    fi
}

stacks() {
    for_target $m4f build --profile tiny --features small,stack --bin stacks
    qemu -kernel "$CARGO_TARGET_DIR/$m4f/tiny/stacks"
}

counts() {
    for_target $m4f build --features counts --bin counts
    qemu -icount shift=0 -kernel "$CARGO_TARGET_DIR/$m4f/release/counts"
}

case ${1:-} in
    run) run "${2:?TARGET}" ;;
    footprint) footprint ;;
    stacks) stacks ;;
    counts) counts ;;
    *)
        sed -n '2,9p' "$0" >&2
        exit 2
        ;;
esac

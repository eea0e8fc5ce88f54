#!/usr/bin/env bash
# Runs a command with a toolchain that has the standard library of TARGET.
#
#   scripts/target-env.sh TARGET COMMAND...
#   scripts/target-env.sh wasm32-unknown-unknown cargo build --target wasm32-unknown-unknown
#
# 1. The toolchain in use has the target (`rustup target add TARGET`): the command runs as it is.
# 2. Otherwise Debian's rustc-web and rust-web-src, two packages of one version: the target's
#    `core` (for wasm32 also `std`) is built once into a folder of the cache. The flag that stable
#    cargo does not have stays inside that one build; the project itself is built without it.
#
# TARGET_CACHE: the cache (default: rust-target-std in XDG_CACHE_HOME or ~/.cache).
set -euo pipefail

if [ $# -lt 2 ]; then
    sed -n '2,5p' "$0" >&2
    exit 2
fi
target=$1
shift
cache=${TARGET_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/rust-target-std}

has_target() {
    local dir
    dir=$("${RUSTC:-rustc}" --print target-libdir --target "$target" 2>/dev/null) || return 1
    compgen -G "$dir/libcore-*.rlib" >/dev/null
}
if has_target; then
    exec "$@"
fi

case $target in
wasm32-*) crates=std,panic_abort linkers='/usr/bin/wasm-ld-2?' ;;
*-none-*) crates=core linkers='/usr/bin/ld.lld-2?' ;;
*)
    echo "target-env: no std for $target: run 'rustup target add $target'" >&2
    exit 1
    ;;
esac

newest() { compgen -G "$1" | sort -V | tail -1; }
has_compiler() {
    [ -x /usr/bin/rustc ] && [ -d /usr/lib/rustlib/src/rust/library/core/src ] && [ -n "$(newest "$linkers")" ]
}
if ! has_compiler; then
    if [ "$(id -u)" != 0 ] || ! command -v apt-get >/dev/null; then
        echo "target-env: no std for $target: run 'rustup target add $target'," \
            "or install Debian's rustc-web rust-web-src lld-22" >&2
        exit 1
    fi
    echo "target-env: installing Debian's rustc-web rust-web-src lld-22" >&2
    apt-get update -qq >&2
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
        rustc-web rust-web-src lld-22 >&2
fi
# A compiler builds only the library of its own version.
version=$(dpkg-query -W -f '${Version}' rustc-web)
sources=$(dpkg-query -W -f '${Version}' rust-web-src)
if [ "$version" != "$sources" ]; then
    echo "target-env: rustc-web is $version but rust-web-src is $sources" >&2
    exit 1
fi

# Bitcode, as in the released libraries: without it the project could not link with `lto`.
flags=-Cembed-bitcode=yes
key=$(echo "$version $crates $flags" | sha256sum | cut -c1-12)
sysroot=$cache/$target-$key
mkdir -p "$cache"
exec 9>"$cache/lock"
flock 9
if ! [ -e "$sysroot/ok" ]; then
    echo "target-env: building $crates of rustc $version for $target into $sysroot" >&2
    new=$sysroot.new
    rm -rf "$new" "$sysroot"
    lib=$new/lib/rustlib/$target/lib
    mkdir -p "$new/empty/src" "$new/bin" "$lib"
    printf '[package]\nname = "empty"\nversion = "0.0.0"\nedition = "2024"\n[workspace]\n' >"$new/empty/Cargo.toml"
    echo '#![no_std]' >"$new/empty/src/lib.rs"
    (
        # Away from the project, whose settings and flags are not for the library.
        cd "$new/empty"
        env -u CARGO_ENCODED_RUSTFLAGS -u RUSTC_WRAPPER -u CARGO_BUILD_TARGET \
            RUSTC=/usr/bin/rustc RUSTC_BOOTSTRAP=1 RUSTFLAGS=$flags CARGO_TARGET_DIR="$new/target" \
            cargo build -q --release --target "$target" -Z build-std=$crates -Z build-std-features= >&2
    )
    cp "$new/target/$target/release/deps"/lib*.rlib "$lib/"
    rm -rf "$lib"/libempty-*.rlib "$new/target" "$new/empty"
    host=$(/usr/bin/rustc -vV | sed -n 's/^host: //p')
    ln -s "/usr/lib/rustlib/$host" "$new/lib/rustlib/$host"
    # cargo builds anew when the answer to -vV changes, not when the files of a sysroot do: the key
    # is part of the answer.
    {
        echo '#!/bin/sh'
        printf '[ "$*" != -vV ] || { /usr/bin/rustc -vV && exec echo "std: %s"; }\n' "$key"
        printf 'exec /usr/bin/rustc --sysroot %q "$@"\n' "$sysroot"
    } >"$new/bin/rustc"
    chmod +x "$new/bin/rustc"
    touch "$new/ok"
    mv "$new" "$sysroot"
fi
exec 9>&-

export RUSTC=$sysroot/bin/rustc
name=${target^^}
linker=$(newest "$linkers")
export "CARGO_TARGET_${name//-/_}_LINKER=$linker"
exec "$@"

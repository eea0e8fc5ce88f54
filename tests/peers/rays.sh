#!/usr/bin/env bash
# The same rays through halflight's tree and through Embree 3's, one by one on one thread.
#
#   tests/peers/rays.sh [SCENE.xml]
#
# Needs g++ and Embree 3 (Debian: libembree-dev). Run it on a machine that does nothing else.
set -euo pipefail
cd "$(dirname "$0")/../.."

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
g++ -O3 -march=native tests/peers/embree_rays.cpp -lembree3 -o "$scratch/embree_rays"
[ $# -eq 0 ] || HALFLIGHT_SCENE=$(realpath "$1")
export HALFLIGHT_SCENE=${HALFLIGHT_SCENE:-}
[ -n "$HALFLIGHT_SCENE" ] || unset HALFLIGHT_SCENE
echo '== halflight'
HALFLIGHT_RAYS=$scratch cargo bench --locked --quiet -p halflight-tests --bench rays -- --noplot 2>/dev/null |
    grep -E 'triangles|meet|/(closest|any)|time|thrpt'
echo '== Embree'
"$scratch/embree_rays" "$scratch"

#!/bin/bash
# One frame for each task of a Slurm job array.
#
#   sbatch --array=0-249 cluster/slurm-frames.sh scene.glb 'out/####.exr' [FLAG...]
#   sbatch --array=1-250 cluster/slurm-frames.sh 'shots/%04d.xml' 'out/%04d.exr' [FLAG...]
#
# The first renders the way of a scene's camera, the second a scene file for each frame. Slurm's own limit of
# tasks (MaxArraySize) is 1001 unless its administrator says otherwise; for frames beyond it, FIRST is added to
# the number of the task: FIRST=1000 sbatch --array=0-999 …
#
#SBATCH --job-name=halflight-frames
#SBATCH --requeue
#SBATCH --open-mode=append
set -euo pipefail
scene=${1:?usage: slurm-frames.sh SCENE OUT [FLAG...]} out=${2:?which pictures?}
shift 2

frame=$((SLURM_ARRAY_TASK_ID + ${FIRST:-0}))
flags=(--quiet --checkpoint "${CHECKPOINT:-60}" --threads "${SLURM_CPUS_PER_TASK:-1}")
if [[ $scene == *%* ]]; then
    # shellcheck disable=SC2059 # The names are the formats.
    scene=$(printf "$scene" "$frame") out=$(printf "$out" "$frame")
    # A task that Slurm runs again after its picture was written has nothing left to do.
    [ ! -e "$out" ] || exit 0
else
    # Here halflight itself keeps a frame that exists.
    flags+=(--frames "$frame..$frame")
fi
exec "${HALFLIGHT:-halflight}" render "$scene" -o "$out" "${flags[@]}" "$@"

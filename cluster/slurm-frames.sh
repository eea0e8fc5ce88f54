#!/bin/bash
# One frame for each task of a Slurm job array: FOLDER/0001.xml to FOLDER/0001.exr and so on.
#
#   sbatch --array=1-250 cluster/slurm-frames.sh FOLDER [FLAG...]
#
# Slurm's own limit of tasks (MaxArraySize) is 1001 unless its administrator says otherwise; for frames
# beyond it, FIRST is added to the number of the task: FIRST=1000 sbatch --array=1-1000 …
#
#SBATCH --job-name=halflight-frames
#SBATCH --requeue
#SBATCH --open-mode=append
set -euo pipefail
folder=${1:?usage: slurm-frames.sh FOLDER [FLAG...]}
shift

frame=$(printf '%s/%04d' "$folder" $((SLURM_ARRAY_TASK_ID + ${FIRST:-0})))
# A task that Slurm runs again after its picture was written has nothing left to do.
[ ! -e "$frame.exr" ] || exit 0
exec "${HALFLIGHT:-halflight}" render "$frame.xml" -o "$frame.exr" --quiet \
    --checkpoint "${CHECKPOINT:-60}" --threads "${SLURM_CPUS_PER_TASK:-1}" "$@"

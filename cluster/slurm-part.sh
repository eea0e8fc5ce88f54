#!/bin/bash
# One part of a picture for each task of a Slurm job array; cluster/README.md says how to use it.
#
#   sbatch --array=1-16 cluster/slurm-part.sh SCENE OUT [FLAG...]
#
#SBATCH --job-name=halflight
#SBATCH --requeue
#SBATCH --open-mode=append
set -euo pipefail
scene=${1:?usage: slurm-part.sh SCENE OUT [FLAG...]} out=${2:?which picture?}
shift 2

# To make again what is missing of 16 parts: PARTS=16 sbatch --array=3,7 …
parts=${PARTS:-$SLURM_ARRAY_TASK_MAX}
part=$SLURM_ARRAY_TASK_ID

code=0
"${HALFLIGHT:-halflight}" render "$scene" --part "$part/$parts" -o "$out.$part.part" --quiet \
    --checkpoint "${CHECKPOINT:-60}" --threads "${SLURM_CPUS_PER_TASK:-1}" "$@" || code=$?

# Killed, for example as memory ran out: Slurm runs it again, at most three times, and it goes on from its
# checkpoint. What halflight itself refuses (2) would be refused again. After a node fails, Slurm does the
# same by itself.
if [ "$code" -gt 128 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt 3 ]; then
    scontrol requeue "${SLURM_ARRAY_JOB_ID}_$part"
    # Slurm ends this script; the code is for the case that it does not.
    sleep 60
fi
exit "$code"

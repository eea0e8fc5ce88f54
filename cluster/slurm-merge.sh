#!/bin/bash
# The picture from its parts: to be submitted with --dependency=afterok on the array that makes them.
#
#   sbatch --dependency=afterok:JOB cluster/slurm-merge.sh OUT [FLAG...]
#
#SBATCH --job-name=halflight-merge
set -euo pipefail
out=${1:?usage: slurm-merge.sh OUT [FLAG...]}
shift

"${HALFLIGHT:-halflight}" merge "$out".*.part -o "$out" "$@"
rm -- "$out".*.part

#!/usr/bin/env bash
# Renders a picture in parts on a Slurm cluster of three nodes that all are this machine, kills one part in
# the middle, and compares the merged picture with one of a single run, bit by bit.
#
#   scripts/slurm-test.sh HALFLIGHT
#
# Needs slurmctld, slurmd, slurm-client and munge (Debian's packages), and root, as the nodes start what
# users submit. Everything listens on loopback, lies in a folder of its own, and is ended and removed at the
# end; a cluster that the machine belongs to is not touched.
set -euo pipefail
cd "$(dirname "$0")/.."

halflight=$(realpath "${1:?usage: scripts/slurm-test.sh HALFLIGHT}")
for tool in munged slurmctld slurmd sbatch; do
    PATH=$PATH:/usr/sbin command -v "$tool" >/dev/null || {
        echo "scripts/slurm-test.sh: please install slurmctld, slurmd, slurm-client and munge: no $tool" >&2
        exit 1
    }
done
export PATH=$PATH:/usr/sbin

scratch=$(mktemp -d)
chmod 755 "$scratch"
started=()
finish() {
    local code=$?
    if [ "$code" != 0 ]; then
        tail -n 30 "$scratch"/*.log "$scratch"/work/*.out >&2 || true
    fi
    # Only what was started here, the last first.
    for ((i = ${#started[@]} - 1; i >= 0; i--)); do
        kill "${started[i]}" 2>/dev/null || true
    done
    for pid in "${started[@]}"; do wait "$pid" 2>/dev/null || true; done
    rm -rf "$scratch"
    exit "$code"
}
trap finish EXIT
# Waits until a command succeeds, for 60 s at most.
until_true() {
    local what=$1
    shift
    for _ in {1..300}; do
        if "$@" >/dev/null 2>&1; then return; fi
        sleep 0.2
    done
    echo "scripts/slurm-test.sh: waited in vain: $what" >&2
    exit 1
}

port=$((20000 + RANDOM % 10000))
host=$(hostname -s)
mkdir -m 700 "$scratch/munge"
mkdir "$scratch/state" "$scratch/spool" "$scratch/work"
head -c 128 /dev/urandom >"$scratch/munge/key"
chmod 600 "$scratch/munge/key"
cat >"$scratch/slurm.conf" <<CONF
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmUser=root
AuthType=auth/munge
# A task that is to run again waits until its first credential has expired.
AuthInfo=socket=$scratch/munge/socket,cred_expire=10
StateSaveLocation=$scratch/state
SlurmdSpoolDir=$scratch/spool/%n
SlurmctldPidFile=$scratch/slurmctld.pid
SlurmdPidFile=$scratch/%n.pid
SlurmctldLogFile=$scratch/slurmctld.log
SlurmdLogFile=$scratch/%n.log
# Neither control groups nor a database: a container has them rarely.
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SelectType=select/linear
SchedulerParameters=defer,batch_sched_delay=0,sched_interval=1
ReturnToService=2
SlurmdParameters=config_overrides
NodeName=node[1-3] NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 1))-$((port + 3)) CPUs=1
PartitionName=all Nodes=ALL Default=YES
CONF
export SLURM_CONF=$scratch/slurm.conf

munged --foreground --force --socket="$scratch/munge/socket" --key-file="$scratch/munge/key" \
    --log-file="$scratch/munged.log" --pid-file="$scratch/munge/pid" --seed-file="$scratch/munge/seed" \
    >/dev/null 2>&1 &
started+=($!)
until_true "munge's socket" test -S "$scratch/munge/socket"
slurmctld -D >/dev/null 2>&1 &
started+=($!)
for node in node1 node2 node3; do
    slurmd -D -N "$node" >/dev/null 2>&1 &
    started+=($!)
done
idle() { [ "$(sinfo -h -N -t idle -o %N | wc -l)" = 3 ]; }
until_true "three idle nodes" idle

cd "$scratch/work"
export HALFLIGHT=$halflight CHECKPOINT=0.2
flags=(--spp 600 --width 240)
parts=$(sbatch --parsable --array=1-5 --output=part-%a.out "$OLDPWD/cluster/slurm-part.sh" \
    cornell picture.exr "${flags[@]}")
merge=$(sbatch --parsable --dependency="afterok:$parts" --output=merge.out \
    "$OLDPWD/cluster/slurm-merge.sh" picture.exr)

# Part 2 dies when it has something to lose.
until_true "a checkpoint of part 2" test -e picture.exr.2.part.checkpoint
victim=$(pgrep -f -- "^$halflight render .* --part 2/5 ")
kill -KILL "$victim"
echo "killed part 2"
requeued() { grep -q 'going on\|requeue\|REQUEUE' part-2.out || scontrol -o show job "${parts}_2" | grep -q 'Restarts=1'; }
until_true "Slurm to run part 2 again" requeued
echo "Slurm runs it again"

"$halflight" render cornell "${flags[@]}" -o once.exr --quiet
ended() { [ -z "$(squeue -h -j "$parts,$merge")" ] || scontrol -o show job "$merge" | grep -q JobState=COMPLETED; }
for _ in {1..10}; do ! ended || break; until_true "the merge" ended; done
scontrol -o show job "$merge" | grep -q 'JobState=COMPLETED' || { scontrol show job "$merge" >&2; exit 1; }
cmp picture.exr once.exr
cat merge.out
[ -z "$(ls ./*.part ./*.checkpoint 2>/dev/null)" ] || { ls >&2; exit 1; }
echo "scripts/slurm-test.sh: five parts on three nodes, one of them killed: the bits of a single run"

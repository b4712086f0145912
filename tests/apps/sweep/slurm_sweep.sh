#!/usr/bin/env bash
# Submits a sweep to a Slurm of one machine, whose daemons it starts for itself with files and ports of their own:
#
#   bash slurm_sweep.sh PROGRAM SWEEP.toml [options of run …]
#
# What `collect` writes must be the same to the byte as of a sweep that ran here, also where the first submission is
# cancelled on its way. Status 77, which means left out, where there is no Slurm, or nobody who may start it (root).
set -euo pipefail

program=$(realpath "$1")
sweep=$(realpath "$2")
shift 2
options=("$@")
for needed in munged slurmctld slurmd sbatch scancel squeue; do
  if ! PATH=$PATH:/usr/sbin command -v "$needed" >/dev/null; then
    echo "left out: there is no $needed (packages slurmctld, slurmd, slurm-client and munge)" >&2
    exit 77
  fi
done
if [[ $(id -u) != 0 ]]; then
  echo "left out: only root starts the daemons of Slurm" >&2
  exit 77
fi
PATH=$PATH:/usr/sbin

# Munge wants a folder above which nobody else may write.
scratch=$(mktemp -d /root/slurm-XXXXXX)
daemons=()
cleanup() {
  local status=$?
  for daemon in "${daemons[@]}"; do kill "$daemon" 2>/dev/null || true; done
  for daemon in "${daemons[@]}"; do wait "$daemon" 2>/dev/null || true; done
  if [[ $status != 0 && $status != 77 ]]; then tail -n 20 "$scratch"/*.log "$scratch"/*.out >&2 2>/dev/null || true; fi
  rm -rf "$scratch"
}
trap cleanup EXIT
cd "$scratch"

fail() {
  echo "error: $1" >&2
  exit 1
}

# await SECONDS WHAT COMMAND…
await() {
  local end=$((SECONDS + $1)) what=$2
  shift 2
  until "$@" >/dev/null 2>&1; do
    [[ $SECONDS -lt $end ]] || fail "waited in vain for $what"
    sleep 0.1
  done
}

start_slurm() {
  mkdir state spool
  head -c 1024 /dev/urandom >munge.key
  chmod 400 munge.key
  munged --foreground --force --key-file="$scratch/munge.key" --socket="$scratch/munge.socket" --pid-file="$scratch/munge.pid" \
    --log-file="$scratch/munge.log" --seed-file="$scratch/munge.seed" >munged.out 2>&1 &
  daemons+=($!)
  await 20 munge test -S munge.socket

  local host port=$((20000 + RANDOM % 20000))
  host=$(hostname -s)
  cat >slurm.conf <<CONF
ClusterName=here
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmctldPort=$port
SlurmdPort=$((port + 1))
AuthType=auth/munge
AuthInfo=socket=$scratch/munge.socket
CryptoType=crypto/munge
StateSaveLocation=$scratch/state
SlurmdSpoolDir=$scratch/spool
SlurmctldPidFile=$scratch/slurmctld.pid
SlurmdPidFile=$scratch/slurmd.pid
SlurmctldLogFile=$scratch/slurmctld.log
SlurmdLogFile=$scratch/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SchedulerParameters=sched_interval=1,batch_sched_delay=0
SelectType=select/cons_tres
ReturnToService=2
MailProg=/bin/true
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=$host Default=YES State=UP
CONF
  export SLURM_CONF=$scratch/slurm.conf
  slurmctld -D >slurmctld.out 2>&1 &
  daemons+=($!)
  slurmd -D >slurmd.out 2>&1 &
  daemons+=($!)
  await 30 "an idle node" sh -c 'sinfo --noheader --format=%t | grep -q idle'
}

compare() {
  "$program" sweep collect "$1" >"$1.txt"
  for file in cases.csv sweep.csv report.html; do cmp "whole/$file" "$1/$file" || fail "$file differs: $2"; done
  [[ -z $(find "$1/cases" -name '.*') ]] || fail "something is left in $1/cases: $2"
}

# submit FOLDER: the number of the job.
submit() {
  "$program" sweep emit "$1" --engine slurm --tasks 4 --time 10 --log "$scratch/task-%a.log" -- "${options[@]}" >"$1.sh"
  sbatch --parsable "$1.sh"
}

start_slurm
"$program" sweep plan "$sweep" --out whole >/dev/null
"$program" sweep run whole --quiet --tolerant -- "${options[@]}"
"$program" sweep collect whole >/dev/null

"$program" sweep plan "$sweep" --out submitted >/dev/null
job=$(submit submitted)
await 120 "job $job" sh -c "[ -z \"\$(squeue --noheader --job $job 2>/dev/null)\" ]"
compare submitted "run by Slurm"
echo "by Slurm $(slurmd --version | cut -d' ' -f2), four tasks: the same to the byte"

"$program" sweep plan "$sweep" --out cancelled >/dev/null
job=$(submit cancelled)
await 60 "two cases" sh -c '[ "$(find cancelled/cases -mindepth 1 -maxdepth 1 -name "[0-9]*" 2>/dev/null | wc -l)" -ge 2 ]'
scancel "$job"
await 60 "the end of job $job" sh -c "[ -z \"\$(squeue --noheader --job $job 2>/dev/null)\" ]"
done_before=$(find cancelled/cases -mindepth 1 -maxdepth 1 -name '[0-9]*' | wc -l)
job=$(submit cancelled)
await 120 "job $job" sh -c "[ -z \"\$(squeue --noheader --job $job 2>/dev/null)\" ]"
compare cancelled "cancelled after $done_before cases"
echo "cancelled after $done_before of $(wc -l <whole/cases.jsonl) cases, submitted again: the same to the byte"

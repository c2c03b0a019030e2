#!/usr/bin/env bash
# A real Slurm on this machine, for as long as this script runs: a fit in eight shards on two nodes, of
# which two are killed, one is told of its time limit, one runs twice and one node is drained, has to
# give the bytes of one process.
#   sudo tests/cluster/slurm_one_machine.sh [RECOIL]     (default: build/release/recoil)
# Needs root and the packages slurm-wlm and munge. Its Slurm has ports, keys and folders of its own and
# leaves nothing behind; one that is installed already is not touched.
set -uo pipefail
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
recoil=$(realpath "${1:-$project/build/release/recoil}")
fit=(fit fits/wall1990-mica.toml --replicates 40000)
shards=8

die() {
  echo "$1" >&2
  exit 1
}
[ "$(id -u)" -eq 0 ] || die "slurmd starts jobs as their users: run this as root"
for program in munged slurmctld slurmd sbatch; do
  command -v "$program" >/dev/null || PATH=$PATH:/usr/sbin command -v "$program" >/dev/null ||
    die "$program is missing: apt-get install slurm-wlm munge"
done
PATH=$PATH:/usr/sbin

place=$(mktemp -d /tmp/recoil-slurm-XXXXXX)
daemons=()
# shellcheck disable=SC2317 # by trap
clean_up() {
  trap - EXIT INT TERM
  [ -e "$place/slurm.conf" ] && scancel --quiet --user=root --signal=KILL --full 2>/dev/null
  for daemon in "${daemons[@]}"; do kill "$daemon" 2>/dev/null; done
  for daemon in "${daemons[@]}"; do wait "$daemon" 2>/dev/null; done
  rm -rf "$place"
}
trap clean_up EXIT
trap 'exit 130' INT TERM

# wait_until SECONDS WHAT COMMAND...: until COMMAND succeeds.
wait_until() {
  local limit=$((SECONDS + $1)) what=$2
  shift 2
  until "$@" >/dev/null 2>&1; do
    if [ "$SECONDS" -ge "$limit" ]; then
      tail -n 20 "$place"/*.log "$place"/parts/log-* >&2 2>/dev/null
      squeue >&2
      sinfo >&2
      die "gave up waiting: $what"
    fi
    sleep 0.2
  done
}

# ---- Slurm -----------------------------------------------------------------------------------

port=$((20000 + RANDOM % 20000))
host=$(hostname -s)
mkdir "$place/state" "$place/spool-one" "$place/spool-two" "$place/parts"
dd if=/dev/urandom of="$place/munge.key" bs=1024 count=1 status=none
chmod 600 "$place/munge.key"
cat >"$place/slurm.conf" <<CONF
ClusterName=one
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$place/munge.socket
CredType=cred/munge
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
StateSaveLocation=$place/state
SlurmdSpoolDir=$place/spool-%n
SlurmctldPidFile=$place/slurmctld.pid
SlurmdPidFile=$place/slurmd-%n.pid
ReturnToService=2
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SwitchType=switch/none
SchedulerParameters=sched_interval=1,batch_sched_delay=1
KillWait=5
MinJobAge=300
NodeName=one NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=1 State=UNKNOWN
NodeName=two NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=1 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
echo "CgroupPlugin=cgroup/v1" >"$place/cgroup.conf" # without it slurmd dies where no cgroup is mounted
export SLURM_CONF=$place/slurm.conf

munged --foreground --force --num-threads=2 --key-file="$place/munge.key" \
  --socket="$place/munge.socket" --pid-file="$place/munge.pid" --seed-file="$place/munge.seed" >"$place/munged.log" 2>&1 &
daemons+=($!)
wait_until 20 "munged" test -S "$place/munge.socket"
slurmctld -D >"$place/slurmctld.log" 2>&1 &
daemons+=($!)
for node in one two; do
  slurmd -D -N "$node" >"$place/slurmd-$node.log" 2>&1 &
  daemons+=($!)
done
both_idle() { [ "$(sinfo --noheader --Node --format=%t | sort -u)" = idle ]; }
wait_until 60 "both nodes idle" both_idle
echo "$(sbatch --version): two nodes are up"

# ---- the job ---------------------------------------------------------------------------------

cd "$project" || exit 1
parts=$place/parts
"$recoil" cluster slurm "${fit[@]}" --shards $shards --out "$parts" >/dev/null || exit 1
sh "$parts/run.sh" || die "the job could not be submitted"
array=$(squeue --noheader --array --format=%F --name=recoil | head -n 1)

running() { [ "$(squeue --noheader --array --states=RUNNING --name=recoil --format=%K | wc -l)" -ge "$1" ]; }
wait_until 30 "two running shards" running 2
mapfile -t victims < <(squeue --noheader --array --states=RUNNING --name=recoil --format=%K | sort -n | head -n 2)
for number in "${victims[@]}"; do
  scancel --signal=KILL --full "${array}_$number" || die "shard $number could not be killed"
  echo "shard $number: killed"
done
wait_until 30 "the next shards" running 1
told=''
kept() { [ -n "$(find "$parts" -name 'unfinished-*')" ]; }
tell_one() {
  told=$(squeue --noheader --array --states=RUNNING --name=recoil --format=%K | sort -n | head -n 1)
  [ -n "$told" ] || return 1
  sleep 0.5 # what has hardly begun has nothing to keep
  scancel --batch --signal=USR1 "${array}_$told" || return 1
  sleep 0.5
  kept
}
wait_until 30 "a shard that keeps what is finished" tell_one
echo "shard $told: told of its time limit, and keeps what is finished"
scontrol update NodeName=two State=DRAIN Reason="a try" || exit 1
echo "node two: drained"
sbatch --parsable --array=5 "$parts/array.sbatch" >/dev/null || exit 1
echo "shard 5: submitted a second time"
enough() { [ "$(find "$parts" -name 'part-*' | wc -l)" -ge 3 ]; }
wait_until 120 "three parts" enough
scontrol update NodeName=two State=RESUME || exit 1
echo "node two: back"

over() { [ -z "$(squeue --noheader --format=%i)" ]; }
wait_until 240 "the end of all jobs" over
echo "the merge jobs said:"
sed 's/^/  /' "$parts/log-merge.txt"
grep -q "^round 2: --array=" "$parts/log-merge.txt" || die "nothing was missing after the kills"
for number in "${victims[@]}" "$told"; do
  [ "$(find "$parts" -name "part-$number-of-$shards-*" | wc -l)" = 1 ] || die "no part $number"
done
kept && die "what was unfinished is still there"

# ---- the same in one process -----------------------------------------------------------------

"$recoil" "${fit[@]}" --out "$place/whole" >"$place/whole.txt" || exit 1
cmp "$place/whole.txt" "$parts/result.txt" || die "what was printed differs from that of one process"
cmp "$place/whole/fit.json" "$parts/fit.json" || die "fit.json differs from that of one process"
echo "the same bytes as one process: $(wc -c <"$parts/fit.json") of fit.json, $(wc -c <"$parts/result.txt") printed"

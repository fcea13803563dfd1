#!/usr/bin/env bash
# A render in 16 slices through Slurm, two nodes on this machine: one worker killed, one requeued, one file cut in half. What
# comes out is what 16 slices rendered by hand give, byte for byte. The cluster lives in the folder of the test and ends with it.
#   TYNDALL_FARM_SCENE, TYNDALL_FARM_OPTIONS   another scene, and how it is rendered
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"
for program in slurmctld slurmd sbatch munged; do
  command -v $program >/dev/null || PATH=$PATH:/usr/sbin
  command -v $program >/dev/null || { echo "FAILED: $program is not there; install slurmctld slurmd slurm-client munge"; exit 1; }
done
scene=${TYNDALL_FARM_SCENE:-$TYNDALL_SOURCE_DIR/volumes/plume_hall/plume_hall.pbrt}
read -ra options <<<"${TYNDALL_FARM_OPTIONS:---resolution 160x90 --spp 512 --aov Albedo,N,Z --seed 3 --reproducible --threads 1}"
here=$PWD
rm -rf cluster job by-hand whole.exr merged.exr
mkdir -p cluster/{state,log,spool} by-hand

# ------------------------------------------------------------------------------------------------ the cluster

start_cluster() {
  local user host
  user=$(id -un) host=$(hostname -s)
  head -c 128 /dev/urandom >cluster/munge.key
  chmod 400 cluster/munge.key
  chmod 755 cluster
  munged --force --key-file "$here/cluster/munge.key" --socket "$here/cluster/munge.socket" \
    --pid-file "$here/cluster/munge.pid" --log-file "$here/cluster/munge.log" --seed-file "$here/cluster/munge.seed" || return
  cat >cluster/slurm.conf <<CONF
ClusterName=tyndall
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=16817
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$here/cluster/munge.socket
CredType=cred/munge
StateSaveLocation=$here/cluster/state
SlurmdSpoolDir=$here/cluster/spool/%n
SlurmctldPidFile=$here/cluster/slurmctld.pid
SlurmdPidFile=$here/cluster/%n.pid
SlurmctldLogFile=$here/cluster/log/slurmctld
SlurmdLogFile=$here/cluster/log/%n
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SlurmdParameters=config_overrides
SchedulerParameters=sched_interval=1,batch_sched_delay=0
ReturnToService=2
MailProg=/bin/true
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=17001 CPUs=2 RealMemory=8000
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=17002 CPUs=2 RealMemory=8000
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
CONF
  export SLURM_CONF=$here/cluster/slurm.conf
  slurmctld -f "$SLURM_CONF" || return
  slurmd -f "$SLURM_CONF" -N n1 && slurmd -f "$SLURM_CONF" -N n2
}

end_cluster() {
  local file
  scancel --state=RUNNING,PENDING --quiet --user="$(id -un)" 2>/dev/null
  for file in n1 n2 slurmctld munge; do
    [ -f "cluster/$file.pid" ] && kill "$(cat "cluster/$file.pid")" 2>/dev/null
  done
  sleep 1
}

# waits_for SECONDS COMMAND...: until it succeeds.
waits_for() {
  local left=$1
  shift
  until "$@"; do
    [ "$left" -gt 0 ] || { echo "FAILED: waited in vain for: $*"; return 1; }
    left=$((left - 1))
    sleep 1
  done
}
queue_is_empty() { [ -z "$(squeue --noheader 2>/dev/null)" ]; }
two_run() { [ "$(squeue --noheader --states=R --format=%F 2>/dev/null | wc -l)" -ge 2 ]; }
nodes_are_up() { [ "$(sinfo --noheader --format=%D --states=idle 2>/dev/null)" = 2 ]; }

trap end_cluster EXIT
start_cluster || { echo "FAILED: no cluster: $(tail -n 3 cluster/log/* cluster/munge.log 2>/dev/null)"; exit 1; }
waits_for 60 nodes_are_up || { sinfo; tail -n 5 cluster/log/*; exit 1; }

# ------------------------------------------------------------------------------------------------- the renders

for i in {1..16}; do
  expect 0 "$TYNDALL_BIN" render "$scene" "${options[@]}" --slice $i/16 -o by-hand/slice-$i.exr --quiet
done
expect 0 "$TYNDALL_BIN" merge by-hand -o whole.exr

expect 0 "$TYNDALL_BIN" farm slurm "$scene" "${options[@]}" --slices 16 --folder job -o merged.exr --no-trial --memory 1
expect 0 sh job/submit.sh
cat out.txt
waits_for 60 two_run
# Two workers are lost: one is killed with all it has, one is told to begin again.
mapfile -t running < <(squeue --noheader --states=R --format="%A %F_%K" | head -n 2)
pkill -9 -f "slices/slice-${running[0]##*_}.exr" || fail "no worker of ${running[0]} to kill"
scontrol requeue "${running[1]#* }" || fail "${running[1]} cannot be requeued"
waits_for 900 queue_is_empty || squeue
says "missing or not complete" job/logs/merge.log
"$TYNDALL_BIN" status job/slices >status.txt
says "there 15" status.txt

# One file is cut in half.
victim=$(( ${running[0]##*_} % 16 + 1 ))
truncate --size=$(( $(stat -c %s job/slices/slice-$victim.exr) / 2 )) job/slices/slice-$victim.exr
expect 7 "$TYNDALL_BIN" merge job/slices -o part.exr
says "slice-$victim.exr" err.txt
says "14 of 16" err.txt

# The same again: what is missing is rendered, what is there is not.
untouched=$(( victim % 16 + 1 ))
before=$(stat -c %Y.%i job/slices/slice-$untouched.exr)
expect 0 sh job/submit.sh
waits_for 900 queue_is_empty || squeue
[ "$(stat -c %Y.%i job/slices/slice-$untouched.exr)" = "$before" ] || fail "slice $untouched was rendered again"
cmp merged.exr whole.exr || fail "the picture of the farm is not that of the slices rendered by hand"
expect 0 "$TYNDALL_BIN" status job/slices
finish

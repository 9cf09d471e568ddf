# Sourced by slurm_test.sh: a Slurm of its own with several nodes on this machine, in one folder.
# It needs root, and neither systemd nor anything that is configured on the machine.
# shellcheck shell=bash

nodes=4
daemons=()

# slurm_missing prints what keeps Slurm from running here, if anything does.
slurm_missing() {
  local program
  for program in slurmctld slurmd sbatch munged; do
    PATH=$PATH:/usr/sbin command -v "$program" >/dev/null ||
      { echo "$program is not installed (slurm-wlm, munge)" && return; }
  done
  [[ $(id -u) == 0 ]] || echo "Slurm's daemons need root"
}

# start_slurm FOLDER starts it. SLURM_CONF then leads all its commands to it.
start_slurm() {
  local folder=$1 node port
  port=$((20000 + RANDOM % 20000))
  export PATH=$PATH:/usr/sbin
  mkdir -p "$folder"/{state,munge}
  chmod 755 "$folder"
  head -c 1024 /dev/urandom >"$folder/munge/key"
  chmod 600 "$folder/munge/key"
  munged --foreground --force --socket="$folder/munge/socket" --key-file="$folder/munge/key" \
    --pid-file="$folder/munge/pid" --log-file="$folder/munge/log" \
    --seed-file="$folder/munge/seed" >"$folder/munged.out" 2>&1 &
  daemons+=($!)
  {
    cat <<END
ClusterName=crt
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmctldPort=$port
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket
CredType=cred/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool-%n
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd-%n.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SwitchType=switch/none
MpiDefault=none
SlurmdParameters=config_overrides
SchedulerParameters=sched_min_interval=10000,sched_interval=1,bf_interval=1,default_queue_depth=500
ReturnToService=2
MaxArraySize=41
KillWait=1
MinJobAge=300
PartitionName=all Nodes=node[1-$nodes] Default=YES MaxTime=INFINITE State=UP
END
    for node in $(seq "$nodes"); do
      echo "NodeName=node$node NodeHostname=$(hostname -s) NodeAddr=127.0.0.1" \
        "Port=$((port + node)) CPUs=2 State=UNKNOWN"
    done
  } >"$folder/slurm.conf"
  export SLURM_CONF=$folder/slurm.conf
  local tries=0
  until [[ -S $folder/munge/socket ]]; do
    ((++tries < 100)) || return 1
    sleep 0.05
  done
  slurmctld -D -f "$SLURM_CONF" >"$folder/slurmctld.out" 2>&1 &
  daemons+=($!)
  for node in $(seq "$nodes"); do
    mkdir -p "$folder/spool-node$node"
    slurmd -D -N "node$node" -f "$SLURM_CONF" >"$folder/slurmd-$node.out" 2>&1 &
    daemons+=($!)
  done
  tries=0
  until (($(sinfo --noheader --Node --format=%T 2>/dev/null | grep -c idle) == nodes)); do
    ((++tries < 200)) || return 1
    sleep 0.1
  done
}

# stop_slurm ends what runs in it, and all of its daemons.
stop_slurm() {
  local process
  [[ -z ${SLURM_CONF:-} ]] || scancel --user=root --signal=KILL --full >/dev/null 2>&1 || true
  for process in "${daemons[@]}"; do kill "$process" 2>/dev/null || true; done
  sleep 0.3
  for process in "${daemons[@]}"; do kill -KILL "$process" 2>/dev/null || true; done
  for process in "${daemons[@]}"; do wait "$process" 2>/dev/null || true; done
}

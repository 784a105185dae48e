#!/bin/bash
# slurm_test.sh PROGRAM LAUNCHER TRIALS: a batch as a Slurm array on two nodes, which are network
# namespaces of this machine; one of them dies in its midst. The table and the report are those of
# one undisturbed run. 77: not root, or Slurm or munge is not installed.
set -eu
if [ "${1:-}" != --inside ]; then
  for needed in slurmctld slurmd sbatch munged ip unshare nsenter; do
    if [ "$(id -u)" != 0 ] || ! PATH=$PATH:/usr/sbin command -v $needed >/dev/null; then
      echo "[  SKIPPED ] needs root and $needed (Debian: slurmctld slurmd slurm-client munge iproute2)"
      exit 77
    fi
  done
  # All that is started dies with the first process of a PID namespace. Mounts and names are its own.
  exec unshare --net --mount --uts --ipc --pid --fork --kill-child --mount-proc "$0" --inside "$@"
fi
shift
program=$(realpath "$1") launcher=$(realpath "$2") trials=$(realpath "$3")
export PATH=$PATH:/usr/sbin
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
chmod 755 "$folder"

# Two nodes, each a namespace with one end of a cable; the controller is in ours, beside a bridge.
hostname control
ip link set lo up
ip link add bridge type bridge && ip address add 10.77.0.1/24 dev bridge && ip link set bridge up
mkdir -p "$folder/run" && mount -t tmpfs none /run
for node in 1 2; do
  unshare --net sleep infinity &
  nodes[$node]=$!
  sleep 0.2
  ip link add "cable$node" type veth peer name eth0 netns "${nodes[$node]}"
  ip link set "cable$node" master bridge up
  in_node() { nsenter --net="/proc/${nodes[$1]}/ns/net" "${@:2}"; }
  in_node $node ip link set lo up
  in_node $node ip address add "10.77.0.1$node/24" dev eth0
  in_node $node ip link set eth0 up
done

# munge's key and socket, and Slurm's settings, are all in the folder.
mkdir -p "$folder/munge" /run/munge
head -c 128 /dev/urandom >"$folder/munge/key" && chmod 400 "$folder/munge/key"
munged --force --key-file "$folder/munge/key" --socket /run/munge/munge.socket.2 \
  --pid-file "$folder/munge/pid" --log-file "$folder/munge/log" --seed-file "$folder/munge/seed"
cat >"$folder/slurm.conf" <<CONF
ClusterName=fleet
SlurmctldHost=control(10.77.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=/run/munge/munge.socket.2
CryptoType=crypto/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool-%n
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd-%n.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
ReturnToService=2
SlurmdTimeout=6
SlurmctldTimeout=30
KillWait=2
MinJobAge=600
JobRequeue=1
SchedulerParameters=sched_interval=1,bf_interval=1
NodeName=n1 NodeAddr=10.77.0.11 CPUs=1 State=UNKNOWN
NodeName=n2 NodeAddr=10.77.0.12 CPUs=1 State=UNKNOWN
PartitionName=all Nodes=n1,n2 Default=YES State=UP
CONF
cat >"$folder/cgroup.conf" <<CONF
CgroupPlugin=cgroup/v1
CONF
export SLURM_CONF=$folder/slurm.conf
mkdir -p "$folder/state" "$folder/spool-n1" "$folder/spool-n2"
slurmctld
for node in 1 2; do in_node $node slurmd -N "n$node"; done
waiting() { for _ in $(seq 300); do "$@" && return 0; sleep 0.2; done; return 1; }
both_idle() { [ "$(sinfo -h -o %T -N 2>/dev/null | grep -c idle)" = 2 ]; }
waiting both_idle || { echo "the two nodes never became idle"; sinfo -N || true; tail -n 20 "$folder"/slurm*.log; exit 1; }

python3 "$trials" --make "$folder" --jobs 40
"$program" batch "$folder/fleet.batch" --output "$folder/alone" --quiet >/dev/null 2>&1 || true
"$program" batch "$folder/fleet.batch" --output "$folder/alone" --merge >/dev/null || true

# Each replay waits a little, so that the node dies in their midst.
cat >"$folder/slow" <<SLOW
#!/bin/sh
case "\$*" in *replay*) sleep 0.3 ;; esac
exec $program "\$@"
SLOW
cat >"$folder/foretouch" <<OWN
#!/bin/sh
case "\$*" in *--merge*) exec $program "\$@" ;; esac
exec $program "\$@" --program $folder/slow
OWN
chmod +x "$folder/slow" "$folder/foretouch"
export FORETOUCH=$folder/foretouch
"$launcher" "$folder/fleet.batch" "$folder/many" --shards 8 --wait >"$folder/launched" 2>&1 &
launched=$!
on_second() { squeue -h -t running -w n2 2>/dev/null | grep -q .; }
waiting on_second || { echo "nothing ran on the second node"; squeue; exit 1; }
sleep 1
# The node is gone: its daemons and all that they started, and its cable.
victims=$(for process in /proc/[0-9]*; do
  [ "$(readlink "$process/ns/net")" = "$(readlink "/proc/${nodes[2]}/ns/net")" ] && basename "$process"
done || true)
ip link set cable2 down
kill -9 $victims
echo "killed n2 with $(echo "$victims" | wc -w) processes"
code=0
wait $launched || code=$?
cat "$folder/launched" "$folder/many/slurm/merge.log"
[ $code = 1 ] || { echo "expected exit code 1 for the missing clip, found $code"; tail -n 30 "$folder/slurmctld.log"; exit 1; }
grep -qi "requeue" "$folder/slurmctld.log" || { echo "no task was queued again"; exit 1; }
cmp "$folder/alone/table.csv" "$folder/many/table.csv"
cmp "$folder/alone/report.html" "$folder/many/report.html"
echo "41 jobs in 8 tasks on two nodes, one killed: the same table and report"

#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
#
# slurm-single-host.sh - a real Slurm farm of N "machines" on one host, for a test suite run as root on Debian 12
# in a VM or container without systemd.  Nothing outside $DIR is written and nothing global is used:
# own munge key and socket, own config, own ports, own state.
#
#   slurm-single-host.sh start  DIR [NODES=2] [CPUS=2] [MEMORY_MB=4000]
#                                                with ACCOUNTING=1 in the environment: slurmdbd and MariaDB too, so that
#                                                sacct works (also needs slurmdbd mariadb-server-core mariadb-client-core);
#                                                with CGROUP=1: tasks are confined by cgroups v1 (memory, cores), and one
#                                                that takes too much ends as OUT_OF_MEMORY
#   slurm-single-host.sh env    DIR              what to eval to talk to it (SLURM_CONF)
#   slurm-single-host.sh kill   DIR NODE         the machine loses power: every process of it dies at once (SIGKILL)
#   slurm-single-host.sh daemon DIR NODE         only slurmd dies; its tasks go on (a crashed daemon)
#   slurm-single-host.sh freeze DIR NODE         slurmd stops answering, tasks go on (a network partition: after
#                                                SlurmdTimeout the tasks are requeued, and the SAME FRAMES are
#                                                rendered by two machines at once)
#   slurm-single-host.sh thaw   DIR NODE
#   slurm-single-host.sh boot   DIR NODE         power on again
#   slurm-single-host.sh down   DIR NODE         tell the controller at once that it is dead (no wait for the timeout)
#   slurm-single-host.sh stop   DIR
#
# Packages (Debian 12): slurmctld slurmd slurm-client munge (22.05.8, munge 0.5.15), --no-install-recommends.
# slurm-wlm is not needed.  With ACCOUNTING=1 also: slurmdbd mariadb-server-core mariadb-client-core.  The packages'
# own services do not start in a container (policy-rc.d), and the key they make, /etc/munge/munge.key, is not used.
# Measured: start to all nodes idle 0.5 s, with accounting 8 s; a dead machine's tasks are requeued after 15 s, and run
# again 10 s later.
#
# What was learned, and why each thing is here:
#  * A machine is a PID + UTS + mount namespace: its processes die together, as a machine's do, and its host name is
#    its own.  Killing slurmd alone is NOT a dead machine: slurmstepd is a process of its own and finishes the task,
#    which slurmctld counts as done.
#  * Debian's slurmd takes -N although it is built without --enable-multiple-slurmd; with a Port for each node and %n
#    in the paths, any number of them run on one host, all on the loopback.  No network namespaces are needed.
#  * slurmd must not be PID 1 of the namespace: nothing would reap its orphans.  A shell is, and waits.
#  * NodeHostname is what gethostname() gives in the machine's namespace; NodeAddr is 127.0.0.1 for all.
#  * SlurmctldHost=NAME(127.0.0.1): NAME must be this host's short name.  An empty value ("SlurmctldParameters=") is
#    a parse error.
#  * munged wants its key 0400 in a folder that others can't write, and its socket's path shorter than 108 bytes.
#  * AuthInfo=cred_expire=10: a requeued task may not start before the credential of its first try has expired, by
#    default 120 s (state PENDING, reason BeginTime).  This, not SlurmdTimeout, is what makes such tests slow.
#  * SlurmdTimeout=5: DOWN some 15 s after the death (a ping each third of it, plus the waits for answers).  `down`
#    tells slurmctld at once.
#  * ReturnToService=2: a node that comes back is used again without an administrator.
#  * JobRequeue=1 requeues on node failure only.  A task that exits with an error is FAILED and stays so, unless the
#    batch script itself says `scontrol requeue ${SLURM_ARRAY_JOB_ID}_${SLURM_ARRAY_TASK_ID}` (works from inside), or
#    RequeueExit= is set, which is the administrator's.  SLURM_RESTART_COUNT counts; --open-mode=append keeps the logs.
#  * afterok: of an array with one failed task never comes true and stays pending as DependencyNeverSatisfied, unless
#    --kill-on-invalid-dep=yes; a job that verifies and repairs must be afterany:.  aftercorr: pairs task by task.
#  * scancel and time limits send SIGTERM to every process of the task, the shell's children too, and SIGKILL after
#    KillWait.
#  * MpiDefault=none does not keep slurmd from trying the PMIx plugins: its log has errors of mpi/pmix that mean
#    nothing.
set -euo pipefail

say() { echo "slurm-single-host: $*" >&2; }
die() { say "$*"; exit 1; }
# SIGKILL or SIGTERM a process and wait until it is gone, 10 s at most; zombies of a parent that never reaps count.
gone() {
    local pid=$1 i
    for ((i = 0; i < 100; ++i)); do
        [[ -d /proc/$pid ]] || return 0
        [[ $(awk '{print $3}' "/proc/$pid/stat" 2>/dev/null || echo Z) == Z ]] && return 0
        sleep 0.1
    done
    return 1
}
wait_for() {  # SECONDS WHAT COMMAND…
    local end=$((SECONDS + $1)) what=$2
    shift 2
    until "$@" > /dev/null 2>&1; do
        ((SECONDS < end)) || die "waited in vain for $what"
        sleep 0.1
    done
}

command=${1:-} DIR=${2:-}
[[ -n $command && -n $DIR ]] || die "see the head of this file"
mkdir -p "$DIR"
DIR=$(cd "$DIR" && pwd)
export SLURM_CONF=$DIR/slurm.conf

node_state() { sinfo -h -N -n "$1" -o %t; }
idle() { [[ $(node_state "$1") == idle ]]; }
ports_free() { ! ss -Hltn "( sport = :$1 )" | grep -q .; }

boot() {  # NODE
    local node=$1
    mkdir -p "$DIR/spool/$node"
    # sh stays PID 1 of the machine: it reaps orphans, and its death is the machine's.
    setsid unshare --fork --pid --mount-proc --uts --kill-child -- \
        sh -c "hostname $node; slurmd -D -f $SLURM_CONF -N $node & trap 'kill \$!' TERM; while :; do wait; sleep 0.2; done" \
        > "$DIR/log/$node.out" 2>&1 < /dev/null &
    echo $! > "$DIR/$node.machine"
}

case $command in
start)
    nodes=${3:-2} cpus=${4:-2} memory=${5:-4000}
    for tool in slurmctld slurmd munged sinfo unshare; do
        command -v "$tool" > /dev/null || die "$tool is missing: apt-get install slurmctld slurmd slurm-client munge"
    done
    [[ $(id -u) == 0 ]] || die "must be root (namespaces, slurmd)"
    chmod 755 "$DIR"
    mkdir -p "$DIR"/{munge,state,spool,log}
    chmod 700 "$DIR/munge"
    # A port for the controller and one a node, from a base that is free.
    base=$((20000 + $$ % 10000))
    until ports_free "$base" && ports_free $((base + 1)); do base=$((base + 37)); done
    host=$(hostname -s)

    (umask 077; head -c 1024 /dev/urandom > "$DIR/munge/key")
    chmod 400 "$DIR/munge/key"
    munged --force --num-threads=2 --socket="$DIR/munge/socket" --key-file="$DIR/munge/key" \
        --log-file="$DIR/munge/log" --pid-file="$DIR/munge/pid" --seed-file="$DIR/munge/seed"
    wait_for 5 munged munge -S "$DIR/munge/socket" -n

    accounting=accounting_storage/none
    if [[ ${ACCOUNTING:-0} == 1 ]]; then
        accounting=accounting_storage/slurmdbd
        mkdir -p "$DIR/db/data"
        # mariadbd refuses to run as root unless told; no password: a socket and a port of the loopback.
        mariadb-install-db --no-defaults --user=root --datadir="$DIR/db/data" \
            --auth-root-authentication-method=socket --skip-test-db > "$DIR/log/mariadb-install.log" 2>&1
        mariadbd --no-defaults --user=root --datadir="$DIR/db/data" --socket="$DIR/db/socket" --port=$((base + 90)) \
            --bind-address=127.0.0.1 --pid-file="$DIR/db/pid" --innodb-buffer-pool-size=64M \
            --innodb-lock-wait-timeout=900 > "$DIR/log/mariadb.log" 2>&1 < /dev/null &
        sql=(mariadb --no-defaults -S "$DIR/db/socket" -u root)
        wait_for 20 mariadbd "${sql[@]}" -e 'select 1'
        "${sql[@]}" -e "create database slurm_acct_db; create user 'slurm'@'127.0.0.1' identified by 'slurm';
                        create user 'slurm'@'localhost' identified by 'slurm';
                        grant all on slurm_acct_db.* to 'slurm'@'127.0.0.1';
                        grant all on slurm_acct_db.* to 'slurm'@'localhost';"
        (umask 077; cat > "$DIR/slurmdbd.conf" <<CONF
AuthType=auth/munge
AuthInfo=socket=$DIR/munge/socket
DbdHost=localhost
DbdAddr=127.0.0.1
DbdPort=$((base + 91))
SlurmUser=root
LogFile=$DIR/log/slurmdbd.log
PidFile=$DIR/slurmdbd.pid
StorageType=accounting_storage/mysql
StorageHost=127.0.0.1
StoragePort=$((base + 90))
StorageUser=slurm
StoragePass=slurm
StorageLoc=slurm_acct_db
CONF
        )
        # slurmdbd looks for slurmdbd.conf beside $SLURM_CONF, and wants it 0600.
        slurmdbd 2> "$DIR/log/slurmdbd.err" || { cat "$DIR/log/slurmdbd.err" >&2; exit 1; }
        wait_for 20 slurmdbd bash -c "exec 3<> /dev/tcp/127.0.0.1/$((base + 91))"
    fi

    # Without cgroups: processes are found by their parents, a task above --mem is killed when the next poll sees it
    # (state FAILED, ExitCode 0:9), and cores are counted but not confined.
    tracking=proctrack/linuxproc task=task/none gather=jobacct_gather/linux params=OverMemoryKill
    : > "$DIR/cgroup.conf"
    if [[ ${CGROUP:-0} == 1 ]]; then
        for controller in memory cpuset freezer cpuacct; do
            [[ -w /sys/fs/cgroup/$controller/cgroup.procs ]] || die "no cgroup v1 controller $controller to write to"
        done
        printf 'CgroupPlugin=cgroup/v1\nConstrainRAMSpace=yes\nConstrainCores=yes\n' > "$DIR/cgroup.conf"
        tracking=proctrack/cgroup task=task/cgroup gather=jobacct_gather/cgroup params=
    fi
    {
        cat <<CONF
ClusterName=keyline
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$base
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$DIR/munge/socket,cred_expire=10
StateSaveLocation=$DIR/state
SlurmdSpoolDir=$DIR/spool/%n
SlurmctldPidFile=$DIR/slurmctld.pid
SlurmdPidFile=$DIR/slurmd.%n.pid
SlurmctldLogFile=$DIR/log/slurmctld.log
SlurmdLogFile=$DIR/log/slurmd.%n.log
ProctrackType=$tracking
TaskPlugin=$task
MpiDefault=none
JobAcctGatherType=$gather
JobAcctGatherFrequency=task=1
AccountingStorageType=$accounting
AccountingStorageHost=127.0.0.1
# With auth/munge this "password" is the socket of the munged to use; without it sacctmgr asks the default one.
AccountingStoragePass=$DIR/munge/socket
AccountingStoragePort=$((base + 91))
# One line of text a job that ended: state, exit code, node, times.  What sacct would tell, without slurmdbd.
JobCompType=jobcomp/filetxt
JobCompLoc=$DIR/log/jobcomp.txt
# CPUs and memory are counted; a task above its --mem is killed (polled every second).
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
DefMemPerCPU=500
${params:+JobAcctGatherParams=$params}
SchedulerType=sched/builtin
SchedulerParameters=batch_sched_delay=0,sched_interval=2,requeue_setup_env_fail
# A dead machine is noticed soon and welcomed back.
SlurmdTimeout=5
SlurmctldTimeout=5
MessageTimeout=5
TCPTimeout=1
KillWait=5
BatchStartTimeout=5
ReturnToService=2
JobRequeue=1
MaxArraySize=10001
MaxJobCount=20000
MinJobAge=600
CONF
        names=()
        for ((i = 1; i <= nodes; ++i)); do
            echo "NodeName=n$i NodeHostname=n$i NodeAddr=127.0.0.1 Port=$((base + i)) CPUs=$cpus RealMemory=$memory"
            names+=("n$i")
        done
        echo "PartitionName=farm Nodes=$(IFS=,; echo "${names[*]}") Default=YES MaxTime=INFINITE State=UP"
    } > "$SLURM_CONF"

    # With accounting the cluster must be known before slurmctld starts, or it ends with "not registered".
    [[ $accounting == accounting_storage/none ]] || sacctmgr -i add cluster keyline > "$DIR/log/sacctmgr.log" 2>&1 || true
    slurmctld -f "$SLURM_CONF" 2> "$DIR/log/slurmctld.err" || { cat "$DIR/log/slurmctld.err" >&2; exit 1; }
    wait_for 10 slurmctld scontrol ping
    for ((i = 1; i <= nodes; ++i)); do boot "n$i"; done
    for ((i = 1; i <= nodes; ++i)); do wait_for 20 "node n$i" idle "n$i"; done
    ;;
env) echo "export SLURM_CONF=$SLURM_CONF" ;;
boot)
    boot "$3"
    wait_for 30 "node $3" idle "$3"
    ;;
kill)
    # The unshare process waits for PID 1 of the machine, its only child: when that dies, so does every process in it.
    machine=$(cat "$DIR/$3.machine")
    init=$(ps -o pid= --ppid "$machine" | tr -d ' ')
    kill -KILL "$init"
    gone "$init" || die "$3 does not die"
    rm -f "$DIR/slurmd.$3.pid"
    ;;
daemon | freeze | thaw)
    machine=$(cat "$DIR/$3.machine")
    init=$(ps -o pid= --ppid "$machine" | tr -d ' ')
    slurmd=$(ps -o pid=,comm= --ppid "$init" | awk '$2 == "slurmd" {print $1}')
    case $command in
    daemon) kill -KILL "$slurmd" ;;
    freeze) kill -STOP "$slurmd" ;;
    thaw) kill -CONT "$slurmd" ;;
    esac
    ;;
down) scontrol update nodename="$3" state=down reason="lost" ;;
stop)
    # The controller first, so that it does not requeue what dies next.
    [[ -f $DIR/slurmctld.pid ]] && { pid=$(cat "$DIR/slurmctld.pid"); kill "$pid" 2> /dev/null || true; gone "$pid" || kill -KILL "$pid"; }
    for file in "$DIR"/*.machine; do
        [[ -f $file ]] || continue
        machine=$(cat "$file")
        init=$(ps -o pid= --ppid "$machine" | tr -d ' ' || true)
        [[ -n $init ]] && kill -KILL "$init" 2> /dev/null || true
        gone "$machine" || true
    done
    for file in slurmdbd.pid db/pid; do
        [[ -f $DIR/$file ]] && { pid=$(cat "$DIR/$file"); kill "$pid" 2> /dev/null || true; gone "$pid" || true; }
    done
    # Control groups outlive the machines that were killed.
    if grep -q cgroup/v1 "$DIR/cgroup.conf" 2> /dev/null; then
        for node in $(sed -n 's/^NodeName=\([^ ]*\).*/\1/p' "$SLURM_CONF"); do
            find /sys/fs/cgroup/*/"slurm_$node" -depth -type d -exec rmdir {} \; 2> /dev/null || true
        done
    fi
    [[ -f $DIR/munge/pid ]] && { pid=$(cat "$DIR/munge/pid"); kill "$pid" 2> /dev/null || true; gone "$pid" || true; }
    ;;
*) die "unknown command $command" ;;
esac

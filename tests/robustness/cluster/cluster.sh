#!/usr/bin/env bash
# A Slurm cluster of several nodes on this machine, in its own folder.
#   cluster.sh start FOLDER [NODES]   three nodes by default; slurmctld, and one slurmd per node
#   cluster.sh slurmctld FOLDER       starts a controller that has been killed
#   cluster.sh node FOLDER NAME       starts a node that has been killed
#   cluster.sh stop FOLDER            ends all of them, even with jobs running
# Process numbers are in FOLDER/NAME.pid, output in FOLDER/NAME.log. Slurm's commands need SLURM_CONF=FOLDER/slurm.conf.
# Installs slurm-wlm and munge (Debian, Ubuntu) if they are missing; needs root, like slurmd.
set -euo pipefail

usage() { sed -n '2,8s/^# \{0,1\}//p' "$0" >&2; exit 2; }
fail() { echo "cluster: $*" >&2; exit 1; }
[ $# -ge 2 ] || usage
[ "$(id -u)" = 0 ] || fail "slurmd needs root"
mkdir -p "$2"
folder=$(cd "$2" && pwd)
export SLURM_CONF=$folder/slurm.conf

is_there() { [ -e "$folder/$1.pid" ] && kill -0 "$(cat "$folder/$1.pid")" 2>/dev/null; }

# Waits until a command succeeds.
wait_for() {
    for _ in $(seq 300); do
        "$@" >/dev/null 2>&1 && return
        sleep 0.1
    done
    fail "timed out waiting for: $*"
}

run() { # NAME COMMAND...
    local name=$1
    shift
    "$@" </dev/null >>"$folder/$name.log" 2>&1 &
    echo $! >"$folder/$name.pid"
}

install() {
    local packages=()
    command -v slurmctld >/dev/null && command -v slurmd >/dev/null || packages+=(slurm-wlm)
    command -v munged >/dev/null || packages+=(munge)
    [ ${#packages[@]} = 0 ] && return
    # Neither package may start its own daemon.
    DEBIAN_FRONTEND=noninteractive RUNLEVEL=1 apt-get -qq -o DPkg::Lock::Timeout=300 install "${packages[@]}" >&2
}

# One port per daemon, from a free range.
first_port() {
    local port
    for port in 17100 18100 19100 20100 21100; do
        ss -ltn 2>/dev/null | grep -q ":$((port / 100))[0-9][0-9] " || { echo "$port"; return; }
    done
    fail "no free ports"
}

configure() { # NODES
    local port
    port=$(first_port)
    mkdir -p "$folder/state" "$folder/spool"
    cat >"$folder/slurm.conf" <<CONF
ClusterName=candela
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmctldPort=$port
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool/%n
SlurmctldPidFile=$folder/slurmctld.own.pid
SlurmdPidFile=$folder/%n.own.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
SlurmctldTimeout=10
SlurmdTimeout=10
ReturnToService=2
KillWait=2
NodeName=node[1-$1] NodeHostname=$(hostname -s) NodeAddr=127.0.0.1 Port=[$((port + 1))-$((port + $1))] CPUs=1 State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
}

start_munge() {
    chmod 755 "$folder"
    (umask 077 && head -c 128 /dev/urandom >"$folder/munge.key")
    run munged munged --foreground --force --key-file="$folder/munge.key" --socket="$folder/munge.socket" \
        --pid-file="$folder/munged.own.pid" --log-file="$folder/munged.own.log" --seed-file="$folder/munged.seed"
    wait_for test -S "$folder/munge.socket"
}

start_slurmctld() {
    run slurmctld slurmctld -D -f "$folder/slurm.conf"
    wait_for scontrol ping
    wait_for sh -c 'scontrol ping | grep -q UP'
}

start_node() { # NAME
    run "$1" slurmd -D -f "$folder/slurm.conf" -N "$1"
    wait_for sh -c "sinfo -h -n $1 -o %t | grep -Eq '^(idle|mix|alloc)$'"
}

stop() {
    local file
    # Jobs first: slurmd leaves them alone.
    scancel -u root 2>/dev/null || true
    for file in "$folder"/node*.pid "$folder/slurmctld.pid" "$folder/munged.pid"; do
        case $file in *.own.pid | *\**) continue ;; esac
        [ -e "$file" ] || continue
        kill "$(cat "$file")" 2>/dev/null || true
    done
    for file in "$folder"/*.pid; do
        case $file in *.own.pid | *\**) continue ;; esac
        for _ in $(seq 50); do
            kill -0 "$(cat "$file")" 2>/dev/null || break
            sleep 0.1
        done
        kill -KILL "$(cat "$file")" 2>/dev/null || true
        rm -f "$file"
    done
}

case $1 in
    start)
        nodes=${3:-3}
        install
        is_there slurmctld && fail "'$folder' already contains a cluster"
        configure "$nodes"
        start_munge
        start_slurmctld
        for i in $(seq "$nodes"); do start_node "node$i"; done
        ;;
    slurmctld) start_slurmctld ;;
    node) [ $# -eq 3 ] || usage; start_node "$3" ;;
    stop) stop ;;
    *) usage ;;
esac

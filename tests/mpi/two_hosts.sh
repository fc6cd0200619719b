#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
#
# two_hosts.sh MPIRUN HOOKE
# Runs ranks on two "hosts" of this machine: network namespaces with host names of their own, joined by a cable. The state
# hash over TCP is that of one process. Where the cable is cut, the keepalive settings of docs/cluster.md end the run,
# and its last checkpoint is good. Exits with 77, and a reason, where it can't make such hosts.
set -euo pipefail
mpirun=$1
hooke=$2

skip() {
  echo "skipped: $*"
  exit 77
}
fail() {
  echo "failed: $*" >&2
  exit 1
}

[[ -n $mpirun && -x $mpirun ]] || skip "this build has no MPI, or mpirun is not there"
for tool in ip unshare hostname; do
  command -v "$tool" >/dev/null || skip "$tool is not installed"
done

near=hooke-near-$$
far=hooke-far-$$
work=$(mktemp -d)
clean_up() {
  for host in "$near" "$far"; do
    ip netns pids "$host" 2>/dev/null | xargs -r kill -KILL 2>/dev/null || true
    ip netns del "$host" 2>/dev/null || true
  done
  rm -rf "$work"
}
trap clean_up EXIT
trap 'exit 1' INT TERM HUP

for host in "$near" "$far"; do
  reason=$(ip netns add "$host" 2>&1) || skip "no network namespaces (root?): $reason"
done
reason=$(ip netns exec "$near" unshare --uts true 2>&1) || skip "no host names of their own: $reason"
reason=$(ip -n "$near" link add cable type veth peer name cable netns "$far" 2>&1) || skip "no cable: $reason"
ip -n "$near" address add 10.77.0.1/24 dev cable
ip -n "$far" address add 10.77.0.2/24 dev cable
for host in "$near" "$far"; do
  ip -n "$host" link set lo up
  ip -n "$host" link set cable up
done

# enter HOST COMMAND...: runs a shell command there.
cat >"$work/enter" <<'EOF'
#!/usr/bin/env bash
host=$1
shift
exec ip netns exec "$host" unshare --uts bash -c 'hostname "$1"; shift; eval "$*"' enter "$host" "$@"
EOF
# What mpirun starts on the other host, in place of ssh: its first argument is the address.
cat >"$work/agent" <<EOF
#!/usr/bin/env bash
shift
exec "$work/enter" "$far" "\$@"
EOF
chmod +x "$work/enter" "$work/agent"

export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
export OMPI_MCA_mpi_yield_when_idle=1 OMPI_MCA_hwloc_base_binding_policy=none
cd "$work"
cat >scene.json <<'EOF'
{ "hooke": 1, "name": "two hosts", "time": { "step": 0.005, "steps": 100 },
  "domain": { "min": [0, 0, 0], "max": [8, 8, 8] },
  "materials": { "water": { "radius": 0.2, "mass": 1, "stiffness": 6000, "shear": 2, "damping": 8 } },
  "particles": [ { "material": "water", "block": { "min": [0.3, 0.3, 0.3], "max": [4.8, 4.8, 4.8], "spacing": 0.4,
                                                   "lattice": "cubic", "jitter": 0.01, "seed": 3 },
                   "velocity": [3, 0, 0] } ],
  "output": { "every_steps": 20 } }
EOF

# on_both WORDS OF MPIRUN... -- WORDS OF HOOKE...: one rank here, two there, and nothing but TCP between them.
on_both() {
  local words=("$mpirun" -q --host "10.77.0.1:1,10.77.0.2:2" -np 3 --mca plm_rsh_agent "$work/agent"
    --mca btl "tcp,self" --mca btl_tcp_if_include 10.77.0.0/24 --mca oob_tcp_if_include 10.77.0.0/24)
  while [[ $1 != -- ]]; do
    words+=("$1")
    shift
  done
  shift
  exec "$work/enter" "$near" "${words[*]@Q} ${hooke@Q} ${*@Q}"
}
hash_of() { sed -n 's/.*"state_hash": "\([0-9a-f]*\)".*/\1/p' "$1/report.json"; }

"$hooke" run scene.json -o alone >alone.log 2>&1 || fail "one process: $(cat alone.log)"
(on_both -- run scene.json -o together) >together.log 2>&1 || fail "two hosts: $(cat together.log)"
[[ -n $(hash_of alone) && $(hash_of together) == "$(hash_of alone)" ]] || fail "hashes over TCP differ"
grep -q '"ranks": 3' together/report.json || fail "not on three ranks"
for file in particles.vtkhdf checkpoint.h5; do
  cmp "alone/$file" "together/$file" || fail "$file differs"
done
echo "over TCP: the state hash of one process, $(hash_of together)"

# The cable ---------------------------------------------------------------------------------------------------------

steps=20000 # longer than anyone waits
on_both --mca oob_tcp_keepalive_time 3 --mca oob_tcp_keepalive_intvl 1 --mca oob_tcp_keepalive_probes 3 \
  -- run scene.json -o cut --steps $steps --checkpoint-every 0.1 >cut.log 2>&1 &
run=$!
step_of() { "$hooke" info "$1" | sed -n 's/^ *state *step \([0-9,]*\), .*/\1/p' | tr -d ,; }
for ((k = 0; k < 600; ++k)); do
  [[ -e cut/checkpoint.h5 ]] && (($(step_of cut/checkpoint.h5) >= 40)) && break
  kill -0 $run 2>/dev/null || fail "it ended early: $(cat cut.log)"
  sleep 0.1
done
((k < 600)) || fail "no checkpoint in a minute: $(cat cut.log)"
ip -n "$near" link set cable down
SECONDS=0
while kill -0 $run 2>/dev/null; do
  ((SECONDS < 40)) || fail "mpirun goes on 40 s after the cable was cut"
  sleep 0.1
done
took=$SECONDS
status=0
wait $run || status=$?
((status != 0)) || fail "mpirun ended well without a cable"
((took <= 20)) || fail "mpirun ended only after $took s"
echo "cable cut: mpirun ended after $took s with status $status"
for ((k = 0; k < 200; ++k)); do
  [[ -z $(ip netns pids "$far") ]] && break
  sleep 0.1
done
[[ -z $(ip netns pids "$far") ]] || fail "the other host computes on"
echo "cable cut: nothing ran on the other host after $SECONDS s"

# It goes on from there, to the state that a run without a cut would have.
done_steps=$(step_of cut/checkpoint.h5)
more=$((done_steps + 50))
"$hooke" run scene.json -o whole --steps $more >whole.log 2>&1 || fail "whole: $(cat whole.log)"
"$hooke" run scene.json -o cut --steps $more --resume cut/checkpoint.h5 >resumed.log 2>&1 || fail "resumed: $(cat resumed.log)"
[[ $(hash_of cut) == "$(hash_of whole)" ]] || fail "the run that was cut ends in another state"
echo "cable cut: the checkpoint of step $done_steps is good"

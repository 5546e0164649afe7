#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
#
# slurm_test.sh KEYLINE: sixty frames on a real Slurm of two machines, one of which loses power, while the other is
# cut off and goes on.  Then all is there, the same as of one process, and nothing is left over.
# Status 77 where it can't be tried here.
set -euo pipefail
keyline=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
for tool in slurmctld slurmd munged sbatch unshare; do
    command -v $tool > /dev/null || { echo "skipped: $tool is not installed"; exit 77; }
done
[[ $(id -u) == 0 ]] || { echo "skipped: not root"; exit 77; }
unshare --fork --pid --mount-proc --uts true 2> /dev/null || { echo "skipped: no namespaces"; exit 77; }

. "$here/set_up.sh"
farm start 2 1 4000
export SLURM_CONF=$work/farm/slurm.conf
"$keyline" submit slurm small.json --frames 1-60 --chunk 5 --wait 2> wait.log &
waiting=$!
sleep 3
farm kill n2
farm freeze n1
sleep 1
farm thaw n1
farm down n2
farm boot n2
wait $waiting || fail "the job ended with status $?"
cat wait.log

"$keyline" verify small.json --frames 1-60 > verify.txt || fail "not all are current"
grep -q '^60 outputs: 60 current$' verify.txt || fail "$(tail -n 1 verify.txt)"
render_alone 1-60
compare_with_alone
echo "ok: 60 frames, $(grep -c NODE_FAIL farm/log/jobcomp.txt || true) tasks lost with their machine"

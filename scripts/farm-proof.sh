#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
#
# farm-proof.sh KEYLINE [FRAMES] [SEED]: a sequence on a real Slurm of three machines on this one, which lose power, are cut
# off while their tasks go on, and come back, at random.  At the end all frames must be current, byte for byte those of a
# single process, and nothing may lie beside them.  Prints a Markdown table of figures, and writes the plot of it all.
# As root; needs slurmctld, slurmd, slurm-client and munge.
set -euo pipefail
keyline=$(realpath "$1") frames=${2:-1000} seed=${3:-7}
here=$(cd "$(dirname "$0")/.." && pwd)
plot=${PLOT:-$PWD/farm-proof.svg}
machines=3 chunk=10

. "$here/tests/farm/set_up.sh"
farm start $machines 1 4000
export SLURM_CONF=$work/farm/slurm.conf
begun=$SECONDS
"$keyline" submit slurm small.json --frames "1-$frames" --chunk $chunk --wait 2> wait.log &
waiting=$!

# An event every few seconds: "SECOND MACHINE WHAT", and how many frames are there each second.
RANDOM=$seed
state=(up up up)
declare -A count=([power]=0 [cut]=0 [back]=0)
happened() { echo "$((SECONDS - begun)) $1 $2" >> events; count[$2]=$((count[$2] + 1)); }
back() {
    if [[ ${state[$1]} == dead ]]; then farm boot "n$(($1 + 1))" & else farm thaw "n$(($1 + 1))"; fi
    state[$1]=up
    happened "n$(($1 + 1))" back
}
for ((second = 1; ; ++second)); do
    kill -0 $waiting 2> /dev/null || break
    sleep 1
    echo "$((SECONDS - begun)) $(find out -maxdepth 1 -name 's.*.exr' 2> /dev/null | wc -l)" >> progress
    ((second % 7 == 3)) || continue
    k=$((RANDOM % machines))
    away=0
    for s in "${state[@]}"; do [[ $s == up ]] || away=$((away + 1)); done
    if [[ ${state[k]} != up ]]; then
        back $k
    elif ((away < machines - 1)); then
        if ((RANDOM % 3)); then
            farm kill "n$((k + 1))" && farm down "n$((k + 1))"
            state[k]=dead
            happened "n$((k + 1))" power
        else
            farm freeze "n$((k + 1))"
            state[k]=frozen
            happened "n$((k + 1))" cut
        fi
    fi
done
wait $waiting || fail "the job ended with status $?: $(tail -n 3 wait.log)"
took=$((SECONDS - begun))

"$keyline" verify small.json --frames "1-$frames" > verify.txt || fail "$(tail -n 1 verify.txt)"
alone=$SECONDS
render_alone "1-$frames"
alone=$((SECONDS - alone))
compare_with_alone

tries=$(grep -c JobState= farm/log/jobcomp.txt)
lost=$(grep -c NODE_FAIL farm/log/jobcomp.txt || true)
cat << TABLE
| | |
| --- | --- |
| frames, in tasks of $chunk, on $machines machines of one core | $frames |
| machines that lost power, with their tasks | ${count[power]} |
| machines that were cut off, while their tasks went on | ${count[cut]} |
| returns | ${count[back]} |
| tries of tasks that Slurm wrote down; of these lost with their machine | $tries; $lost |
| seconds; of a single process with both cores | $took; $alone |
| frames current at the end, and equal to the single process's | $frames |
| files left over | 0 |
TABLE

# Frames that were there over time, with what happened to the machines.
awk -v took="$took" -v frames="$frames" '
function x(t) { return 60 + 820 * t / took }
FILENAME == "progress" { line = line (line == "" ? "M" : "L") sprintf("%.1f %.1f", x($1), 250 - 190 * $2 / frames) }
FILENAME == "events" {
    row = 278 + 16 * (substr($2, 2) - 1)
    if ($3 == "back") { if ($2 in since) { bars = bars bar($2, since[$2], $1, row); delete since[$2] } }
    else { since[$2] = $1; kind[$2] = $3; rows[$2] = row }
}
function bar(machine, from, to, row) {
    return sprintf("<path d=\"M%.1f %dH%.1f\" stroke=\"%s\" stroke-width=\"9\"/>\n", x(from), row, x(to),
                   kind[machine] == "power" ? "#b3261e" : "#e0a030")
}
END {
    for (m in since) bars = bars bar(m, since[m], took, rows[m])
    print "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 900 350\" font-family=\"sans-serif\" font-size=\"12\">"
    print "<rect width=\"900\" height=\"350\" fill=\"#fff\"/>"
    print "<path d=\"M60 60H880M60 155H880M60 250H880\" stroke=\"#ddd\"/>"
    printf "<text x=\"60\" y=\"28\">Frames that were there, while machines lost power (red) and were cut off (yellow)</text>\n"
    printf "<text x=\"52\" y=\"64\" text-anchor=\"end\">%d</text><text x=\"52\" y=\"254\" text-anchor=\"end\">0</text>\n", frames
    for (i = 0; i < 3; ++i) printf "<text x=\"52\" y=\"%d\" text-anchor=\"end\">n%d</text>\n", 282 + 16 * i, i + 1
    printf "<path d=\"%s\" fill=\"none\" stroke=\"#2f6db3\" stroke-width=\"2\"/>\n%s", line, bars
    printf "<text x=\"60\" y=\"338\">0 s</text><text x=\"880\" y=\"338\" text-anchor=\"end\">%d s</text></svg>\n", took
}' progress events > "$plot"

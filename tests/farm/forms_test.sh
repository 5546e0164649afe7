#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
#
# forms_test.sh MANAGER KEYLINE: what `keyline submit MANAGER` writes is read by a reader of that form which is not ours
# (xmllint, jq, tclsh, node), broken copies of it are refused, and what it says is done: the tasks are run as the manager
# would run them.  Then all outputs are current.  Names hold blanks and quotes, which every form must bring through.
# Status 77 where the reader is not installed.
set -euo pipefail
manager=$1 keyline=$(realpath "$2")
forms=$(cd "$(dirname "$0")" && pwd)/forms
declare -A readers=([opencue]=xmllint [afanasy]=jq [tractor]=tclsh [deadline]=bash [flamenco]=node [openjd]=python3)
command -v "${readers[$manager]}" > /dev/null || { echo "skipped: ${readers[$manager]} is not installed"; exit 77; }

work=$(mktemp -d "/tmp/keyline form XXXXXX")
trap 'rm -rf "$work"' EXIT
fail() { echo "FAILED: $*"; exit 1; }
# Runs a command that must fail; it is a copy that was broken on purpose.
refused() { if "$@" > "$work/told" 2>&1; then fail "was taken: $*"; fi; }
# The parts of 1-7 in threes.
parts=(1-3 4-6 7-7)

cd "$work"
cat > "a shot.json" << 'JSON'
{ "keyline": 1,
  "variables": { "who": "nobody" },
  "nodes": {
    "c":   { "type": "constant", "color": ["${frame}", 0.2, 0.3, 1], "size": [40, 30] },
    "out": { "type": "write", "in": "c", "file": "out/${who}.####.exr" } } }
JSON
render=(submit "$manager" "a shot.json" --frames 1-7 --chunk 3 --name look_01 --job job --var "who=the artist's & co")

opencue() {
    local form=job/opencue.xml part command
    "$keyline" "${render[@]}" --user artist --show demo --shot s010
    valid() { xmllint --noout --nonet --dtdvalid "$forms/opencue.dtd" "$1"; }
    # The document type that it names is Cuebot's own, on its own machine.
    plain() { sed '/^<!DOCTYPE/d' "$form"; }
    plain > job/plain.xml
    valid job/plain.xml
    plain | sed 's/<layer name="render" type="Render">/<layer name="render" type="Rendering">/' > job/type.xml
    plain | sed 's/<range>1-7<\/range>//' > job/range.xml
    plain | sed 's/ & / \& /; s/&amp;/\&/' > job/text.xml
    plain | sed 's/<show>demo<\/show>//' > job/show.xml
    plain | sed 's/name="look_01"/name="look 01"/' > job/name.xml
    local broken
    for broken in type range text show name; do refused valid "job/$broken.xml"; done
    of() { xmllint --xpath "string(//layer[@name='$1']/$2)" job/plain.xml; }
    [[ $(of render range) == 1-7 && $(of render chunk) == 3 ]] || fail "another range"
    command=$(of render cmd)
    for part in "${parts[@]}"; do /bin/sh -c "${command//#FRAMESPEC#/$part}"; done
    /bin/sh -c "$(of verify cmd)"
}

afanasy() {
    "$keyline" "${render[@]}"
    valid() { jq -e -f "$forms/afanasy.jq" "$1" > /dev/null; }
    valid job/afanasy.json
    jq 'del(.job.user_name)' job/afanasy.json > job/user.json
    jq '.job.blocks[0].need_memory = "much"' job/afanasy.json > job/memory.json
    jq '.job.blocks[0].tasks = []' job/afanasy.json > job/tasks.json
    jq '.job.blocks[1].depend_mask = "rendered"' job/afanasy.json > job/depend.json
    local broken
    for broken in user memory tasks depend; do refused valid "job/$broken.json"; done
    jq -r '.job.blocks[] | .command as $shared | .tasks[].command as $own | $shared | split("@#@") | join($own)' \
        job/afanasy.json > job/commands
    [[ $(wc -l < job/commands) == 4 ]] || fail "not four tasks"
    local command
    while read -r command; do bash -c "$command" < /dev/null; done < job/commands
}

tractor() {
    "$keyline" "${render[@]}"
    read_form() { tclsh "$forms/tractor.tcl" "$@"; }
    sed 's/-service/-servise/' job/tractor.alf > job/option.alf
    sed 's/^    Task -title {1-3} -cmds {/&{/' job/tractor.alf > job/brace.alf
    sed 's/RemoteCmd/RemoteCommand/' job/tractor.alf > job/operator.alf
    local broken
    for broken in option brace operator; do refused read_form "job/$broken.alf"; done
    [[ $(read_form job/tractor.alf) == "1 jobs, 5 tasks, 4 commands" ]] || fail "$(read_form job/tractor.alf)"
    read_form job/tractor.alf run
    if "$keyline" submit tractor "a shot.json" --frames 1 --job job --var 'who=100 %' 2> job/told; then
        fail "a sign of Tractor's own was passed on"
    fi
}

deadline() {
    "$keyline" "${render[@]}" --pool p1
    local known="Plugin Name Frames ChunkSize Pool Group OutputDirectory[0-9]+ JobDependencies Executable Arguments"
    known+=" StartupDirectory ShellExecute SingleFramesOnly"
    valid() { ! grep -vE "^(${known// /|})=." "$1"; }
    local form part arguments
    for form in render verify; do valid job/$form.job && valid job/$form.plugin || fail "$form has another key"; done
    sed 's/ChunkSize/Chunk Size/' job/render.job > job/key
    refused valid job/key
    of() { sed -n "s/^$2=//p" "job/$1"; }
    [[ $(of render.job Frames) == 1-7 && $(of render.job ChunkSize) == 3 ]] || fail "another range"
    arguments=$(of render.plugin Arguments)
    arguments=${arguments//<QUOTE>/\"}
    for part in "${parts[@]}"; do
        local task=${arguments//<STARTFRAME>/${part%-*}}
        task=${task//<ENDFRAME>/${part#*-}}
        eval "\"$(of render.plugin Executable)\" $task"
    done
    arguments=$(of verify.plugin Arguments)
    eval "\"$(of verify.plugin Executable)\" ${arguments//<QUOTE>/\"}"
    # A task is told its first and its last frame: what lies between must be all its own.
    "$keyline" submit deadline "a shot.json" --frames 1-9x2 --chunk 3 --job steps
    grep -qx 'ChunkSize=1' steps/render.job || fail "frames that were not asked for would be rendered"
}

flamenco() {
    "$keyline" "${render[@]}"
    read_form() { node "$forms/flamenco.js" job/keyline.js "$@"; }
    jq_like() { node -e 'const j = JSON.parse(require("fs").readFileSync("job/flamenco.json"));'"$1"'; console.log(JSON.stringify(j));'; }
    jq_like 'delete j.settings.graph' > job/graph.json
    jq_like 'j.settings.chunk_size = "3"' > job/chunk.json
    jq_like 'j.settings.sigma = 3' > job/unknown.json
    local broken
    for broken in graph chunk unknown; do refused read_form "job/$broken.json"; done
    read_form job/flamenco.json run
    "$keyline" submit flamenco "a shot.json" --frames 1-5x2,8,9 --job steps
    grep -q '"frames": "1,3,5,8-9"' steps/flamenco.json || fail "$(grep frames steps/flamenco.json)"
}

openjd() {
    "$keyline" "${render[@]/--job/--bundle}"
    # The workers' own Keyline, in their path.
    PATH=$(dirname "$keyline"):$PATH python3 "$forms/openjd.py" job run
}

"$manager"
"$keyline" verify "a shot.json" --frames 1-7 --var "who=the artist's & co" > told || fail "$(cat told)"
grep -q '^7 outputs: 7 current$' told || fail "$(tail -n 1 told)"
echo "ok: $manager"

# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
#
# Sourced with $keyline set: a folder of its own for a farm on this machine, gone at the end, with a small sequence in it.
farms=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d /tmp/keyline-farm-XXXXXX)
farm() {
    "$farms/slurm-single-host.sh" "$1" "$work/farm" "${@:2}" 2>> "$work/farm.log" || { cat "$work/farm.log" >&2; return 1; }
}
end() { farm stop || true; rm -rf "$work"; }
trap end EXIT
fail() { echo "FAILED: $*"; tail -n 20 "$work"/*.log || true; exit 1; }

# In another folder, by one process: what the farm's outputs must be, byte for byte.
render_alone() {
    mkdir alone
    cp small.json alone
    "$keyline" render alone/small.json --frames "$1" --progress none 2> alone.log
}
compare_with_alone() {
    for file in alone/out/*.exr; do cmp -s "$file" "out/${file##*/}" || fail "$file is another one"; done
    [[ -z $(find out -name '.*keyline*') ]] || fail "left over: $(find out -name '.*keyline*')"
}

cd "$work"
cat > small.json << 'JSON'
{ "keyline": 1,
  "nodes": {
    "c":    { "type": "constant", "color": ["${frame}", 0.2, 0.3, 1], "size": [400, 300] },
    "soft": { "type": "gaussian", "in": "c", "sigma": 20 },
    "out":  { "type": "write", "in": "soft", "file": "out/s.####.exr" } } }
JSON

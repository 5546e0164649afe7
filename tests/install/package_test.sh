#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
#
# package_test.sh BUILD FOLDER: makes the Debian package and the tarball of a build, and renders with each where nothing else
# of Keyline is: the tarball on a system that has the C library and a shell alone.  Status 77 where Debian's tools are
# not there.
set -euo pipefail
build=$1 folder=$2
command -v dpkg-deb > /dev/null && command -v dpkg-shlibdeps > /dev/null || { echo "skipped: no dpkg"; exit 77; }
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
fail() { echo "FAILED: $*"; exit 1; }

cat > graph.json << 'JSON'
{ "keyline": 1,
  "nodes": {
    "c":    { "type": "constant", "color": [0.5, 0.25, 0], "size": [64, 64] },
    "soft": { "type": "gaussian", "in": "c", "sigma": 3 },
    "out":  { "type": "write", "in": "soft", "file": "out.exr" } } }
JSON

pack() { cpack --config "$build/CPackConfig.cmake" -G "$1" -B "$folder/$1" > "$1.log" 2>&1 || fail "$(tail -n 30 "$1.log")"; }

pack DEB
deb=$(echo DEB/*.deb)
[[ $(dpkg-deb --field "$deb" Package) == keyline ]] || fail "another name"
for library in libopenexr-3-1-30 libopenimageio2.4 libopencolorio2.1 libc6; do
    dpkg-deb --field "$deb" Depends | grep -q "$library" || fail "$library is not asked for"
done
dpkg-deb --contents "$deb" > contents
for file in bin/keyline lib/keyline/keyline-exr-helper share/keyline/graphs/toon.json share/keyline/graphs/groups/canny.json; do
    grep -q "usr/$file\$" contents || fail "the package has no $file"
done
if grep -q 'include/\|lib/keyline/libraries' contents; then fail "the package has what only others need"; fi
dpkg-deb --extract "$deb" system
system/usr/bin/keyline render graph.json --progress none
system/usr/bin/keyline render graph.json --progress none --set out.file=out.png
mv out.exr of_package.exr

pack TGZ
tar --extract --file TGZ/*.tar.gz
tree=$(echo keyline-*-linux-*)
(unset LD_LIBRARY_PATH; "$tree/check") || fail "it does not run here"
inside() { unshare --mount --pid --fork /bin/sh -c 'mount -t proc proc bare/proc && exec chroot bare "$@"' inside "$@"; }
if mkdir -p bare/proc && unshare --mount --pid --fork mount -t proc proc bare/proc 2> /dev/null; then
    # A system with nothing but the C library, and what the script needs.
    mkdir -p bare/lib64 bare/lib/x86_64-linux-gnu bare/bin bare/dev bare/tmp
    cp -L /lib64/ld-linux-x86-64.so.2 bare/lib64
    for name in c.so.6 m.so.6 mvec.so.1 dl.so.2 rt.so.1 pthread.so.0 resolv.so.2 util.so.1 acl.so.1 selinux.so.1 pcre2-8.so.0; do
        cp -L /lib/x86_64-linux-gnu/lib$name bare/lib/x86_64-linux-gnu
    done
    for tool in sh sed sort tr dirname; do cp -L "$(command -v $tool)" bare/bin; done
    mv "$tree" bare/keyline
    cp graph.json bare/tmp
    inside /keyline/check > told || fail "the tarball does not run on a bare system: $(cat told)"
    grep -q '^for PNG, JPEG, TIFF and others lacks libOpenImageIO' told || fail "it does not say what is missing: $(cat told)"
    inside /keyline/bin/keyline render /tmp/graph.json --progress none
    cmp of_package.exr bare/tmp/out.exr || fail "the tarball renders another file"
    if inside /keyline/bin/keyline render /tmp/graph.json --set out.file=out.png 2> told; then
        fail "a PNG without OpenImageIO"
    fi
    rm bare/keyline/lib/keyline/libraries/libOpenEXR*
    if inside /keyline/check > told; then fail "nothing is missing: $(cat told)"; fi
    grep -q 'lacks .*libOpenEXR' told || fail "$(cat told)"
else
    echo "the tarball was not tried on a bare system: no mounts here"
fi
echo "ok: $(du -h "$deb" | cut -f1) package, $(du -h TGZ/*.tar.gz | cut -f1) tarball"

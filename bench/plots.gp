# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
#
# The figures of docs/performance.md from docs/performance.csv; run in the root of the repository.
set terminal svg size 640,400 font "sans-serif,13" background "white"
set datafile separator comma
set grid lc rgb "#dddddd"
set border 3
set tics nomirror
set key left top reverse Left
set style data linespoints
set yrange [0:*]

series(experiment, what) = sprintf("< awk -F, '$1 == \"%s\" && $2 == \"%s\"' docs/performance.csv", experiment, what)
keyline = "Keyline"
openexr = "OpenEXR read + write"

set style line 1 lc rgb "#c2410c" lw 2 pt 7
set style line 2 lc rgb "#475569" lw 2 pt 5
set style line 3 lc rgb "#c2410c" lw 2 pt 6 dt 2
set style line 4 lc rgb "#f59e0b" lw 2 pt 8 dt 3

set output "docs/images/performance-time.svg"
set xlabel "million pixels"
set ylabel "seconds"
plot series("size", keyline) using ($3/1e6):4 ls 1 title keyline, \
     series("size", openexr) using ($3/1e6):4 ls 2 title openexr

set output "docs/images/performance-memory.svg"
set ylabel "MiB at most"
plot series("size", openexr) using ($3/1e6):5 ls 2 title openexr, \
     series("size", keyline) using ($3/1e6):5 ls 1 title keyline, \
     series("size", keyline." --memory 384M") using ($3/1e6):5 ls 3 title keyline." --memory 384M", \
     series("size", keyline." --memory 256M") using ($3/1e6):5 ls 4 title keyline." --memory 256M"

set output "docs/images/performance-threads.svg"
set xlabel "threads"
set ylabel "seconds, 4K"
set y2label "MiB at most"
set y2tics
set y2range [0:*]
set xtics 1
set key left bottom
plot series("threads", keyline) using 3:4 ls 1 title keyline, \
     series("threads", openexr) using 3:4 ls 2 title openexr, \
     series("threads", keyline) using 3:5 axes x1y2 ls 3 title "memory of Keyline"
unset y2label
unset y2tics

set output "docs/images/performance-sigma.svg"
set xlabel "sigma of the blur, pixels"
set ylabel "seconds, 4K"
set logscale x 2
set xtics auto
plot series("sigma", keyline) using 3:4 ls 1 notitle

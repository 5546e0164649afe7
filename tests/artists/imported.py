# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
# Inside Blender: imports the SVG named last on the command line as Grease Pencil, and holds it to the file.
import os
import re
import sys
import xml.etree.ElementTree as tree

import bpy

path = os.path.abspath(sys.argv[-1])
bpy.ops.wm.gpencil_import_svg(
    filepath=path, directory=os.path.dirname(path), files=[{"name": os.path.basename(path)}], scale=10, resolution=4)
drawing, = (o.data for o in bpy.data.objects if o.type == "GPENCIL")

svg = "{http://www.w3.org/2000/svg}"
layers = tree.parse(path).getroot().findall(svg + "g")
assert [l.info for l in drawing.layers] == [g.get("id") for g in layers], [l.info for l in drawing.layers]

pairs = []
for layer, group in zip(drawing.layers, layers):
    lines, paths = list(layer.frames[0].strokes), list(group.iter(svg + "path"))
    assert len(lines) == len(paths), (layer.info, len(lines), len(paths))
    pairs += zip(lines, paths)


def first_point(path):
    return [float(d) for d in re.match(r"M([-\d.]+),([-\d.]+)", path.get("d")).groups()]


# One scale and one shift for all of them.
def fitted(at, to):
    n, mean_at, mean_to = len(at), sum(at) / len(at), sum(to) / len(to)
    scale = sum((a - mean_at) * (b - mean_to) for a, b in zip(at, to)) / sum((a - mean_at) ** 2 for a in at)
    return scale, max(abs(mean_to + scale * (a - mean_at) - b) for a, b in zip(at, to)) / abs(scale)


xs, ys = zip(*(first_point(p) for _, p in pairs))
(scale_x, off_x), (scale_y, off_y) = (fitted(a, [line.points[0].co[c] for line, _ in pairs]) for a, c in ((xs, 0), (ys, 2)))
assert abs(scale_x + scale_y) < 1e-3 * abs(scale_x), (scale_x, scale_y)  # Z is up
assert max(off_x, off_y) < 0.05, (off_x, off_y)

widths = sorted((float(p.get("stroke-width")), line.line_width) for line, p in pairs)
assert all(a[1] <= b[1] for a, b in zip(widths, widths[1:])), "a wider path is a thinner line"
assert widths[0][1] < widths[-1][1]

materials = [drawing.materials[line.material_index].grease_pencil for line, _ in pairs]
assert not any(m.show_fill for m in materials)
r, g, b, a = pairs[0][0].points[0].vertex_color
assert r < g < b and a > 0, (r, g, b, a)
print(len(drawing.layers), "layers,", len(pairs), "lines where they should be,", widths[0], "to", widths[-1])

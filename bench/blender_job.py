# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
"""The job nearest to lines.json that Blender's compositor can do: it has no thinning and no hysteresis.

    blender --background --threads N --python blender_job.py -- PLATE.exr WIDTH HEIGHT OUT.exr
"""

import sys

import bpy


def add(tree, kind, *inputs, **settings):
    """A node with its settings made and its first inputs connected; sockets, numbers or colours."""
    node = tree.nodes.new("CompositorNode" + kind)
    for name, value in settings.items():
        setattr(node, name, value)
    for socket, value in zip(node.inputs, inputs):
        if isinstance(value, bpy.types.NodeSocket):
            tree.links.new(value, socket)
        else:
            socket.default_value = value
    return node


def build(tree, image):
    plate = add(tree, "Image", image=image)
    beauty = plate.outputs["Combined"]
    grey = add(tree, "RGBToBW", beauty).outputs[0]
    smooth = add(tree, "Blur", grey, 1.0, filter_type="GAUSS", size_x=4, size_y=4).outputs[0]
    slope = add(tree, "Filter", 1.0, smooth, filter_type="SOBEL").outputs[0]
    edges = add(tree, "Math", slope, 0.12, operation="GREATER_THAN").outputs[0]
    bold = add(tree, "DilateErode", edges, mode="STEP", distance=1).outputs[0]
    ink = add(tree, "SetAlpha", (0.02, 0.02, 0.03, 1.0), bold).outputs[0]
    comp = add(tree, "AlphaOver", 1.0, beauty, ink).outputs[0]
    add(tree, "Composite", comp)


def main(plate, width, height, out):
    scene = bpy.context.scene
    image = bpy.data.images.load(plate)
    scene.use_nodes = True
    scene.node_tree.nodes.clear()
    build(scene.node_tree, image)
    render = scene.render
    render.resolution_x, render.resolution_y = int(width), int(height)
    render.resolution_percentage = 100
    render.use_sequencer = False
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_mode = "RGBA"
    render.image_settings.color_depth = "16"
    render.image_settings.exr_codec = "ZIP"
    render.filepath = out
    bpy.ops.render.render(write_still=True)


main(*sys.argv[sys.argv.index("--") + 1:])

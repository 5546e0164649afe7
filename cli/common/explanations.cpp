// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/explanations.h"

#include <array>

namespace keyline::cli {

namespace {

constexpr std::array kExplanations{
    Explanation{
        "syntax", "The text is not JSON",
        "A graph is JSON with comments. A comma is missing, or there is one too many; a bracket is not "
        "closed; a number has a decimal comma; a text has other quotes than \".",
        "Go to the place that the message names. The fault is there or just before it. An editor with "
        "'keyline lsp' shows it while you type.",
        R"({
  "keyline": 1,
  "nodes": {
    "c": { "type": "constant", "size": [8, 8], "color": "#204060" }
    "out": { "type": "write", "in": "c", "file": "out.exr" }
  }
})"},
    Explanation{
        "duplicate-key", "A key is given twice",
        "An object has the same key twice. JSON's readers would silently take the last; Keyline can't "
        "know which one you want.",
        "Take one of them out. Of two nodes with one id, give one another id.",
        R"({
  "keyline": 1,
  "nodes": {
    "c": { "type": "constant", "size": [8, 8], "size": [4, 4] },
    "out": { "type": "write", "in": "c", "file": "out.exr" }
  }
})"},
    Explanation{
        "unknown-key", "A key that nobody knows",
        "A node, the graph or a part of it has a key that means nothing there. It is not ignored: a "
        "misspelt parameter would have its default, and you would wonder.",
        "Write it as the message suggests. 'keyline nodes TYPE' lists what a node takes. Remarks go into "
        "\"about\", or into comments.",
        R"({
  "keyline": 1,
  "nodes": {
    "c": { "type": "constant", "size": [8, 8] },
    "soft": { "type": "gaussian", "in": "c", "sgima": 2 },
    "out": { "type": "write", "in": "soft", "file": "out.exr" }
  }
})"},
    Explanation{
        "missing-key", "Something that must be said is not",
        "A node has no type, or lacks an input or a parameter that has no default; or the graph lacks "
        "\"keyline\": 1 or its nodes.",
        "Add it. 'keyline nodes TYPE' says which ones are required.",
        R"({
  "keyline": 1,
  "nodes": {
    "c": { "type": "constant", "size": [8, 8] },
    "edges": { "type": "hysteresis", "in": "c" },
    "out": { "type": "write", "in": "edges", "file": "out.exr" }
  }
})"},
    Explanation{
        "wrong-value", "A value that can't stand there",
        "A number is out of its range, a word is none of those there are, or a text stands where a number "
        "must.",
        "The message says what it must be. 'keyline nodes TYPE' has the ranges and the words.",
        R"({
  "keyline": 1,
  "nodes": {
    "c": { "type": "constant", "size": [8, 8] },
    "soft": { "type": "gaussian", "in": "c", "sigma": -2 },
    "out": { "type": "write", "in": "soft", "file": "out.exr" }
  }
})"},
    Explanation{
        "against-each-other", "Two parameters that do not go together",
        "Each is right by itself: the lower limit is above the upper one, or two ways to say the same "
        "thing are both given.",
        "Change one of the two, or leave it out.",
        R"({
  "keyline": 1,
  "nodes": {
    "c": { "type": "constant", "size": [8, 8] },
    "edges": { "type": "hysteresis", "in": "c:R", "low": 0.9, "high": 0.1 },
    "out": { "type": "write", "in": "edges", "file": "out.exr" }
  }
})"},
    Explanation{
        "expression", "An expression that can't be worked out",
        "A text that begins with = is computed. It has a name that nobody gives, a bracket too few, or an "
        "operator that there is not: a choice is written a ? b : c.",
        "'keyline help graphs' has the operators, functions and names.",
        R"({
  "keyline": 1,
  "nodes": {
    "c": { "type": "constant", "size": [8, 8] },
    "soft": { "type": "gaussian", "in": "c", "sigma": "= frame +" },
    "out": { "type": "write", "in": "soft", "file": "out.exr" }
  }
})"},
    Explanation{
        "motion", "Keys that can't be followed",
        "A value that moves is { \"keys\": [[FRAME, VALUE], …] }, in the order of the frames. Between two "
        "texts there is nothing; between them write \"hold\".",
        "'keyline help graphs' says how keys are written.",
        R"({
  "keyline": 1,
  "nodes": {
    "c": { "type": "constant", "size": [8, 8] },
    "soft": { "type": "gaussian", "in": "c", "sigma": { "keys": [[24, 3], [1, 1]] } },
    "out": { "type": "write", "in": "soft", "file": "out.exr" }
  }
})"},
    Explanation{
        "unknown-variable", "A variable that nobody declares",
        "${name} stands for a variable of the graph, of a file that it includes, or of --var. One of the "
        "environment is ${env:NAME}.",
        "Declare it in \"variables\", or write it as the message suggests. A literal ${ is written $${.",
        R"({
  "keyline": 1,
  "variables": { "shot": "sh010" },
  "nodes": {
    "c": { "type": "constant", "size": [8, 8] },
    "out": { "type": "write", "in": "c", "file": "${shto}.exr" }
  }
})",
        "--var=shot=sh020"},
    Explanation{
        "unknown-type", "A node type that there is not",
        "A type is a node's name, a group's name, or the file of a group (.json). Groups are looked for in "
        "the folders of $KEYLINE_PATH and among those that come with Keyline.",
        "'keyline nodes' lists all of both. Names of other programs are known to the message: a blur is "
        "'gaussian'.",
        R"({
  "keyline": 1,
  "nodes": {
    "c": { "type": "constant", "size": [8, 8] },
    "soft": { "type": "gausian", "in": "c", "sigma": 2 },
    "out": { "type": "write", "in": "soft", "file": "out.exr" }
  }
})"},
    Explanation{
        "unknown-node", "A link to a node that there is not",
        "An input names a node by its id. There is none of that id here.",
        "Write it as the message suggests. Inside of a group, only its own nodes and inputs are known.",
        R"({
  "keyline": 1,
  "nodes": {
    "picture": { "type": "constant", "size": [8, 8] },
    "out": { "type": "write", "in": "pictrue", "file": "out.exr" }
  }
})"},
    Explanation{
        "unknown-channel", "A layer or channel that is not there",
        "What a link takes, as in \"render:Normal\", or what the node needs, is not among the channels that "
        "flow there. Files name their layers in many ways.",
        "'keyline info FILE' lists a file's layers, 'keyline check --streams' what each node gives.",
        R"({
  "keyline": 1,
  "nodes": {
    "render": { "type": "read", "file": "render.exr" },
    "out": { "type": "write", "in": "render:Combned", "file": "out.exr" }
  }
})"},
    Explanation{
        "unknown-colour", "A name that the OpenColorIO config does not have",
        "A colour space, display, view, look or transform is asked for that is not in the config: the "
        "graph's \"ocio\", else $OCIO, else the one that is built in.",
        "The message lists what there is. 'keyline plan' says which config is used.",
        R"({
  "keyline": 1,
  "nodes": {
    "c": { "type": "constant", "size": [8, 8] },
    "log": { "type": "colorspace", "in": "c", "to": "ACESct" },
    "out": { "type": "write", "in": "log", "file": "out.exr" }
  }
})"},
    Explanation{
        "link-kind", "A link between things of different kinds",
        "Pixels, strokes and other data flow along links. A node gives one kind and takes one kind; nodes "
        "that write give nothing.",
        "The message names the nodes that make the one of the other: 'trace' makes strokes of pixels, "
        "'draw' pixels of strokes.",
        R"({
  "keyline": 1,
  "nodes": {
    "c": { "type": "constant", "size": [8, 8] },
    "pen": { "type": "taper", "in": "c", "start": 4 },
    "lines": { "type": "draw", "in": "pen", "like": "c" },
    "out": { "type": "write", "in": "lines", "file": "out.exr" }
  }
})"},
    Explanation{
        "cycle", "Nodes that need each other",
        "Each node of a loop would have to be computed before the others. Variables can be in a loop too.",
        "Take one of the links out; the message names all of them. What one frame needs of another, a "
        "'read' has by \"frame\": \"-1\".",
        R"({
  "keyline": 1,
  "nodes": {
    "a": { "type": "gaussian", "in": "b", "sigma": 1 },
    "b": { "type": "gaussian", "in": "a", "sigma": 1 },
    "out": { "type": "write", "in": "a", "file": "out.exr" }
  }
})"},
    Explanation{"no-output", "A graph that writes nothing",
                "There is nothing to compute without a node that writes.",
                "Add a 'write'. To see one node, 'keyline view GRAPH NODE' needs none, nor does --output.",
                R"({
  "keyline": 1,
  "nodes": {
    "c": { "type": "constant", "size": [8, 8] }
  }
})"},
    Explanation{
        "file-missing", "A file that is not there",
        "A node reads a file that the disk does not have, under that name or for that frame. Relative names "
        "begin at the folder of the graph.",
        "Mind the padding of ####, and where the graph lies. \"missing\": \"hold\" or \"black\" of 'read' "
        "goes "
        "on without a frame.",
        R"({
  "keyline": 1,
  "nodes": {
    "render": { "type": "read", "file": "rendre.exr" },
    "out": { "type": "write", "in": "render", "file": "out.exr" }
  }
})"},
    Explanation{"format", "A file format that can't hold that",
                "The extension says the format. Each has its own channels, depths, compressions and sizes.",
                "The message says what it holds. OpenEXR holds everything.",
                R"({
  "keyline": 1,
  "nodes": {
    "c": { "type": "constant", "size": [8, 8] },
    "out": { "type": "write", "in": "c", "file": "out.jpg", "depth": "half" }
  }
})"},
    Explanation{
        "same-file", "Two users of one file",
        "Two nodes write one file, or one writes what another reads. The result would depend on who comes "
        "first.",
        "Write to another file.",
        R"({
  "keyline": 1,
  "nodes": {
    "c": { "type": "constant", "size": [8, 8] },
    "a": { "type": "write", "in": "c", "file": "out.exr" },
    "b": { "type": "write", "in": "c", "file": "out.exr" }
  }
})"},
    Explanation{
        "one-file", "Several frames into one file",
        "The file's name has no place for the frame's number: each frame would overwrite the one before.",
        "Put a run of # into the name, as in out.####.exr.",
        R"({
  "keyline": 1,
  "nodes": {
    "c": { "type": "constant", "size": [8, 8] },
    "out": { "type": "write", "in": "c", "file": "out.exr" }
  }
})",
        "--frames=1-3"},
    Explanation{
        "cant-write", "A place where nothing can be written",
        "The folder of an output can't be written: rights, a file in a folder's place, a disk that is "
        "mounted to be read only.",
        "Mend the rights, or write elsewhere; --path-map gives another machine's folders their place here.",
        R"({
  "keyline": 1,
  "nodes": {
    "c": { "type": "constant", "size": [8, 8] },
    "out": { "type": "write", "in": "c", "file": "render.exr/out.exr" }
  }
})"},
    Explanation{"unused", "Something that nothing uses",
                "No output needs this node, or nothing this variable. Often a link was forgotten.",
                "Link to it, or take it out. Of a node, \"meant\": \"unused\" says that it is right so.",
                R"({
  "keyline": 1,
  "nodes": {
    "c": { "type": "constant", "size": [8, 8] },
    "soft": { "type": "gaussian", "in": "c", "sigma": 2 },
    "out": { "type": "write", "in": "c", "file": "out.exr" }
  }
})"},
    Explanation{
        "linear-in-file", "Scene-linear colour in a file for the screen",
        "Renderers write the light of a scene. Files of 8 or 16 bits are shown as they are: the picture "
        "looks dark and hard, and its lights are cut off at 1.",
        "Put a 'display' before the 'write', or give it \"colorspace\": \"sRGB - Texture\". Where the "
        "numbers "
        "are meant, \"meant\": \"linear-in-file\" in the 'write' says so.",
        R"({
  "keyline": 1,
  "nodes": {
    "render": { "type": "read", "file": "render.exr" },
    "out": { "type": "write", "in": "render:Combined", "file": "out.png" }
  }
})"},
    Explanation{
        "shown-twice", "Colour that is made for a display twice",
        "A 'display' or 'colorspace' takes its input for scene-linear, and that went through a 'display' "
        "before, or comes from a file for the screen. The picture becomes pale.",
        "Convert it once. A PNG or JPEG becomes scene-linear by the \"colorspace\" of its 'read'; what a "
        "display was given can be turned back by \"from\". \"meant\": \"shown-twice\" says that it is right "
        "so.",
        R"({
  "keyline": 1,
  "nodes": {
    "render": { "type": "read", "file": "render.exr" },
    "seen": { "type": "display", "in": "render:Combined" },
    "srgb": { "type": "colorspace", "in": "seen", "to": "sRGB - Texture" },
    "out": { "type": "write", "in": "srgb", "file": "out.png" }
  }
})"},
    Explanation{
        "data-converted", "Measured channels converted as if they were colour",
        "Normals, positions and depths are numbers, whatever their channels are called. After a colour "
        "conversion they are other numbers.",
        "Convert the layer of colour alone. To look at them use 'keyline view', or 'falsecolor'. \"meant\": "
        "\"data-converted\" says that it is right so.",
        R"({
  "keyline": 1,
  "nodes": {
    "render": { "type": "read", "file": "render.exr" },
    "rgb": { "type": "shuffle", "in": "render:Normal", "channels": { "R": "X", "G": "Y", "B": "Z" } },
    "seen": { "type": "display", "in": "rgb" },
    "out": { "type": "write", "in": "seen", "file": "out.png" }
  }
})"},
    Explanation{
        "divided-twice", "Colour that is divided by its alpha twice",
        "Colour is premultiplied here. 'unpremultiply' divides by A; conversions of colour divide around "
        "themselves, and formats such as PNG divide when they are written. Rims become bright.",
        "Leave the 'unpremultiply' out, or put a 'premultiply' behind what needed it. \"meant\": "
        "\"divided-twice\" says that it is right so.",
        R"({
  "keyline": 1,
  "nodes": {
    "render": { "type": "read", "file": "render.exr" },
    "straight": { "type": "unpremultiply", "in": "render:Combined" },
    "seen": { "type": "display", "in": "straight" },
    "out": { "type": "write", "in": "seen", "file": "out.exr" }
  }
})"},
    Explanation{
        "not-thinned", "Edges that nothing has thinned",
        "'gradient' makes a slope that is as wide as the picture's blur. 'hysteresis' chooses among its "
        "pixels; it makes no line thin.",
        "Put an 'nms' between the two. \"meant\": \"not-thinned\" says that wide lines are wanted.",
        R"({
  "keyline": 1,
  "nodes": {
    "render": { "type": "read", "file": "render.exr" },
    "y": { "type": "ycolor", "in": "render:Combined" },
    "slope": { "type": "gradient", "in": "y" },
    "edges": { "type": "hysteresis", "in": "slope", "low": 0.05 },
    "out": { "type": "write", "in": "edges", "file": "out.exr" }
  }
})"},
    Explanation{
        "depth-in-half", "A depth in 16 bits",
        "Half ends at 65504, and has three digits: a sky becomes infinite, and far walls become steps.",
        "Leave \"depth\" out: what is measured is written as float by itself. \"meant\": \"depth-in-half\" "
        "says "
        "that half will do.",
        R"({
  "keyline": 1,
  "nodes": {
    "render": { "type": "read", "file": "render.exr" },
    "far": { "type": "math", "in": "render:Depth", "op": "multiply", "value": 100 },
    "out": { "type": "write", "in": "far", "file": "out.exr", "depth": "half" }
  }
})"},
    Explanation{
        "frames-differ", "Frames of one sequence that are not alike",
        "From one frame to the next the size, the channels, their types or the colour space of a file "
        "change. Often a part of the shot was rendered again with other settings.",
        "'keyline info' tells of both files. Render the one again that is wrong.", ""},
    Explanation{
        "frames-missing", "Frames that are not on disk",
        "--frames all takes what is there; between the first and the last some are not.",
        "Say which frames there are to be, as in --frames 1-24: then each that is missing is an error.", ""},
    Explanation{
        "little-space", "A disk that may not hold the outputs",
        "What all frames take at most is more than the disk has free. Compressed pictures take less than "
        "that, mostly.",
        "Make room, or write elsewhere.", ""},
    Explanation{"graph", "The graph or the command line is wrong",
                "It is none of the kinds that have a word of their own. The exit status is 2.",
                "Do what the message says.", ""},
    Explanation{"input", "An input can't be used",
                "A file is damaged, can't be read, or is of a kind that is not known. The exit status is 3.",
                "Look at it with 'keyline info', or render it again.", ""},
    Explanation{"output", "An output can't be written", "The exit status is 4.", "Do what the message says.",
                ""},
    Explanation{
        "failed", "A frame failed, or is worth a second look",
        "For a reason that is neither in the graph nor in a file. The exit status is 1; of a warning there "
        "is none.",
        "Do what the message says.", ""},
    Explanation{"internal", "A promise of Keyline's own code was broken", "It is our fault, and not yours.",
                "Tell us, with the graph and the whole message.", ""},
    Explanation{"cancelled", "It was stopped", "By a signal, or by who asked for it.", "Run it again.", ""},
    Explanation{"space", "The disk is full", "It may pass. The exit status is 75.",
                "Make room, and run the same command again; --skip-existing leaves what is finished.", ""},
    Explanation{"quota", "The quota is used up", "It may pass. The exit status is 75.",
                "Make room, and run the same command again.", ""},
    Explanation{"stale", "A file server lost the file",
                "It was restarted, or another machine replaced the file. "
                "The exit status is 75.",
                "Run the same command again.", ""},
    Explanation{"device", "A disk or a file server failed", "The exit status is 75.",
                "Run the same command again, on another machine if it stays so.", ""},
    Explanation{"timeout", "A file server did not answer", "The exit status is 75.",
                "Run the same command again.", ""},
    Explanation{"unfinished", "An input is still being written, or was cut off", "The exit status is 75.",
                "Wait until it is whole: --wait-inputs does.", ""},
    Explanation{"memory", "There was too little memory", "The exit status is 75.",
                "Give --memory less than the machine has, or run it on another.", ""},
};

}  // namespace

std::span<const Explanation> explanations() { return kExplanations; }

}  // namespace keyline::cli

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/common/options.h"
#include "engine/json/json_writer.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

// Pictures of nodes, made by the engine: nodes that are added to the user's graph show any node's result.

namespace keyline::cli {

struct PictureOptions {
    std::string channel;                         // of every node, as after the colon of an input
    std::optional<std::array<double, 2>> range;  // what is black and white; else the frame's own
};

// The nodes of a graph whose results can be shown: pixels and strokes; each after those it reads.
std::vector<std::string> nodes_to_show(const Graph& graph);

// Writes the members of a JSON object of nodes.
class PictureNodes {
public:
    PictureNodes(const Graph& graph, PictureOptions options);

    // Shows a node, "id" or "id:LAYER"; returns the id of the picture, R G B as a display takes it.  Throws
    // Failure (kGraph) for a node that is not there or has nothing to be seen.
    std::string show(const std::string& node);

    // The left half of one node's picture beside the right half of another's.
    std::string wiped(const std::string& left, const std::string& right);

    // How far two nodes' pictures are apart.
    std::string difference(const std::string& a, const std::string& b);

    // A region of a picture, left, top, width and height, so large that each pixel is seen, with lines
    // between them.  `grid` is where the lines are kept.
    std::string magnified(const std::string& picture, const std::array<int, 4>& region,
                          const std::string& grid);

    // The same within a width and a height.
    std::string show_small(const std::string& node, int width, int height);

    // A picture as large as a width and a height let it be.
    std::string fitted(const std::string& picture, const std::array<int, 2>& most);

    // All nodes on one sheet, each with its name.  `names` is where strokes that spell them are kept.
    std::string sheet(const std::vector<std::string>& nodes, const std::string& names);

    // Writes a picture; returns the node's id, for GraphArguments::only.
    std::string write(const std::string& picture, const std::string& file);

    // A node's own samples, as 32-bit floats.
    std::string write_samples(const std::string& node, const std::string& file);

    // The whole object.
    std::string text() const { return json_.text() + "}"; }

private:
    JsonWriter& begin(const std::string& id, const char* type);
    std::string source_of(const std::string& node);  // its pixels, in the channel that was asked for
    std::string next();

    const Graph& graph_;
    const PictureOptions options_;
    JsonWriter json_;
    int count_ = 0;
};

// Throws Failure (kGraph) for options that choose what a render writes: nothing of that is written.
void refuse_outputs(const GraphArguments& arguments);

// Renders what was added, on one frame.  Returns the exit status; what is wrong is told.
int render_pictures(const GraphArguments& arguments);

}  // namespace keyline::cli

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/graph/graph.h"

#include <map>
#include <string>
#include <vector>

namespace keyline::cli {

// A graph to be laid out: what is beside its own nodes.
struct Diagram {
    std::map<std::string, std::string> thumbnails;           // files, by node
    std::map<std::string, std::vector<std::string>> faults;  // by node
    int frame = 1;
};

// In the language of Graphviz' `dot`.
std::string dot_text(const Graph& graph, const Diagram& diagram);

// As SVG that stands by itself: pictures are in it.  Throws Failure (kFailed) where Graphviz is not there.
std::string svg_of(const std::string& dot, const Diagram& diagram);

}  // namespace keyline::cli

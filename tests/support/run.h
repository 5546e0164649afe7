// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/error.h"
#include "tests/support/image.h"

#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

// Nodes and graphs on images in memory, through the whole engine: graph, plan, tiles.
//
//     EXPECT_IMAGE(run("dilate", {{"radius", 1}}, ascii({"...", ".2.", "..."})), ascii({".2.", "222",
//     ".2."}));

namespace keyline::testing {

using Json = nlohmann::ordered_json;

struct RunOptions {
    int threads = 2;
    int tile = 0;
    std::size_t memory = 0;
    int frame = 1;
};

// One node with its parameters on one input, or on several by port name.  Throws Failure with all errors of
// the graph in its text.
Image run(const std::string& type, const Json& params, const Image& in, const RunOptions& options = {});
Image run(const std::string& type, const Json& params, const std::map<std::string, Image>& inputs,
          const RunOptions& options = {});

// The result of node `id` of a graph's nodes; `inputs` stand in it as nodes by their names.  An input of many
// images is a sequence: frame f is image f, counted from 0.
Image run_graph(const Json& nodes, const std::string& id, const std::map<std::string, Image>& inputs,
                const RunOptions& options = {});
Image run_graph(const Json& nodes, const std::string& id,
                const std::map<std::string, std::vector<Image>>& inputs, const RunOptions& options = {});

// What such a run says that went wrong; "" where it went well.
std::string error_of(const std::string& type, const Json& params, const Image& in);

}  // namespace keyline::testing

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/error.h"
#include "tests/support/image.h"
#include "tests/support/json.h"

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

// Nodes and graphs on images in memory, through the whole engine: graph, plan, tiles.
//
//     EXPECT_IMAGE(run("dilate", {{"radius", 1}}, ascii({"...", ".2.", "..."})),
//                  ascii({".2.", "222", ".2."}));

namespace keyline {
class Datum;
struct Plan;
struct ResolvedFrame;
}  // namespace keyline

namespace keyline::testing {

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
using Sequences = std::map<std::string, std::vector<Image>>;
Image run_graph(const Json& nodes, const std::string& id, const std::map<std::string, Image>& inputs,
                const RunOptions& options = {});
Image run_graph(const Json& nodes, const std::string& id, const Sequences& inputs,
                const RunOptions& options = {});

// What such a run says that went wrong; "" where it went well.
std::string error_of(const std::string& type, const Json& params, const Image& in);

// The same in steps, for tests of the engine itself: the results of several nodes at once, those of
// `data_ids` data.  At most one such frame exists at a time, as its images lie in one place.
ResolvedFrame resolve_graph(const Json& nodes, const std::vector<std::string>& ids, const Sequences& inputs,
                            int frame = 1, bool leave_out_identities = true,
                            const std::vector<std::string>& data_ids = {});
std::vector<Image> render(Plan plan);

// The data of the last render, in the order of `data_ids`.
std::vector<std::shared_ptr<const Datum>> rendered_data();

}  // namespace keyline::testing

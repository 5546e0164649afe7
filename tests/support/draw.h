// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/node/node_type.h"
#include "tests/support/image.h"
#include "tests/support/json.h"
#include "tests/support/run.h"

#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

// Parameters and images for any node, drawn at random from what it declares.  The same seed draws the same
// everywhere.

namespace keyline::testing {

class Draw {
public:
    explicit Draw(unsigned seed) : random_(seed) {}

    int whole(int low, int high);  // both included
    bool one_in(int n) { return whole(1, n) == 1; }
    template <class T>
    const T& of(const std::vector<T>& items) {
        return items[static_cast<std::size_t>(whole(0, static_cast<int>(items.size()) - 1))];
    }
    double number(const Range& range);  // its ends more often than not; no more than test_max

    // Off the origin, and now and then only a pixel wide or high.
    Rect window(int most_width = 45, int most_height = 35);

    // Noise from -0.25 to 1 that such a port takes, in one image of three with many equal values.
    Image image(const Takes& takes, const Rect& window);

    // Every input and most parameters of a node.  `input` names what an input is connected to.
    using NameInput = std::function<std::string(const TypeInfo&)>;
    Json parameters(const NodeType& type, const NameInput& input);

private:
    std::optional<Json> value(const TypeInfo& type, const NameInput& input);
    Json object(const std::vector<FieldInfo>& fields, const NameInput& input);
    std::vector<std::string> channels(const Takes& takes);

    std::mt19937 random_;
};

// A node with parameters and inputs of its own: the graph, the id of the node, and its images, three to an
// input.
struct NodeCase {
    Json nodes;
    std::string id = "node";
    Sequences inputs;
    bool gives_data = false;

    ResolvedFrame resolve(bool leave_out_identities = true) const;
    std::string text() const;  // for messages
};

// Draws until the node accepts: what holds between parameters only the node knows.  Throws Failure with the
// node's last complaint after many tries.  `window` draws an input's data window.
NodeCase draw_case(const NodeType& type, Draw& draw, const std::function<Rect(Draw&)>& window = {});

// Whether a node reads or writes files: what it computes is not for a test that draws its parameters.
bool has_files(const NodeType& type);

}  // namespace keyline::testing

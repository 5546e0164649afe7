// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace keyline::cli {

// What one kind of message is about.
struct Explanation {
    std::string_view code, title;
    std::string_view why;          // how one gets there, and what it does
    std::string_view remedy;       // what to do
    std::string_view example;      // a graph that `check` says it of; empty for what no graph alone leads to
    std::string_view option = {};  // …with this option of `check`
};

// One for each code that a message can have, those of the graph's text first.  Examples read a file
// render.exr, which has the layer Combined.
std::span<const Explanation> explanations();

}  // namespace keyline::cli

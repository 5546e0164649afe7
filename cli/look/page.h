// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/look/statistics.h"

#include <string>
#include <utility>
#include <vector>

namespace keyline::cli {

// A node of a drawing, as a page tells of it.
struct PageNode {
    int index = 0;  // in the drawing: its element is called node0, node1, …
    std::string id, type, help;
    std::vector<std::pair<std::string, std::string>> parameters;
    std::vector<std::pair<std::string, std::string>> facts;  // windows and channels
    std::vector<ChannelStatistics> statistics;
    std::string picture;  // a file .jpg; empty: none
};

// A page that stands by itself: the drawing, in which a click on a node shows what is known of it.
std::string page_of(const std::string& title, const std::string& svg, const std::vector<PageNode>& nodes);

}  // namespace keyline::cli

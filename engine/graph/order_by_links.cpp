// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/index.h"
#include "engine/graph/check_links.h"
#include "engine/graph/graph_error.h"

#include <algorithm>

namespace keyline {

namespace {

enum class Mark { kNew, kOpen, kDone };

class Orderer {
public:
    Orderer(const std::vector<GraphNode>& nodes, const std::vector<std::vector<int>>& links,
            Diagnostics& diagnostics)
        : nodes_(nodes), links_(links), diagnostics_(diagnostics), marks_(links.size(), Mark::kNew) {}

    std::vector<int> order() {
        for (std::size_t i = 0; i < links_.size(); ++i)
            if (marks_[i] == Mark::kNew) visit(static_cast<int>(i));
        return std::move(order_);
    }

private:
    // Depth first with a stack of its own, so that a long chain can't overflow the program's.
    void visit(int start) {
        open(start);
        while (!path_.empty()) {
            const int node = path_.back();
            const auto& links = links_[index(node)];
            if (next_.back() == links.size()) {
                marks_[index(node)] = Mark::kDone;
                order_.push_back(node);
                path_.pop_back();
                next_.pop_back();
                continue;
            }
            const int target = links[next_.back()++];
            const Mark mark = marks_[index(target)];
            if (mark == Mark::kOpen) report_cycle(target);
            if (mark == Mark::kNew) open(target);
        }
    }

    void open(int node) {
        marks_[index(node)] = Mark::kOpen;
        path_.push_back(node);
        next_.push_back(0);
    }

    void report_cycle(int first) {
        std::vector<int> members(std::ranges::find(path_, first), path_.end());
        // Told from the member that stands first in the file, along the inputs.
        std::rotate(members.begin(), std::ranges::min_element(members), members.end());
        std::string chain;
        for (const int m : members) chain += in_quotes(nodes_[index(m)].id) + " needs ";
        const GraphNode& node = nodes_[index(members.front())];
        graph_error(diagnostics_, node.place, "the nodes form a cycle: " + chain + in_quotes(node.id), {},
                    node.title(), Code::kCycle);
    }

    const std::vector<GraphNode>& nodes_;
    const std::vector<std::vector<int>>& links_;
    Diagnostics& diagnostics_;
    std::vector<Mark> marks_;
    std::vector<int> order_;
    std::vector<int> path_;          // the nodes that are open, each read by the one before it
    std::vector<std::size_t> next_;  // of each of them, the link to follow next
};

}  // namespace

std::vector<int> order_by_links(const std::vector<GraphNode>& nodes,
                                const std::vector<std::vector<int>>& links, Diagnostics& diagnostics) {
    return Orderer(nodes, links, diagnostics).order();
}

}  // namespace keyline

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/lsp/document.h"
#include "engine/run/render.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace keyline::lsp {

// What `check` finds out about a text.
struct Analysis {
    Diagnostics diagnostics;
    std::unique_ptr<const Graph> graph;    // as far as it is sound; null where not even nodes were found
    std::optional<ResolvedFrame> streams;  // what each node makes; nothing where something is wrong
    int frame = 1;                         // that it was checked at
};

// `session` keeps headers and configs from one text to the next.
Analysis analyse(const Document& document, const std::shared_ptr<Session>& session);

// What leaves a node: of the analysis, else of the file that it reads, else what its type declares.
std::vector<std::string> channels_of(const Analysis& analysis, const std::string& id);

struct NamedObjects {
    std::string cryptomatte;
    std::vector<std::string> objects;
};

// Of all files that the graph reads.
std::vector<NamedObjects> cryptomattes_of(const Analysis& analysis);

// The colour config of the graph; null where it can't be read.
std::shared_ptr<const ColorConfig> colors_of(const Analysis& analysis, Session& session);

}  // namespace keyline::lsp

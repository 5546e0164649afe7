// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/graph/graph.h"
#include "engine/run/render.h"
#include "tests/support/run.h"

#include <atomic>
#include <string>
#include <vector>

// Graphs that read and write files, rendered as the program does it.

namespace keyline::testing {

class Rendered final : public RenderObserver {
public:
    int status = 0;
    std::vector<std::string> warnings, errors;

    void warning(const Error& e) override { warnings.push_back(e.text()); }
    void error(const Error& e) override { errors.push_back(e.text()); }
};

inline Rendered render_files(const Json& nodes, const RenderOptions& options) {
    Rendered out;
    Diagnostics diagnostics;
    const Json graph{{"keyline", 1}, {"nodes", nodes}};
    const auto loaded = Graph::parse(graph.text(), "test.json", ".", {}, diagnostics);
    for (const Error& e : diagnostics.errors()) out.error(e);
    if (!loaded) return out;
    const std::atomic<bool> cancel = false;
    out.status = render(*loaded, options, out, cancel).status();
    return out;
}

inline Rendered render_files(const Json& nodes, int frame = 1) {
    RenderOptions options;
    options.frames = {frame};
    options.threads = 2;
    return render_files(nodes, options);
}

}  // namespace keyline::testing

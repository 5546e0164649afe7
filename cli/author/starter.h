// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/look/passes.h"
#include "engine/look/render_levels.h"

#include <string>

namespace keyline::cli {

enum class Look {
    kDrawing,  // flat tones under strokes of ink
    kOver,     // the strokes over the beauty
    kLines,    // the strokes on paper
};

struct Starter {
    RenderPasses passes;
    RenderLevels levels;
    Look look = Look::kDrawing;
    std::string plate;  // the file to read, as the graph has it
    std::string out;    // what is written, as the graph has it, without an extension
};

// Whether a render has what a look is made of.
bool can_look(Look look, const RenderPasses& passes);

// A graph for just these passes, in the layout of `keyline fmt`.
std::string starter_graph(const Starter& starter);

}  // namespace keyline::cli

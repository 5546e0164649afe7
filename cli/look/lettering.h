// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace keyline::cli {

// Names as strokes, in the JSON that `strokes_read` takes: the labels of pictures are drawn by the engine
// too.
class Lettering {
public:
    Lettering(int width, int height);

    // From a place on the base line on, cut where there is no more room.  Capital letters are written small.
    void add(std::string_view text, double x, double y, double room);

    std::string text() const;

private:
    int width_, height_;
    std::string lines_;
};

}  // namespace keyline::cli

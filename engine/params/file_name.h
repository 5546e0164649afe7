// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace KEYLINE_API keyline {

// A file name of a graph, in which the frame's number may stand: as a run of '#', in a folder of two or more,
// padded with zeros to its length; as %04d, the same as ####; or as %d, unpadded.  -7 in #### is -0007.
// %% is a percent sign; a backslash makes '#', '$', '@', '~' or '%' a letter like others.  What others
// write (~/, $SHOW, $F4, @@@@, %V, D:\) is refused with the way to write it here.
class FileName {
public:
    FileName() = default;  // no file; a parameter's value before it is read

    // `base` is the folder that a relative name is relative to; no frame is looked for in it.  Throws Failure
    // (kGraph) for what fault() tells.
    explicit FileName(std::string_view text, std::filesystem::path base = {});

    // What is wrong with a name; nothing for a good one.
    static std::optional<std::string> fault(std::string_view text);

    bool has_frame() const;
    const std::string& text() const { return text_; }  // as written

    // The path for a frame; the same for all where the name holds none.
    std::filesystem::path at(int frame) const;

    // The frames of which there is a file, in increasing order; none where the name holds no frame.  Throws
    // Failure (kInput) for a folder that can't be listed.
    std::vector<int> frames_on_disk() const;

private:
    // Text, and after it the frame padded to `digits`, or nothing more where there are none.
    struct Piece {
        std::string text;
        std::optional<std::size_t> digits;
    };
    struct Parsed {
        std::vector<Piece> pieces;
        std::string fault;
    };
    static Parsed parse(std::string_view text);
    static std::string written(const std::vector<Piece>& pieces, int frame);

    std::string text_;
    std::filesystem::path base_;
    std::vector<Piece> pieces_;
};

}  // namespace keyline

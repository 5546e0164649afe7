// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace keyline::cli {

// The files that `name` stands for: itself, or the frames on disk where it holds a frame number (`####`) and
// there is no file of just that name.  Throws Failure (kInput) where none is there.
std::vector<std::string> files_of(const std::string& name);

// The name with # for the digits that it holds last, before its extension; the name itself without such.
std::string with_frame_number(const std::string& file);

// Files that differ in the number that their names hold last, and in nothing that is told of them.
struct Sequence {
    std::string name;          // "street.####.exr"; the file's own where it is the only one
    std::vector<int> frames;   // in increasing order; none for a single file
    std::vector<int> missing;  // between the first and the last of that name
    std::size_t first = 0;     // of the files
};

// `told` has what is told of each file.  In the order of the files.
std::vector<Sequence> fold_sequences(const std::vector<std::string>& files,
                                     const std::vector<std::string>& told);

}  // namespace keyline::cli

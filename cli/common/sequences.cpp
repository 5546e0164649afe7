// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/sequences.h"

#include "engine/base/absent_input.h"
#include "engine/params/file_name.h"
#include "engine/params/missing_file.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <set>

namespace keyline::cli {

namespace {

constexpr std::size_t kMostDigits = 9;  // of a frame that fits an int
constexpr std::size_t kMostMissing = 10'000;

struct Numbered {
    std::string name;  // with # for the digits
    int frame = 0;
};

// By the last digits of the file's name before its extension.
std::optional<Numbered> numbered(const std::string& file) {
    constexpr std::string_view kDigits = "0123456789";
    const std::size_t folder = file.rfind('/') + 1, dot = file.rfind('.');
    if (dot == std::string::npos || dot <= folder) return {};
    const std::size_t last = file.find_last_of(kDigits, dot - 1);
    if (last == std::string::npos || last < folder) return {};
    std::size_t first = file.find_last_not_of(kDigits, last) + 1;
    first = std::max(first, folder);
    const std::size_t length = last + 1 - first;
    if (length > kMostDigits) return {};
    Numbered out{file, 0};
    out.name.replace(first, length, std::string(length, '#'));
    std::from_chars(file.data() + first, file.data() + last + 1, out.frame);
    return out;
}

// Those between the first and the last that are not there; of a number that is no frame's, none.
std::vector<int> missing_of(const std::set<int>& frames) {
    std::vector<int> out;
    const int first = *frames.begin(), last = *frames.rbegin();
    if (static_cast<std::size_t>(last - first) >= kMostMissing + frames.size()) return out;
    for (int f = first; f < last; ++f)
        if (!frames.contains(f)) out.push_back(f);
    return out;
}

}  // namespace

std::vector<std::string> files_of(const std::string& name) {
    std::error_code error;
    if (std::filesystem::exists(name, error) || error || FileName::fault(name)) return {name};
    const FileName pattern(name);
    std::vector<std::string> out;
    for (const int frame : pattern.frames_on_disk()) out.push_back(pattern.at(frame).string());
    if (out.empty()) throw AbsentInput(name, hint_for_missing(pattern, 1));
    return out;
}

std::string with_frame_number(const std::string& file) {
    const auto n = numbered(file);
    return n ? n->name : file;
}

std::vector<Sequence> fold_sequences(const std::vector<std::string>& files,
                                     const std::vector<std::string>& told) {
    std::map<std::string, std::set<int>> frames_of_name;
    for (const std::string& file : files)
        if (const auto n = numbered(file)) frames_of_name[n->name].insert(n->frame);
    std::vector<Sequence> out;
    for (std::size_t i = 0; i < files.size(); ++i) {
        const auto n = numbered(files[i]);
        if (!n || frames_of_name[n->name].size() == 1) {
            out.push_back({files[i], {}, {}, i});
            continue;
        }
        const auto same = std::ranges::find_if(
            out, [&](const Sequence& s) { return s.name == n->name && told[s.first] == told[i]; });
        if (same != out.end()) {
            same->frames.push_back(n->frame);
            continue;
        }
        const bool is_first = std::ranges::find(out, n->name, &Sequence::name) == out.end();
        out.push_back({n->name, {n->frame}, {}, i});
        if (is_first) out.back().missing = missing_of(frames_of_name[n->name]);
    }
    for (Sequence& s : out) std::ranges::sort(s.frames);
    return out;
}

}  // namespace keyline::cli

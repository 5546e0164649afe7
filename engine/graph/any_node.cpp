// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/any_node.h"

#include "engine/graph/graph_error.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace keyline {

namespace {

std::vector<std::string> words_that_can_be_meant() {
    std::vector<std::string> out;
    for (const Code code : all_codes())
        if (can_be_meant(code)) out.emplace_back(code_name(code));
    return out;
}

// One code, or a list of them.
class MeantReader {
public:
    MeantReader(const std::string& title, Diagnostics& diagnostics)
        : title_(title), diagnostics_(diagnostics) {}

    std::vector<Code> read(const Value& meant) {
        if (meant.is(Value::Kind::kArray))
            for (const Value& item : meant.items) read_one(item);
        else
            read_one(meant);
        return std::move(codes_);
    }

private:
    void read_one(const Value& word) {
        for (const Code code : all_codes())
            if (can_be_meant(code) && word.is(Value::Kind::kString) && word.text == code_name(code))
                return codes_.push_back(code);
        const std::vector<std::string> known = words_that_can_be_meant();
        graph_error(diagnostics_, word.place,
                    fmt::format("'meant' is {}; it must be one of {}, or a list of them", word.shown(),
                                listed(known)),
                    word.is(Value::Kind::kString) ? did_you_mean(word.text, known) : "", title_,
                    Code::kWrongValue);
    }

    const std::string& title_;
    Diagnostics& diagnostics_;
    std::vector<Code> codes_;
};

}  // namespace

void take_what_any_node_has(GraphNode& node, const std::string& title, Diagnostics& diagnostics) {
    static constexpr std::array kKeys{"type", "about", "enabled", "meant"};
    for (const Member& m : node.object.members)
        if (m.key == "about") check_text(m, diagnostics, title);
    if (const Value* enabled = node.object.find("enabled")) node.enabled = *enabled;
    if (const Value* meant = node.object.find("meant"))
        node.meant = MeantReader(title, diagnostics).read(*meant);
    std::erase_if(node.object.members,
                  [](const Member& m) { return std::ranges::find(kKeys, m.key) != kKeys.end(); });
}

}  // namespace keyline

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/code.h"

#include <algorithm>
#include <array>
#include <utility>

namespace keyline {

namespace {

constexpr std::array kNames{
    std::pair{Code::kSyntax, "syntax"},
    std::pair{Code::kDuplicateKey, "duplicate-key"},
    std::pair{Code::kUnknownKey, "unknown-key"},
    std::pair{Code::kMissingKey, "missing-key"},
    std::pair{Code::kWrongValue, "wrong-value"},
    std::pair{Code::kAgainstEachOther, "against-each-other"},
    std::pair{Code::kExpression, "expression"},
    std::pair{Code::kMotion, "motion"},
    std::pair{Code::kUnknownVariable, "unknown-variable"},
    std::pair{Code::kUnknownType, "unknown-type"},
    std::pair{Code::kUnknownNode, "unknown-node"},
    std::pair{Code::kUnknownChannel, "unknown-channel"},
    std::pair{Code::kUnknownColour, "unknown-colour"},
    std::pair{Code::kLinkKind, "link-kind"},
    std::pair{Code::kCycle, "cycle"},
    std::pair{Code::kNoOutput, "no-output"},
    std::pair{Code::kFileMissing, "file-missing"},
    std::pair{Code::kFormat, "format"},
    std::pair{Code::kSameFile, "same-file"},
    std::pair{Code::kOneFile, "one-file"},
    std::pair{Code::kCantWrite, "cant-write"},
    std::pair{Code::kUnused, "unused"},
    std::pair{Code::kLinearInFile, "linear-in-file"},
    std::pair{Code::kShownTwice, "shown-twice"},
    std::pair{Code::kDataConverted, "data-converted"},
    std::pair{Code::kDividedTwice, "divided-twice"},
    std::pair{Code::kNotThinned, "not-thinned"},
    std::pair{Code::kDepthInHalf, "depth-in-half"},
    std::pair{Code::kFramesDiffer, "frames-differ"},
    std::pair{Code::kFramesMissing, "frames-missing"},
    std::pair{Code::kLittleSpace, "little-space"},
};

constexpr auto kCodes = [] {
    std::array<Code, kNames.size()> out{};
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = kNames[i].first;
    return out;
}();

}  // namespace

std::string_view code_name(Code code) {
    const auto it = std::ranges::find(kNames, code, &decltype(kNames)::value_type::first);
    return it == kNames.end() ? "" : it->second;
}

std::span<const Code> all_codes() { return kCodes; }

bool can_be_meant(Code code) { return code >= Code::kUnused && code <= Code::kDepthInHalf; }

}  // namespace keyline

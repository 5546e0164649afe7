// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace KEYLINE_API keyline {

// What kind of mistake a message is about: stable words, for programs and for `keyline explain`.
enum class Code : uint8_t {
    kNone,  // nothing more than whose fault it is

    // The text.
    kSyntax,
    kDuplicateKey,
    kUnknownKey,
    kMissingKey,
    kWrongValue,
    kAgainstEachOther,
    kExpression,
    kMotion,
    kUnknownVariable,

    // The nodes and their links.
    kUnknownType,
    kUnknownNode,
    kUnknownChannel,
    kUnknownColour,
    kLinkKind,
    kCycle,
    kNoOutput,

    // The files.
    kFileMissing,
    kFormat,
    kSameFile,
    kOneFile,
    kCantWrite,

    // Warnings.  The graph can say of these that they are meant.
    kUnused,
    kLinearInFile,
    kShownTwice,
    kDataConverted,
    kDividedTwice,
    kNotThinned,
    kDepthInHalf,

    // Warnings of what may be so on disk.
    kFramesDiffer,
    kFramesMissing,
    kLittleSpace,
};

std::string_view code_name(Code code);  // "unknown-key"

// All but kNone.
std::span<const Code> all_codes();

// Whether a graph's "meant" may name it.
bool can_be_meant(Code code);

}  // namespace keyline

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/node/stream.h"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// The text of a Cryptomatte's manifest, as renderers write it.

namespace keyline {

// From the attributes, or from the file beside the image that they name: an image says no other file of the
// machine to be read.  Nothing where there is none; `faults` says what is wrong with it.
std::optional<std::string> manifest_text(const CryptomatteInfo& info, std::vector<std::string>& faults);

// Pairs of strings of one JSON object, as far as they can be read.  What is wrong is noted and passed over:
// names in another encoding, an end that is missing.
class ManifestScanner {
public:
    explicit ManifestScanner(std::string_view text);

    // The next pair of name and value; nothing at the end.
    std::optional<std::pair<std::string, std::string>> next();

    void fault(std::string what);
    const std::string& first_fault() const { return fault_; }

private:
    void skip_blanks();
    bool take(char c);
    std::optional<std::string> take_string();
    void take_escape(std::string& out);
    std::optional<uint32_t> take_code_unit();
    void stop(std::string what);

    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t pairs_ = 0;
    std::string fault_;
};

}  // namespace keyline

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/io/helper/protocol.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace keyline {

// What comes with a request.
struct HelperInput {
    const HelperRequest& request;
    std::span<const std::byte> bytes;
    int descriptor;               // an open file, the session's own; -1 for none
    std::span<std::byte> shared;  // memory that Keyline sees too
};

// What a session does; what it throws is told.
using HelperSession = std::function<std::vector<std::byte>(const HelperInput&)>;

// A failure of another kind than the input's, or with something to do about it.
class HelperFailure : public std::runtime_error {
public:
    HelperFailure(HelperReply::Outcome outcome, const std::string& what, std::string hint, uint32_t passing)
        : runtime_error(what), outcome_(outcome), hint_(std::move(hint)), passing_(passing) {}
    HelperReply::Outcome outcome() const { return outcome_; }
    const std::string& hint() const { return hint_; }
    uint32_t passing() const { return passing_; }

private:
    HelperReply::Outcome outcome_;
    std::string hint_;
    uint32_t passing_;
};

// The main function of a helper program: starts sessions until Keyline ends.  `make_session` is called in the
// process of each.  Returns the exit status.
int serve(const std::function<HelperSession()>& make_session);

}  // namespace keyline

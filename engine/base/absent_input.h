// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/error.h"

namespace KEYLINE_API keyline {

// The file of an input is not there.  A render that waits for its inputs takes it for one that is not whole
// yet.
class AbsentInput final : public Failure {
public:
    AbsentInput(const std::string& file, std::string hint)
        : Failure({ErrorKind::kInput,
                   {},
                   {},
                   file + ": no such file",
                   std::move(hint),
                   Passing::kNever,
                   Code::kFileMissing}) {}
};

}  // namespace keyline

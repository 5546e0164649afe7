// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/temporary_folder.h"

#include "engine/base/error.h"

#include <cerrno>
#include <cstdlib>
#include <fmt/format.h>
#include <system_error>

namespace keyline::cli {

TemporaryFolder::TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "keyline-XXXXXX").string();
    if (!mkdtemp(name.data()))
        fail(ErrorKind::kFailed,
             fmt::format("no folder can be made in {}: {}",
                         in_quotes(std::filesystem::temp_directory_path().string()),
                         std::generic_category().message(errno)),
             "$TMPDIR says where");
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code unheard;
    std::filesystem::remove_all(path_, unheard);
}

}  // namespace keyline::cli

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/library_place.h"

#include "engine/base/error.h"

#include <dlfcn.h>

namespace keyline {

std::filesystem::path library_folder() {
    Dl_info library = {};
    if (dladdr(reinterpret_cast<void*>(&library_folder), &library) == 0 || library.dli_fname == nullptr)
        fail(ErrorKind::kInternal, "the folder of the Keyline library is not known");
    return std::filesystem::absolute(library.dli_fname).parent_path();
}

}  // namespace keyline

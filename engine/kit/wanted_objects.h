// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/kit/cryptomatte.h"

#include <compare>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

// Objects of a Cryptomatte as graphs name them, in a parameter called "objects".

namespace KEYLINE_API keyline {

struct WantedObject {
    uint32_t id = 0;
    std::string unchecked;  // its name, where no manifest says that there is such an object

    friend auto operator<=>(const WantedObject&, const WantedObject&) = default;
};

// Sorted by id, each once.  * in a pattern stands for any characters, \* for itself.  A name that a whole
// manifest does not have is refused; without a whole one it is warned of, and looked for by its hash.
// `manifest` may be null.
std::vector<WantedObject> wanted_objects(Builder& builder,
                                         const std::shared_ptr<const CryptomatteManifest>& manifest,
                                         const std::vector<std::string>& patterns);

}  // namespace keyline

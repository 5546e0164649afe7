// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/versions.h"

#include "engine/color/color.h"
#include "engine/io/oiio/picture_tasks.h"

#include <fmt/format.h>
#include <openexr.h>

namespace keyline {

namespace {

std::string openexr_version() {
    int major = 0, minor = 0, patch = 0;
    exr_get_library_version(&major, &minor, &patch, nullptr);
    return fmt::format("{}.{}.{}", major, minor, patch);
}

}  // namespace

std::string keyline_version() { return KEYLINE_VERSION; }

std::vector<LibraryVersion> library_versions() {
    std::vector<LibraryVersion> out{
        {"OpenEXR", openexr_version()},         {"Imath", KEYLINE_IMATH_VERSION},
        {"OpenColorIO", opencolorio_version()}, {"oneTBB", KEYLINE_TBB_VERSION},
        {"Highway", KEYLINE_HIGHWAY_VERSION},   {"libdeflate", KEYLINE_LIBDEFLATE_VERSION},
        {"fmt", KEYLINE_FMT_VERSION},           {"nlohmann_json", KEYLINE_JSON_VERSION}};
    const std::string openimageio = KEYLINE_OPENIMAGEIO_VERSION;
    if (!openimageio.empty() && std::filesystem::exists(helper_folder() / oiio::kPictureHelper.name))
        out.push_back({"OpenImageIO", openimageio});
    return out;
}

}  // namespace keyline

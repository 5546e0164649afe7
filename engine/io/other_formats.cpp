// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/other_formats.h"

#include "engine/io/oiio/picture_tasks.h"
#include "engine/io/output_format.h"

namespace keyline {

bool is_other_format(const std::filesystem::path& file) { return extension_of(file) != "exr"; }

bool picture_helper_runs() { return helper_is_running(oiio::kPictureHelper); }

}  // namespace keyline

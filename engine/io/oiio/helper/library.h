// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// OpenImageIO's headers bring a copy of fmt under the guards of the real one: the one that is linked must
// come first, or a source would use both.

// clang-format off
#include <fmt/format.h>
#include <OpenImageIO/imageio.h>
// clang-format on

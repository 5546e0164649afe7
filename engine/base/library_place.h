// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace keyline {

// The folder of the file that holds the engine: the library, or a program that holds it itself.  What is
// installed with it is found from here, wherever all of it was put.
std::filesystem::path library_folder();

}  // namespace keyline

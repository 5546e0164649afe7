// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/io/image_sink.h"
#include "engine/io/image_source.h"

#include <cstddef>
#include <filesystem>
#include <memory>

// Formats other than OpenEXR are read and written by a module that is loaded when the first such file is met:
// the libraries behind it are many, and a job without such files must not wait for them.
//
// The module is `keyline/keyline_image_io.so` in the folder of the Keyline library and defines the functions
// below.  What they return the caller owns; they may throw Failure.

extern "C" {
using KeylineOpenImage = keyline::ImageSource*(const char* path, const keyline::OpenOptions* options);
using KeylineCreateImage = keyline::ImageSink*(const char* path, const keyline::SinkSpec* spec);

KeylineOpenImage keyline_open_image;
KeylineCreateImage keyline_create_image;
}

namespace keyline {

// Throw Failure: kInput or kOutput where the module can't be loaded, else as open_image() and create_image().
std::unique_ptr<ImageSource> open_with_module(const std::filesystem::path& file, const OpenOptions& options);
std::unique_ptr<ImageSink> create_with_module(const std::filesystem::path& file, const SinkSpec& spec);

// Whether a file of this name is written by the module.
bool needs_module(const std::filesystem::path& file);

bool module_is_loaded();

// What the module and the libraries behind it add to the process, as measured with an empty image: most of it
// is the libraries' own start.
constexpr std::size_t kModuleBytes = std::size_t{124} << 20;

// The folder of Keyline's own modules and helper programs, beside its library.
std::filesystem::path module_folder();

}  // namespace keyline

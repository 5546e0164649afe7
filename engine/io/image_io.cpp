// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0

// The two functions of the module for formats other than OpenEXR.  Only this module links OpenImageIO, which
// brings some 260 libraries: a program that merely links it takes 0.2 s and 130 MB before it begins.

#include "engine/io/image_io_bands.h"
#include "engine/io/image_io_reader.h"
#include "engine/io/image_io_writer.h"
#include "engine/io/image_module.h"

extern "C" keyline::ImageSource* keyline_open_image(const char* path, const keyline::OpenOptions* options) {
    keyline::oiio::use_no_threads();
    return keyline::oiio::open_picture(path, *options).release();
}

extern "C" keyline::ImageSink* keyline_create_image(const char* path, const keyline::SinkSpec* spec) {
    keyline::oiio::use_no_threads();
    return keyline::oiio::create_picture(path, *spec).release();
}

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/geometry.h"
#include "engine/base/image.h"
#include "engine/base/metadata.h"
#include "engine/io/exr/file.h"
#include "engine/io/exr/format.h"

#include <memory>
#include <openexr.h>
#include <string>
#include <vector>

namespace keyline::exr {

// A file as OpenEXRCore sees it, its headers parsed.  Core keeps quiet: what it has to say becomes the text
// of a Failure.  Reading chunks through it is safe from any number of threads.
class ReadContext {
public:
    // Throws Failure (kInput) where Core does not accept the headers.  `file` must outlive the context.
    explicit ReadContext(const InputFile& file);
    ~ReadContext();
    ReadContext(const ReadContext&) = delete;
    ReadContext& operator=(const ReadContext&) = delete;

    exr_const_context_t get() const { return context_; }

private:
    struct Stream;  // what Core's callbacks are given
    std::unique_ptr<Stream> stream_;
    exr_context_t context_ = nullptr;
};

enum class Storage { kScanline, kTiled, kDeep };

struct StoredChannel {
    std::string name;
    SampleType type;
    int x_sampling = 1, y_sampling = 1;
    uint8_t is_linear = 0;  // perceptually, as B44 and DWA want to know

    bool subsampled() const { return x_sampling != 1 || y_sampling != 1; }
};

struct Part {
    std::string name;                // empty where the part has none
    std::string view;                // empty where the part belongs to none
    std::vector<std::string> views;  // of a part that holds several ("multiView"), the default one first
    Storage storage = Storage::kScanline;
    Compression compression = Compression::kNone;
    Rect display_window, data_window;
    std::vector<StoredChannel> channels;  // in the file's order
    int chunk_width = 0, chunk_height = 0;
    Metadata metadata;

    bool subsampled() const;
    std::vector<SampleType> types() const;
};

// `attributes`: as read_attributes() gives them, a list a part.  Throws Failure (kInput) for what Keyline
// can't hold: windows beyond kMaxCoordinate, unknown compression.
std::vector<Part> read_parts(const InputFile& file, const ReadContext& context,
                             std::vector<std::vector<Attribute>> attributes);

}  // namespace keyline::exr

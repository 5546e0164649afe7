// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/error.h"
#include "engine/io/exr/file.h"
#include "engine/io/exr/format.h"
#include "engine/io/exr/reader.h"
#include "engine/io/exr/writer.h"
#include "engine/io/file_identity.h"
#include "engine/io/image_sink.h"
#include "engine/io/image_source.h"
#include "engine/io/oiio/reader.h"
#include "engine/io/oiio/writer.h"
#include "engine/io/other_formats.h"
#include "engine/io/output_file.h"
#include "engine/io/output_format.h"
#include "engine/io/sink_memory.h"
#include "engine/io/system_call.h"
#include "engine/io/unfinished.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace keyline {

namespace {

// What was created and is about to be written is empty for a while.
bool has_exr_content(const std::filesystem::path& file) {
    const exr::InputFile in(file);
    if (in.size() == 0)
        fail(ErrorKind::kInput, fmt::format("{}: the file is empty", file.string()), kUnfinishedHint,
             Passing::kUnfinished);
    std::array<std::byte, exr::kMagic.size()> start = {};
    in.read_some(0, start);
    return start == exr::kMagic;
}

std::unique_ptr<FileSource> open_file(const std::filesystem::path& file, const OpenOptions& options) {
    if (has_exr_content(file)) return exr::open_exr(file, options);
    if (!is_other_format(file))
        fail(ErrorKind::kInput,
             fmt::format("{}: not an OpenEXR file, as its name says it is", file.string()));
    return oiio::open_picture(file, options);
}

}  // namespace

Digest image_digest(const std::filesystem::path& file, const OpenOptions& options) {
    return Digester("image").add(file_identity(file)).add(options.part).add(options.view).digest();
}

std::unique_ptr<ImageSource> open_image(const std::filesystem::path& file, const OpenOptions& options) {
    // Before it is opened: a file replaced meanwhile has another identity when it is asked for again.
    const Digest digest = image_digest(file, options);
    std::unique_ptr<FileSource> source = open_file(file, options);
    source->set_file(file);
    source->set_digest(digest);
    return source;
}

std::unique_ptr<ImageSink> create_image(const std::filesystem::path& file, const SinkSpec& spec) {
    return !is_other_format(file) ? exr::create_exr(file, spec) : oiio::create_picture(file, spec);
}

void check_image(const std::filesystem::path& file, const SinkSpec& spec) {
    if (!is_other_format(file))
        exr::layout_of(spec);
    else
        picture_layout(file, spec);
}

SinkShape sink_shape(const std::filesystem::path& file, const SinkSpec& spec) {
    if (is_other_format(file)) {
        const Rect& rows = spec.display_window;
        return {std::min(kPictureChunkRows, rows.height()),
                spec.channels.size() * sizeof(float) * static_cast<std::size_t>(rows.width())};
    }
    const exr::Layout layout = exr::layout_of(spec);
    std::size_t pixel = 0;
    for (const exr::StoredChannel& c : layout.channels) pixel += sample_size(c.type);
    return {std::min(exr::rows_at_once(layout), layout.data_window.height()),
            pixel * static_cast<std::size_t>(layout.data_window.width())};
}

SinkMemory sink_memory(const std::filesystem::path& file, const SinkSpec& spec) {
    return is_other_format(file) ? picture_memory(file, spec) : exr::memory_of(spec);
}

void remove_leftovers(const std::filesystem::path& file) {
    const std::filesystem::path folder = behind_links(file).parent_path();
    remove_unfinished(folder.empty() ? "." : folder);
}

}  // namespace keyline

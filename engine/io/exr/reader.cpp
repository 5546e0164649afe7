// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/exr/reader.h"

#include "engine/base/error.h"
#include "engine/io/exr/contained.h"
#include "engine/io/exr/metadata.h"
#include "engine/io/exr/parts.h"
#include "engine/io/exr/unpack.h"
#include "engine/io/pool.h"

#include <algorithm>
#include <fmt/format.h>
#include <span>

namespace keyline::exr {

namespace {

// Chunks of one row are handed on in cells of this many, so that a cell is worth a task.
constexpr int kRowsOfSmallChunks = 32;

std::unique_ptr<Unpacker> make_unpacker(const InputFile& file, const ReadContext& context, const Part& part,
                                        int index) {
    if (ContainedUnpacker::is_for(part))
        return std::make_unique<ContainedUnpacker>(file, context, part, index);
    return std::make_unique<ChunkUnpacker>(file, context, part, index);
}

// How many rows are unpacked at once.
int block_rows(const Part& part) {
    return ContainedUnpacker::is_for(part) ? ContainedUnpacker::block_rows(part) : part.chunk_height;
}

BlockLayout delivered_layout(const Part& part) {
    std::vector<SampleType> types;
    for (const ChannelInfo& channel : delivered_channels(part)) types.push_back(channel.type);
    return BlockLayout(types);
}

class Source final : public FileSource {
public:
    Source(const std::filesystem::path& file, const OpenOptions& options) : file_(file) {
        // First, as it bounds how much there is for Core to parse.
        std::vector<std::vector<Attribute>> attributes = read_attributes(file_);
        context_ = std::make_unique<ReadContext>(file_);
        parts_ = read_parts(file_, *context_, std::move(attributes));
        for (const TakenPart& taken : choose_parts(file_.name(), parts_, options)) {
            if (taken.channels.empty()) continue;
            refuse_excess(parts_[taken.index], options.max_chunk_bytes);
            add_group(taken);
        }
        for (const Part& part : parts_) add_cryptomattes(part);
        if (groups_.empty())
            fail(ErrorKind::kInput, fmt::format("{}: no channels in the view that is wanted", file_.name()));
        header_.format = "openexr";
    }

    void read_chunk(std::size_t group, int column, int row, std::span<const Plane> planes) const override {
        const Group& g = *groups_[group];
        const Rect cell = header_.groups[group].chunk(column, row);
        check_planes(header_.groups[group], cell, planes);
        const auto unpacker = g.unpackers.take();
        for (int y = cell.y0; y < cell.y1; y += g.block_rows) {
            const Rect rect = intersect(cell, {cell.x0, y, cell.x1, y + g.block_rows});
            if (std::ranges::any_of(planes, [&](const Plane& p) { return wants(p, rect); }))
                read_block(g, *unpacker, rect, planes);
        }
    }

    std::size_t chunk_memory(std::size_t group) const override {
        const Part& part = groups_[group]->part;
        return ContainedUnpacker::is_for(part) ? ContainedUnpacker::memory(part)
                                               : ChunkUnpacker::memory(part, large_chunk(part));
    }

    bool rest() const override {
        for (const auto& group : groups_) group->unpackers.clear();
        return true;
    }

private:
    // How large a part's chunks are in the file; few hold more than three times their share.
    std::size_t large_chunk(const Part& part) const {
        const double share = double(part.chunk_width) * block_rows(part) / double(part.data_window.area());
        return static_cast<std::size_t>(3 * share * static_cast<double>(file_.size()));
    }

    struct Group {
        Group(const InputFile& file, const ReadContext& context, const Part& p, const TakenPart& taken)
            : part(p),
              index(static_cast<int>(taken.index)),
              block_rows(exr::block_rows(p)),
              layout(delivered_layout(p)),
              unpackers([&file, &context, this] { return make_unpacker(file, context, part, index); }) {
            for (const DeliveredChannel& channel : taken.channels) channels.push_back(channel.index);
        }

        const Part& part;
        int index, block_rows;
        BlockLayout layout;                 // of what is delivered
        std::vector<std::size_t> channels;  // in the layout, in the group's order
        mutable Pool<Unpacker> unpackers;
    };

    static void check_planes(const ChannelGroup& group, const Rect& cell, std::span<const Plane> planes) {
        const auto fits = [](const Plane& p, const ChannelInfo& c) {
            return p.data == nullptr || p.type == c.type;
        };
        if (cell.empty() || !std::ranges::equal(planes, group.channels, fits))
            fail(ErrorKind::kInternal, "a chunk was asked for that is not there, or in other types");
    }

    static bool wants(const Plane& plane, const Rect& rect) {
        return plane.data != nullptr && !intersect(plane.rect, rect).empty();
    }

    void read_block(const Group& g, Unpacker& unpacker, const Rect& rect,
                    std::span<const Plane> planes) const {
        try {
            const Block block = unpacker.unpack(rect);
            for (std::size_t i = 0; i < planes.size(); ++i)
                if (wants(planes[i], rect)) store(block, g.layout, g.channels[i], planes[i]);
        } catch (const Failure& failure) {
            fail_at(g.part, rect, failure.error().what);
        }
    }

    [[noreturn]] void fail_at(const Part& part, const Rect& rect, const std::string& why) const {
        file_.fail_where_the_system_did();
        const std::string of_part =
            parts_.size() > 1 ? fmt::format(" of part {}", in_quotes(part.name)) : std::string();
        const std::string columns =
            part.storage == Storage::kTiled ? fmt::format(", columns {} to {},", rect.x0, rect.x1 - 1) : "";
        fail(ErrorKind::kInput,
             fmt::format("{}: rows {} to {}{}{} can't be read: {}", file_.name(), rect.y0, rect.y1 - 1,
                         columns, of_part, why),
             "the file is damaged or was not finished");
    }

    // Before anything is planned on the strength of a header: could the file hold what it declares, and does
    // a chunk fit in memory?
    void refuse_excess(const Part& part, std::size_t max_chunk_bytes) const {
        const double pixel = static_cast<double>(BlockLayout(part.types()).pixel_bytes());
        const double chunk = pixel * part.chunk_width * block_rows(part);
        if (chunk > static_cast<double>(max_chunk_bytes))
            fail(ErrorKind::kInput,
                 fmt::format("{}: a chunk of {} × {} pixels unpacks to {:.0f} bytes, above the "
                             "limit of {}",
                             file_.name(), part.chunk_width, block_rows(part), chunk, max_chunk_bytes));
        const double declared = pixel * static_cast<double>(part.data_window.area());
        const double most = std::max(info(part.compression).ratio, info(Compression::kZip).ratio) *
                            static_cast<double>(file_.size());
        if (declared > most)
            fail(ErrorKind::kInput,
                 fmt::format(
                     "{}: {} × {} pixels are declared, {:.0f} bytes of samples, which a file of {} bytes "
                     "can't hold",
                     file_.name(), part.data_window.width(), part.data_window.height(), declared,
                     file_.size()),
                 "the file is damaged or was not finished");
    }

    void add_group(const TakenPart& taken) {
        const Part& part = parts_[taken.index];
        ChannelGroup group{{}, part.data_window, part.chunk_width, part.chunk_height};
        group.chunk_height = block_rows(part);
        if (part.storage == Storage::kScanline && group.chunk_height == 1)
            group.chunk_height = std::min(part.data_window.height(), kRowsOfSmallChunks);
        for (const DeliveredChannel& channel : taken.channels) group.channels.push_back(channel.info);
        if (header_.groups.empty()) header_.display_window = part.display_window;
        header_.data_window = unite(header_.data_window, part.data_window);
        // What several parts share stands in each; what only one tells (a manifest) is kept as well.
        for (const Attribute& attribute : part.metadata.attributes())
            if (header_.metadata.find(attribute.name) == nullptr) header_.metadata.set(attribute);
        header_.groups.push_back(std::move(group));
        groups_.push_back(std::make_unique<Group>(file_, *context_, part, taken));
    }

    // Any part may tell of the Cryptomatte of another.
    void add_cryptomattes(const Part& part) {
        for (const Attribute& attribute : part.metadata.attributes())
            if (attribute.name.starts_with("cryptomatte/") &&
                header_.metadata.find(attribute.name) == nullptr)
                header_.metadata.set(attribute);
    }

    InputFile file_;
    std::unique_ptr<ReadContext> context_;
    std::vector<Part> parts_;
    std::vector<std::unique_ptr<Group>> groups_;
};

}  // namespace

std::unique_ptr<FileSource> open_exr(const std::filesystem::path& file, const OpenOptions& options) {
    return std::make_unique<Source>(file, options);
}

}  // namespace keyline::exr

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/mended_source.h"

#include "engine/base/error.h"

#include <algorithm>
#include <bit>
#include <compare>
#include <cstring>
#include <fmt/format.h>
#include <map>
#include <mutex>

namespace keyline {

namespace {

struct Half {
    using Bits = uint16_t;
    static constexpr Bits kExponent = 0x7C00, kMantissa = 0x03FF, kSign = 0x8000, kLargest = 0x7BFF;  // 65504
};

struct Float {
    using Bits = uint32_t;
    static constexpr Bits kExponent = 0x7F800000, kMantissa = 0x007FFFFF, kSign = 0x80000000;
    static constexpr Bits kLargest = std::bit_cast<uint32_t>(1e10F);
};

// A plain loop that compilers vectorise: nearly every row has none.
template <class Format>
bool any_special(const typename Format::Bits* row, int n) {
    unsigned found = 0;
    for (int i = 0; i < n; ++i) found |= (row[i] & Format::kExponent) == Format::kExponent ? 1U : 0U;
    return found != 0;
}

bool any_inexact(const uint32_t* row, int n) {
    unsigned found = 0;
    for (int i = 0; i < n; ++i)
        found |= static_cast<double>(static_cast<float>(row[i])) != static_cast<double>(row[i]) ? 1U : 0U;
    return found != 0;
}

// The samples of a chunk's channel that were found wanting: a bit each.
class Marks {
public:
    explicit Marks(const Rect& chunk)
        : chunk_(chunk), bits_((static_cast<std::size_t>(chunk.area()) + 63) / 64) {}

    void set(int x, int y) { bits_[index(x, y) / 64] |= uint64_t{1} << (index(x, y) % 64); }

    std::size_t count(const Rect& rect) const {
        const Rect part = intersect(rect, chunk_);
        std::size_t sum = 0;
        for (int y = part.y0; y < part.y1; ++y) sum += count(index(part.x0, y), index(part.x1, y));
        return sum;
    }

private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y - chunk_.y0) * static_cast<std::size_t>(chunk_.width()) +
               static_cast<std::size_t>(x - chunk_.x0);
    }
    std::size_t count(std::size_t begin, std::size_t end) const {
        std::size_t sum = 0;
        while (begin < end) {
            const std::size_t stop = std::min(end, (begin / 64 + 1) * 64);
            uint64_t word = bits_[begin / 64] >> (begin % 64);
            if (stop - begin < 64) word &= (uint64_t{1} << (stop - begin)) - 1;
            sum += static_cast<std::size_t>(std::popcount(word));
            begin = stop;
        }
        return sum;
    }

    Rect chunk_;
    std::vector<uint64_t> bits_;
};

std::string plural(std::size_t n, const char* what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

class Mended final : public ImageSource {
public:
    Mended(std::shared_ptr<const ImageSource> source, NanPolicy policy)
        : source_(std::move(source)), policy_(policy) {
        set_digest(Digester("mended").add(source_->digest()).add(static_cast<int>(policy)).digest());
    }

    const ImageHeader& header() const override { return source_->header(); }
    std::size_t chunk_memory(std::size_t group) const override { return source_->chunk_memory(group); }
    std::size_t held_memory() const override { return source_->held_memory(); }
    bool rest() const override { return source_->rest(); }

    void read_chunk(std::size_t group, int column, int row, std::span<const Plane> planes) const override {
        source_->read_chunk(group, column, row, planes);
        const ChannelGroup& g = header().groups[group];
        const Rect chunk = g.chunk(column, row);
        for (std::size_t c = 0; c < planes.size(); ++c)
            if (planes[c].data) mend(planes[c], chunk, {group, c, column, row});
    }

    std::vector<std::string> findings(std::span<const Rect> demanded) const override {
        std::vector<std::string> out = source_->findings(demanded);
        std::size_t mended = 0, inexact = 0;
        const std::lock_guard lock(mutex_);
        for (const auto& [place, marks] : marks_) {
            std::size_t first = 0;
            for (std::size_t g = 0; g < place.group; ++g) first += header().groups[g].channels.size();
            const bool is_uint =
                header().groups[place.group].channels[place.channel].type == SampleType::kUint;
            (is_uint ? inexact : mended) += marks.count(demanded[first + place.channel]);
        }
        if (mended > 0) out.push_back(plural(mended, "NaN or infinite sample") + " mended");
        if (inexact > 0)
            out.push_back(plural(inexact, "uint sample") +
                          " above 2^24 rounded where a node takes ids for numbers");
        return out;
    }

private:
    struct ChunkChannel {
        std::size_t group, channel;
        int column, row;
        friend auto operator<=>(const ChunkChannel&, const ChunkChannel&) = default;
    };

    void mend(const Plane& plane, const Rect& chunk, const ChunkChannel& place) const {
        if (policy_ == NanPolicy::kKeep && plane.type != SampleType::kUint) return;
        const Rect rect = intersect(chunk, plane.rect);
        std::size_t count = 0;
        for (int y = rect.y0; y < rect.y1; ++y) {
            std::byte* row = plane.at(rect.x0, y);
            const auto mark = [&](int i) { marks(place, chunk).set(rect.x0 + i, y), ++count; };
            switch (plane.type) {
                case SampleType::kHalf:
                    mend_row<Half>(reinterpret_cast<uint16_t*>(row), rect.width(), mark);
                    break;
                case SampleType::kFloat:
                    mend_row<Float>(reinterpret_cast<uint32_t*>(row), rect.width(), mark);
                    break;
                case SampleType::kUint:
                    mark_inexact(reinterpret_cast<const uint32_t*>(row), rect.width(), mark);
                    break;
            }
        }
        if (count > 0 && policy_ == NanPolicy::kError && plane.type != SampleType::kUint)
            fail(ErrorKind::kInput,
                 fmt::format("{} in channel {} at rows {} to {}", plural(count, "NaN or infinite sample"),
                             in_quotes(header().groups[place.group].channels[place.channel].name), rect.y0,
                             rect.y1 - 1),
                 "set \"nan\" to \"mend\" or \"keep\" to go on");
    }

    template <class Format, class Mark>
    void mend_row(typename Format::Bits* row, int n, const Mark& mark) const {
        if (!any_special<Format>(row, n)) return;
        const std::lock_guard lock(mutex_);
        for (int i = 0; i < n; ++i) {
            if ((row[i] & Format::kExponent) != Format::kExponent) continue;
            const bool is_nan = (row[i] & Format::kMantissa) != 0;
            row[i] =
                is_nan ? 0 : static_cast<typename Format::Bits>((row[i] & Format::kSign) | Format::kLargest);
            mark(i);
        }
    }

    template <class Mark>
    void mark_inexact(const uint32_t* row, int n, const Mark& mark) const {
        if (!any_inexact(row, n)) return;
        const std::lock_guard lock(mutex_);
        for (int i = 0; i < n; ++i)
            if (any_inexact(row + i, 1)) mark(i);
    }

    Marks& marks(const ChunkChannel& place, const Rect& chunk) const {
        return marks_.try_emplace(place, chunk).first->second;
    }

    std::shared_ptr<const ImageSource> source_;
    NanPolicy policy_;
    mutable std::mutex mutex_;                     // guards what follows; only what is rare takes it
    mutable std::map<ChunkChannel, Marks> marks_;  // of chunks where something was found
};

class Black final : public ImageSource {
public:
    explicit Black(const ImageSource& like) : header_(like.header()) {
        set_digest(Digester("black").add(like.digest()).digest());
    }
    bool rest() const override { return true; }
    const ImageHeader& header() const override { return header_; }
    std::size_t chunk_memory(std::size_t) const override { return 0; }

    void read_chunk(std::size_t group, int column, int row, std::span<const Plane> planes) const override {
        for (const Plane& plane : planes) {
            if (!plane.data) continue;
            const Rect rect = intersect(header_.groups[group].chunk(column, row), plane.rect);
            for (int y = rect.y0; y < rect.y1; ++y)
                std::memset(plane.at(rect.x0, y), 0,
                            sample_size(plane.type) * static_cast<std::size_t>(rect.width()));
        }
    }

private:
    ImageHeader header_;
};

}  // namespace

std::shared_ptr<const ImageSource> mended(std::shared_ptr<const ImageSource> source, NanPolicy policy) {
    return std::make_shared<Mended>(std::move(source), policy);
}

std::shared_ptr<const ImageSource> black_like(const ImageSource& like) {
    return std::make_shared<Black>(like);
}

}  // namespace keyline

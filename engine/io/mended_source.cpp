// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/mended_source.h"

#include "engine/error.h"

#include <atomic>
#include <bit>
#include <cstring>
#include <fmt/format.h>

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

template <class Format>
std::size_t mend_row(typename Format::Bits* row, int n) {
    if (!any_special<Format>(row, n)) return 0;
    std::size_t count = 0;
    for (int i = 0; i < n; ++i) {
        if ((row[i] & Format::kExponent) != Format::kExponent) continue;
        const bool is_nan = (row[i] & Format::kMantissa) != 0;
        row[i] = is_nan ? 0 : static_cast<typename Format::Bits>((row[i] & Format::kSign) | Format::kLargest);
        ++count;
    }
    return count;
}

std::size_t count_inexact(const uint32_t* row, int n) {
    std::size_t count = 0;
    for (int i = 0; i < n; ++i)
        count += static_cast<double>(static_cast<float>(row[i])) != static_cast<double>(row[i]) ? 1 : 0;
    return count;
}

std::string plural(std::size_t n, const char* what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

class Mended final : public ImageSource {
public:
    Mended(std::shared_ptr<const ImageSource> source, NanPolicy policy)
        : source_(std::move(source)), policy_(policy) {
        for (const ChannelGroup& g : header().groups) {
            const auto chunks = static_cast<std::size_t>(g.columns()) * static_cast<std::size_t>(g.rows());
            seen_.emplace_back(chunks * g.channels.size());
        }
    }

    const ImageHeader& header() const override { return source_->header(); }
    std::size_t chunk_memory(std::size_t group) const override { return source_->chunk_memory(group); }

    void read_chunk(std::size_t group, int column, int row, std::span<const Plane> planes) const override {
        source_->read_chunk(group, column, row, planes);
        const ChannelGroup& g = header().groups[group];
        const Rect chunk = g.chunk(column, row);
        const auto index = static_cast<std::size_t>(row) * static_cast<std::size_t>(g.columns()) +
                           static_cast<std::size_t>(column);
        for (std::size_t c = 0; c < planes.size(); ++c) {
            if (!planes[c].data) continue;
            const bool first =
                !seen_[group][index * planes.size() + c].exchange(true, std::memory_order_relaxed);
            mend(planes[c], intersect(chunk, planes[c].rect), g.channels[c].name, first);
        }
    }

    std::vector<std::string> findings() const override {
        std::vector<std::string> out = source_->findings();
        if (mended_ > 0) out.push_back(plural(mended_, "NaN or infinite sample") + " mended");
        if (inexact_ > 0)
            out.push_back(plural(inexact_, "uint sample") +
                          " above 2^24 rounded wherever something is computed from them");
        return out;
    }

private:
    void mend(const Plane& plane, const Rect& rect, const std::string& channel, bool first) const {
        if (policy_ == NanPolicy::kKeep && plane.type != SampleType::kUint) return;
        std::size_t count = 0;
        for (int y = rect.y0; y < rect.y1; ++y) {
            std::byte* row = plane.at(rect.x0, y);
            switch (plane.type) {
                case SampleType::kHalf:
                    count += mend_row<Half>(reinterpret_cast<uint16_t*>(row), rect.width());
                    break;
                case SampleType::kFloat:
                    count += mend_row<Float>(reinterpret_cast<uint32_t*>(row), rect.width());
                    break;
                case SampleType::kUint:
                    count += count_inexact(reinterpret_cast<const uint32_t*>(row), rect.width());
                    break;
            }
        }
        if (count == 0) return;
        if (policy_ == NanPolicy::kError && plane.type != SampleType::kUint)
            fail(ErrorKind::kInput,
                 fmt::format("{} in channel {} at rows {} to {}", plural(count, "NaN or infinite sample"),
                             in_quotes(channel), rect.y0, rect.y1 - 1),
                 "set \"nan\" to \"mend\" or \"keep\" to go on");
        if (first) (plane.type == SampleType::kUint ? inexact_ : mended_) += count;
    }

    std::shared_ptr<const ImageSource> source_;
    NanPolicy policy_;
    mutable std::vector<std::vector<std::atomic<bool>>> seen_;  // by group: chunk × channel
    mutable std::atomic<std::size_t> mended_ = 0, inexact_ = 0;
};

class Black final : public ImageSource {
public:
    explicit Black(const ImageSource& like) : header_(like.header()) {}
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

std::shared_ptr<const ImageSource> black_like(std::shared_ptr<const ImageSource> source) {
    return std::make_shared<Black>(*source);
}

}  // namespace keyline

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/components.h"

#include "engine/base/index.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <span>

namespace keyline {

namespace {

constexpr int kNone = BlockComponents::kNone;

// Union–find over consecutive numbers; the smaller root wins, paths are halved.
int find_root(std::span<int> parent, int i) {
    while (parent[index(i)] != i) {
        int& p = parent[index(i)];
        p = parent[index(p)];
        i = p;
    }
    return i;
}

void join_roots(std::span<int> parent, int a, int b) {
    a = find_root(parent, a);
    b = find_root(parent, b);
    parent[index(std::max(a, b))] = std::min(a, b);
}

// The bits of a word at and after `from`, and before `to`.
uint64_t mask(int from, int to) {
    const uint64_t low = ~uint64_t{0} << from;
    return to >= 64 ? low : low & ~(~uint64_t{0} << to);
}

// Of a word of a row: the pixels whose left neighbour is not set, and those whose right neighbour is not.
struct RunEnds {
    uint64_t starts, ends;
};
RunEnds run_ends(const uint64_t* row, int w, int words) {
    const uint64_t word = row[w], left = w > 0 ? row[w - 1] >> 63 : 0,
                   right = w + 1 < words ? row[w + 1] << 63 : 0;
    return {word & ~(word << 1 | left), word & ~(word >> 1 | right)};
}

std::size_t count_runs(const BitRows& bits) {
    int count = 0;
    for (int y = bits.rect().y0; y < bits.rect().y1; ++y)
        for (int w = 0; w < bits.words(); ++w)
            count += std::popcount(run_ends(bits.row(y), w, bits.words()).starts);
    return static_cast<std::size_t>(count);
}

// Writes down the runs of a row; returns how many.
std::size_t find_runs(const BitRows& bits, int y, PixelRun* runs) {
    PixelRun *start = runs, *end = runs;
    for (int w = 0; w < bits.words(); ++w) {
        auto [starts, ends] = run_ends(bits.row(y), w, bits.words());
        const int x = bits.rect().x0 + w * 64;
        for (; starts != 0; starts &= starts - 1) *start++ = {y, x + std::countr_zero(starts), 0};
        for (; ends != 0; ends &= ends - 1) (end++)->x1 = x + std::countr_zero(ends) + 1;
    }
    return static_cast<std::size_t>(start - runs);
}

// Joins each run of [begin, end) with those of the row above that touch it, diagonals included.
void join_rows(std::span<const PixelRun> runs, std::size_t above, std::size_t begin, std::size_t end,
               std::span<int> parent) {
    std::size_t a = above, b = begin;
    while (a < begin && b < end) {
        if (runs[a].x0 <= runs[b].x1 && runs[b].x0 <= runs[a].x1)
            join_roots(parent, static_cast<int>(a), static_cast<int>(b));
        if (runs[a].x1 < runs[b].x1)
            ++a;
        else
            ++b;
    }
}

class BlockLabeller {
public:
    BlockLabeller(const BitRows& pixels, const BitRows& seeds, Scratch& scratch)
        : rect_(pixels.rect()),
          runs_(scratch.take<PixelRun>(count_runs(pixels))),
          parent_(scratch.take<int>(runs_.size())),
          traits_(scratch.take<uint8_t>(runs_.size())),
          number_(scratch.take<int>(runs_.size())) {
        std::iota(parent_.begin(), parent_.end(), 0);
        std::size_t above = 0, begin = 0;
        for (int y = rect_.y0; y < rect_.y1; ++y) {
            const std::size_t end = begin + find_runs(pixels, y, runs_.data() + begin);
            join_rows(runs_, above, begin, end, parent_);
            above = begin;
            begin = end;
        }
        settle(seeds);
    }

    BlockComponents result() {
        BlockComponents out;
        out.kept = BitRows(rect_);
        number_border_components(out);
        keep_and_collect(out);
        fill_borders(out);
        return out;
    }

private:
    static constexpr uint8_t kSeeded = 1, kAtBorder = 2;

    bool on_border(const PixelRun& r) const {
        return r.y == rect_.y0 || r.y == rect_.y1 - 1 || r.x0 == rect_.x0 || r.x1 == rect_.x1;
    }
    std::size_t root(std::size_t run) const { return static_cast<std::size_t>(parent_[run]); }

    // Points every run at its component's root, and tells the root of what its runs have.  A parent stands
    // before its children, so that one pass will do.
    void settle(const BitRows& seeds) {
        for (std::size_t i = 0; i < runs_.size(); ++i) {
            const PixelRun& r = runs_[i];
            traits_[i] = static_cast<uint8_t>((seeds.any(r.y, r.x0, r.x1) ? kSeeded : 0) |
                                              (on_border(r) ? kAtBorder : 0));
            parent_[i] = parent_[root(i)];
            traits_[root(i)] |= traits_[i];
        }
    }

    void number_border_components(BlockComponents& out) {
        for (std::size_t i = 0; i < runs_.size(); ++i) {
            number_[i] = kNone;
            if (root(i) != i || (traits_[i] & kAtBorder) == 0) continue;
            number_[i] = static_cast<int>(out.seeded.size());
            out.seeded.push_back((traits_[i] & kSeeded) != 0);
        }
    }

    // Runs grouped by component: counted, then placed.
    void keep_and_collect(BlockComponents& out) {
        out.first_run.assign(out.seeded.size() + 1, 0);
        for (std::size_t i = 0; i < runs_.size(); ++i) {
            const std::size_t r = root(i);
            if ((traits_[r] & kSeeded) != 0)
                out.kept.set(runs_[i].y, runs_[i].x0, runs_[i].x1);
            else if (number_[r] != kNone)
                ++out.first_run[static_cast<std::size_t>(number_[r]) + 1];
        }
        std::partial_sum(out.first_run.begin(), out.first_run.end(), out.first_run.begin());
        out.runs.resize(out.first_run.back());
        if (out.runs.empty()) return;
        std::vector<std::size_t> next = out.first_run;
        for (std::size_t i = 0; i < runs_.size(); ++i)
            if (const std::size_t r = root(i); number_[r] != kNone && (traits_[r] & kSeeded) == 0)
                out.runs[next[index(number_[r])]++] = runs_[i];
    }

    void fill_borders(BlockComponents& out) {
        out.top.assign(static_cast<std::size_t>(rect_.width()), kNone);
        out.bottom = out.top;
        out.left.assign(static_cast<std::size_t>(rect_.height()), kNone);
        out.right = out.left;
        for (std::size_t i = 0; i < runs_.size(); ++i) {
            const PixelRun& r = runs_[i];
            if (!on_border(r)) continue;
            const int number = number_[root(i)];
            const auto y = static_cast<std::size_t>(r.y - rect_.y0);
            const auto fill = [&](std::vector<int>& row) {
                std::fill(row.begin() + (r.x0 - rect_.x0), row.begin() + (r.x1 - rect_.x0), number);
            };
            if (r.y == rect_.y0) fill(out.top);
            if (r.y == rect_.y1 - 1) fill(out.bottom);
            if (r.x0 == rect_.x0) out.left[y] = number;
            if (r.x1 == rect_.x1) out.right[y] = number;
        }
    }

    Rect rect_;
    std::span<PixelRun> runs_;
    std::span<int> parent_;      // by run
    std::span<uint8_t> traits_;  // by root: of any of its runs
    std::span<int> number_;      // by root: in BlockComponents
};

}  // namespace

BitRows::BitRows(const Rect& rect)
    : rect_(rect),
      words_((rect.width() + 63) / 64),
      bits_(static_cast<std::size_t>(words_) * static_cast<std::size_t>(rect.height()), 0) {}

std::size_t BitRows::bytes_for(const Rect& rect) {
    return static_cast<std::size_t>((rect.width() + 63) / 64) * sizeof(uint64_t) *
           static_cast<std::size_t>(rect.height());
}

void BitRows::set(int y, int x0, int x1) {
    uint64_t* r = row(y);
    const int from = x0 - rect_.x0, to = x1 - rect_.x0;
    for (int w = from / 64; w * 64 < to; ++w) r[w] |= mask(std::max(0, from - w * 64), to - w * 64);
}

bool BitRows::any(int y, int x0, int x1) const {
    const uint64_t* r = row(y);
    const int from = x0 - rect_.x0, to = x1 - rect_.x0;
    for (int w = from / 64; w * 64 < to; ++w)
        if ((r[w] & mask(std::max(0, from - w * 64), to - w * 64)) != 0) return true;
    return false;
}

void BitRows::add(const BitRows& block) {
    const int first = block.rect_.x0 - rect_.x0, shift = first % 64;
    for (int y = block.rect_.y0; y < block.rect_.y1; ++y) {
        const uint64_t* from = block.row(y);
        uint64_t* to = row(y) + first / 64;
        for (int w = 0; w < block.words_; ++w) {
            to[w] |= from[w] << shift;
            const uint64_t carried = shift == 0 ? 0 : from[w] >> (64 - shift);
            if (carried != 0) to[w + 1] |= carried;
        }
    }
}

void BitRows::copy_row(int y, int x0, int n, uint64_t* to) const {
    const int first = x0 - rect_.x0, shift = first % 64;
    const uint64_t* from = row(y) + first / 64;
    const int available = words_ - first / 64;
    for (int w = 0; w * 64 < n; ++w) {
        to[w] = from[w] >> shift;
        if (shift != 0 && w + 1 < available) to[w] |= from[w + 1] << (64 - shift);
    }
}

BlockComponents find_components(const BitRows& pixels, const BitRows& seeds, Scratch& scratch) {
    return BlockLabeller(pixels, seeds, scratch).result();
}

ComponentMerger::ComponentMerger(const Rect& window)
    : kept_(window),
      row_y_(window.y0),
      above_(static_cast<std::size_t>(window.width()), kNone),
      bottom_(above_) {}

int ComponentMerger::find(int label) { return find_root(parent_, label); }

void ComponentMerger::join(int a, int b) {
    const int ra = find(a), rb = find(b);
    if (ra == rb) return;
    const auto keep = static_cast<std::size_t>(std::min(ra, rb)),
               drop = static_cast<std::size_t>(std::max(ra, rb));
    parent_[drop] = static_cast<int>(keep);
    if (seeded_[drop]) seeded_[keep] = true;
}

void ComponentMerger::add(BlockComponents block) {
    const Rect rect = block.kept.rect();
    if (rect.empty()) return;
    if (rect.y0 != row_y_) {
        std::swap(above_, bottom_);
        std::ranges::fill(bottom_, kNone);
        right_.clear();
        row_y_ = rect.y0;
    }
    const int base = static_cast<int>(parent_.size());
    for (std::size_t i = 0; i < block.seeded.size(); ++i) {
        parent_.push_back(base + static_cast<int>(i));
        seeded_.push_back(block.seeded[i]);
    }
    join_above(rect, block.top, base);
    join_left(rect, block.left, base);
    const auto global = [&](int n) { return n == kNone ? kNone : base + n; };
    std::ranges::transform(block.bottom, bottom_.begin() + (rect.x0 - kept_.rect().x0), global);
    right_.resize(block.right.size());
    std::ranges::transform(block.right, right_.begin(), global);
    right_x_ = rect.x1;
    kept_.add(block.kept);
    if (block.runs.empty()) return;
    undecided_base_.push_back(base);
    undecided_.push_back({{}, {}, std::move(block.first_run), std::move(block.runs), {}, {}, {}, {}});
}

void ComponentMerger::join_above(const Rect& block, const std::vector<int>& top, int base) {
    const int width = static_cast<int>(above_.size()), offset = block.x0 - kept_.rect().x0;
    for (int i = 0; i < static_cast<int>(top.size()); ++i) {
        if (top[index(i)] == kNone) continue;
        for (int x = std::max(0, offset + i - 1); x <= std::min(width - 1, offset + i + 1); ++x)
            if (const int label = above_[index(x)]; label != kNone) join(base + top[index(i)], label);
    }
}

void ComponentMerger::join_left(const Rect& block, const std::vector<int>& left, int base) {
    if (right_.empty() || right_x_ != block.x0) return;
    const int height = static_cast<int>(left.size());
    for (int i = 0; i < height; ++i) {
        if (left[index(i)] == kNone) continue;
        for (int y = std::max(0, i - 1); y <= std::min(height - 1, i + 1); ++y)
            if (const int label = right_[index(y)]; label != kNone) join(base + left[index(i)], label);
    }
}

BitRows ComponentMerger::finish() {
    for (std::size_t b = 0; b < undecided_.size(); ++b) {
        const BlockComponents& block = undecided_[b];
        for (std::size_t i = 0; i + 1 < block.first_run.size(); ++i) {
            if (block.first_run[i] == block.first_run[i + 1]) continue;
            if (!seeded_[index(find(undecided_base_[b] + static_cast<int>(i)))]) continue;
            for (std::size_t r = block.first_run[i]; r < block.first_run[i + 1]; ++r)
                kept_.set(block.runs[r].y, block.runs[r].x0, block.runs[r].x1);
        }
    }
    return std::move(kept_);
}

}  // namespace keyline

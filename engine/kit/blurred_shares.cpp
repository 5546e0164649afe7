// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/blurred_shares.h"

#include "engine/kit/sparse_row.h"
#include "engine/simd/elementary.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace keyline {

namespace {

// The product is exact, and so is the sum.
uint32_t in_parts(float coverage) {
    return coverage > 0 ? static_cast<uint32_t>(double{std::min(coverage, 1.0F)} * SharedPixels::kWhole + 0.5)
                        : 0;
}

// Whether all of n pixels are of one object each, their first.
bool are_whole(const float* id, const float* coverage, int n) {
    uint32_t other = 0;
    for (int i = 0; i < n; ++i)
        other |= static_cast<uint32_t>(!(coverage[i] >= 1)) | static_cast<uint32_t>(id[i] == 0);
    return other == 0;
}

bool are_empty(const float* coverage, int n) {
    uint32_t covered = 0;
    for (int i = 0; i < n; ++i) covered |= static_cast<uint32_t>(coverage[i] > 0);
    return covered == 0;
}

}  // namespace

ShareLists::Open::Place ShareLists::room(std::size_t taken) {
    constexpr std::size_t kMore = 16;
    if (shares_.size() < used_ + taken + kMore) shares_.resize(2 * (used_ + taken + kMore));
    Share* begin = &shares_[used_];
    return {begin, begin + taken, shares_.data() + shares_.size()};
}

uint32_t ShareLists::Open::close(std::size_t pixel) {
    const auto count = static_cast<std::size_t>(place_.end - place_.begin);
    lists_.lists_[pixel] = {lists_.used_, count};
    lists_.used_ += count;
    Share most;
    for (const Share* s = place_.begin; s != place_.end; ++s)
        if (s->sum > most.sum || (s->sum == most.sum && s->id > most.id)) most = *s;
    return most.id;
}

SharedPixels::SharedPixels(std::span<const View> views, bool integers, int reach, int sure, Scratch& scratch)
    : views_(views), integers_(integers), reach_(reach), sure_(sure), rect_(views[0].rect) {
    const auto area = static_cast<std::size_t>(rect_.area());
    sole_ = scratch.take<uint32_t>(area);
    mixed_ = scratch.take<uint8_t>(area);
    for (int y = rect_.y0; y < rect_.y1; ++y) find_soles(y);
    mark_near(scratch);
}

uint32_t SharedPixels::id_at(const View& view, int x, int y) const {
    const float id = *view.at(x, y);
    return id == 0 && !integers_ ? 0 : std::bit_cast<uint32_t>(id);  // −0 is nothing, but for integers
}

template <class Take>
void SharedPixels::each(int x, int y, const Take& take) const {
    if (views_.size() == 1) return take(id_at(views_[0], x, y), kWhole);
    uint32_t left = kWhole;
    for (std::size_t r = 0; r + 1 < views_.size() && left > 0; r += 2) {
        const uint32_t id = id_at(views_[r], x, y), parts = std::min(in_parts(*views_[r + 1].at(x, y)), left);
        if (parts == 0 || id == 0) continue;
        take(id, parts);
        left -= parts;
    }
    if (left > 0) take(0U, left);
}

// Most pixels are of their first object alone, or nobody's.
void SharedPixels::find_soles(int y) {
    if (views_.size() == 1) {
        for (int x = rect_.x0; x < rect_.x1; ++x) find_sole(x, y);
        return;
    }
    constexpr int kAtOnce = 16;
    for (int x = rect_.x0; x < rect_.x1; x += kAtOnce) {
        const int n = std::min(kAtOnce, rect_.x1 - x);
        const float *id = views_[0].at(x, y), *coverage = views_[1].at(x, y);
        const bool whole = are_whole(id, coverage, n);
        bool empty = !whole;
        for (std::size_t r = 1; empty && r < views_.size(); r += 2) empty = are_empty(views_[r].at(x, y), n);
        if (whole)
            std::memcpy(&sole_[place(x, y)], id, index(n) * sizeof(float));
        else if (empty)
            std::fill_n(&sole_[place(x, y)], n, 0U);
        if (whole || empty)
            std::fill_n(&mixed_[place(x, y)], n, uint8_t{0});
        else
            for (int i = 0; i < n; ++i) find_sole(x + i, y);
    }
}

void SharedPixels::find_sole(int x, int y) {
    uint8_t& mixed = mixed_[place(x, y)] = 1;
    each(x, y, [&](uint32_t id, uint32_t parts) {
        sole_[place(x, y)] = id;
        if (parts == kWhole) mixed = 0;
    });
}

// Where a pixel is mixed or differs from the next one, to the right or below; whether any does.
bool SharedPixels::mark_meetings(int y, std::span<uint8_t> meets) const {
    const uint32_t *here = soles(y), *below = y + 1 < rect_.y1 ? soles(y + 1) : here;
    const uint8_t* mixed = &mixed_[place(rect_.x0, y)];
    const std::size_t n = meets.size();
    uint8_t any = meets[n - 1] = mixed[n - 1] | static_cast<uint8_t>(here[n - 1] != below[n - 1]);
    for (std::size_t i = 0; i + 1 < n; ++i) {
        meets[i] = static_cast<uint8_t>(mixed[i] | (here[i] != here[i + 1]) | (here[i] != below[i]));
        any |= meets[i];
    }
    return any != 0;
}

void SharedPixels::mark_near(Scratch& scratch) {
    const int width = rect_.width();
    near_in_row_ = scratch.take<uint8_t>(sole_.size());
    near_ = scratch.take<uint8_t>(sole_.size());
    row_is_near_ = scratch.take<uint8_t>(index(rect_.height()));
    row_meets_ = scratch.take<uint8_t>(index(rect_.height()));
    const auto meets = scratch.take<uint8_t>(index(width)), near_here = scratch.take<uint8_t>(index(width));
    for (const auto& marks : {near_in_row_, near_, row_is_near_, row_meets_})
        std::ranges::fill(marks, uint8_t{0});
    const auto mark = [width](uint8_t* row, int i, int around) {
        std::fill(row + std::max(i - around, 0), row + std::min(i + around + 1, width), uint8_t{1});
    };
    for (int y = rect_.y0; y < rect_.y1; ++y) {
        if (!mark_meetings(y, meets)) continue;
        row_meets_[index(y - rect_.y0)] = 1;
        std::ranges::fill(near_here, uint8_t{0});
        each_where(
            meets.data(), width, [](uint8_t m) { return m != 0; },
            [&](int i) {
                mark(&near_in_row_[place(rect_.x0, y)], i, reach_);
                mark(near_here.data(), i, sure_);
            });
        for (int v = std::max(y - sure_, rect_.y0); v < std::min(y + sure_ + 1, rect_.y1); ++v) {
            row_is_near_[index(v - rect_.y0)] = 1;
            uint8_t* to = &near_[place(rect_.x0, v)];
            for (int i = 0; i < width; ++i) to[i] |= near_here[index(i)];
        }
    }
}

double BlurredRows::Row::share(std::size_t pixel, uint32_t id) const {
    if (blurred_[pixel] == 0) return labels_[pixel] == id ? 1 : 0;
    uint64_t of_it = 0, whole = 0;
    for (const Share& s : lists_[pixel]) {
        whole += s.sum;
        if (s.id == id) of_it = s.sum;
    }
    return static_cast<double>(of_it) / static_cast<double>(whole);
}

BlurredRows::BlurredRows(const SharedPixels& pixels, std::span<const uint32_t> weights)
    : pixels_(pixels),
      weights_(weights),
      whole_(index(pixels.rect().width())),
      along_(weights.size(), Along{INT_MIN, ShareLists(index(pixels.rect().width()))}),
      mixed_(index(pixels.rect().width())) {
    const int reach = pixels.reach(), width = pixels.rect().width();
    for (int i = 0; i < width; ++i)
        for (int d = std::max(-reach, -i); d <= std::min(reach, width - 1 - i); ++d)
            whole_[index(i)] += uint64_t{weights[index(d + reach)]} * SharedPixels::kWhole;
}

void BlurredRows::fill(int y, Row& row) {
    const std::size_t n = row.labels_.size();
    std::copy_n(pixels_.soles(y), n, row.labels_.begin());
    std::copy_n(pixels_.near(y), n, row.blurred_.begin());
    if (!pixels_.is_near_any(y)) return;
    row.lists_.clear();
    find_crossed(y);
    each_where(
        row.blurred_.data(), static_cast<int>(n), [](uint8_t blurred) { return blurred != 0; },
        [&](int i) { row.labels_[index(i)] = blur_across(index(i), row.lists_); });
}

void BlurredRows::find_crossed(int y) {
    const Rect& rect = pixels_.rect();
    const int reach = pixels_.reach();
    crossed_.clear();
    for (int v = std::max(y - reach, rect.y0); v < std::min(y + reach + 1, rect.y1); ++v)
        crossed_.push_back(
            {weights_[index(v - y + reach)], pixels_.soles(v), pixels_.near_in_row(v), &along(v)});
}

// Returns whose most of it is.
uint32_t BlurredRows::blur_across(std::size_t pixel, ShareLists& to) const {
    ShareLists::Open open(to);
    for (const Crossed& row : crossed_) {
        if (row.near_in_row[pixel] == 0)
            open.add(row.soles[pixel], row.weight * whole_[pixel]);
        else
            for (const Share& s : (*row.lists)[pixel]) open.add(s.id, row.weight * s.sum);
    }
    return open.close(pixel);
}

const ShareLists& BlurredRows::along(int y) {
    const Rect& rect = pixels_.rect();
    Along& out = along_[index(y - rect.y0) % along_.size()];
    if (out.y == y) return out.lists;
    out.y = y;
    out.lists.clear();
    if (!pixels_.meets_any(y)) return out.lists;
    const auto is_set = [](uint8_t mark) { return mark != 0; };
    mixed_.clear();
    each_where(pixels_.mixed(y), rect.width(), is_set, [&](int i) {
        ShareLists::Open open(mixed_);
        pixels_.each(rect.x0 + i, y, [&](uint32_t id, uint32_t parts) { open.add(id, parts); });
        open.close(index(i));
    });
    each_where(pixels_.near_in_row(y), rect.width(), is_set,
               [&](int i) { blur_along(index(i), y, out.lists); });
    return out.lists;
}

void BlurredRows::blur_along(std::size_t pixel, int y, ShareLists& to) const {
    const int reach = pixels_.reach(), i = static_cast<int>(pixel), width = pixels_.rect().width();
    const uint32_t* soles = pixels_.soles(y);
    const uint8_t* mixed = pixels_.mixed(y);
    ShareLists::Open open(to);
    for (int k = std::max(i - reach, 0); k < std::min(i + reach + 1, width); ++k) {
        const uint64_t weight = weights_[index(k - i + reach)];
        if (mixed[k] == 0)
            open.add(soles[k], weight * SharedPixels::kWhole);
        else
            for (const Share& s : mixed_[index(k)]) open.add(s.id, weight * s.sum);
    }
    open.close(pixel);
}

std::vector<uint32_t> blur_weights(double sigma, int reach) {
    const auto weight = [&](int x) { return elementary::exp(-(x * x) / (2 * sigma * sigma)); };
    double sum = 0;
    for (int x = -reach; x <= reach; ++x) sum += weight(x);
    std::vector<uint32_t> out;
    for (int x = -reach; x <= reach; ++x)
        out.push_back(static_cast<uint32_t>(std::lround(weight(x) / sum * (1 << 12))));
    return out;
}

int sure_within(std::span<const uint32_t> weights) {
    const auto reach = static_cast<int>(weights.size() / 2);
    const auto sum = [&](int from, int to) {
        uint64_t out = 0;
        for (int k = from; k <= to; ++k) out += weights[index(k + reach)];
        return out;
    };
    // The pixel beside it has them from one column before itself on, where the picture ends behind that.
    const uint64_t all = sum(-reach, reach);
    int sure = 1;
    while (sure < reach && 2 * sum(-1, sure - 1) * sum(-sure, sure) <= all * all) ++sure;
    return sure;
}

}  // namespace keyline

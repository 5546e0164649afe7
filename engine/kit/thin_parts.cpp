// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/thin_parts.h"

#include "engine/base/index.h"
#include "engine/kit/sparse_row.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <optional>

namespace keyline {

namespace {

constexpr int64_t kWhole = 1 << 16;  // of a pixel, in parts
constexpr int64_t kNothing = 256;    // parts that are noise, or the hem of a renderer's filter
constexpr int64_t kLeast = 1024;     // parts that the pixel with a middle has at least
constexpr int kSteps = 2;            // rows or columns on either side that the direction is told from
constexpr int kMargin = 2;           // pixels that a thin part may cover on each side beyond its width
constexpr double kSame = 0.01;       // of two depths that are one, as a share
constexpr double kNarrowest = 0.06;  // pixels: what is thinner is noise

// A run across a thin part, along a row or a column.
struct Run {
    int64_t sum = 0;          // of parts
    int64_t moment = 0;       // of parts, times twice the distance from where the run was looked for
    int first = 0, last = 0;  // its pixels, by distance from there
    int most = 0;             // the one that is covered most

    double width() const { return static_cast<double>(sum) / kWhole; }
    double middle() const { return static_cast<double>(moment) / (2 * static_cast<double>(sum)); }
};

// A pixel, and the way to the next one across: along its row or its column.
struct Across {
    int x = 0, y = 0, dx = 1, dy = 0;
    Across moved(int across, int along) const {
        return {x + across * dx + along * dy, y + across * dy + along * dx, dx, dy};
    }
};

class Parts {
public:
    Parts(std::span<const View> ids, std::span<const View> depth, const FindThinParts::Options& options,
          Scratch& scratch)
        : ids_(ids), depth_(depth.empty() ? nullptr : depth.data()), options_(options), rect_(ids[0].rect) {
        const auto mains = scratch.take<uint32_t>(static_cast<std::size_t>(rect_.area()));
        find_mains(mains);
        mains_ = mains;
    }

    // Whose middle the pixel holds, where there is one.
    std::optional<ThinPoint> at(int x, int y) const {
        std::optional<ThinPoint> best;
        const auto look_at = [&](uint32_t id) {
            const auto found = of(id, x, y);
            if (found &&
                (!best || std::pair(-found->at.strength, id) > std::pair(-best->at.strength, best->at.owner)))
                best = found;
        };
        int64_t left = kWhole;
        for (std::size_t r = 0; r < ids_.size() && left > kNothing; r += 2) {
            const int64_t has = covered(r, x, y);
            const uint32_t id = id_at(r, x, y);
            if (id != 0 && has > kLeast) look_at(id);
            if (id != 0) left -= has;
        }
        // Gaps through which one looks into nothing are known as such by the depth only.
        if (left > kLeast && depth_) look_at(0);
        return best;
    }

    // Whether the pixel may have one.  What is one object's, or nobody's, has none unless others have most of
    // something on both sides of it, not far away.  A row at once.
    void mark(int y, int x0, int x1, uint8_t* marks) const {
        const int far = reach(), nearer = std::max(far - 1, 1), n = x1 - x0;
        const auto row = [&](int v) { return main_at(x0, std::clamp(v, rect_.y0, rect_.y1 - 1)); };
        const uint32_t *here = row(y), *above = row(y - far), *over = row(y - nearer), *below = row(y + far),
                       *under = row(y + nearer);
        for (int i = 0; i < n; ++i) {
            const uint32_t id = here[i];
            marks[i] = static_cast<uint8_t>((differ(above[i], id) | differ(over[i], id)) &
                                            (differ(below[i], id) | differ(under[i], id)));
        }
        const auto mark_across = [&](int i, const auto& at) {
            const uint32_t id = here[i];
            const uint32_t left = differ(at(i - far), id) | differ(at(i - nearer), id),
                           right = differ(at(i + far), id) | differ(at(i + nearer), id);
            marks[i] |= static_cast<uint8_t>(left & right);
        };
        const int left = x0 - rect_.x0, right = rect_.x1 - x1;
        const int first = std::clamp(far - left, 0, n), last = std::clamp(n + right - far, first, n);
        const auto in_picture = [&](int i) { return here[std::clamp(i, -left, n - 1 + right)]; };
        for (int i = 0; i < first; ++i) mark_across(i, in_picture);
        for (int i = first; i < last; ++i) mark_across(i, [&](int k) { return here[k]; });
        for (int i = last; i < n; ++i) mark_across(i, in_picture);
        if (ids_.size() > 1) mark_mixed(ids_[1].at(x0, y), n, marks);
    }

private:
    static uint32_t differ(uint32_t a, uint32_t b) { return a != b ? 1 : 0; }

    static void mark_mixed(const float* coverage, int n, uint8_t* marks) {
        for (int i = 0; i < n; ++i) {
            const uint32_t some = coverage[i] > 0 ? 1 : 0, whole = coverage[i] >= 1 ? 1 : 0;
            marks[i] |= static_cast<uint8_t>(some & ~whole);
        }
    }

    // Who has half of each pixel, or nobody.
    void find_mains(std::span<uint32_t> mains) const {
        const int n = rect_.width();
        for (int y = rect_.y0; y < rect_.y1; ++y) {
            uint32_t* to = &mains[index(y - rect_.y0) * index(n)];
            std::memcpy(to, ids_[0].row(y), index(n) * sizeof(float));
            if (ids_.size() == 1) continue;
            const float* coverage = ids_[1].row(y);
            for (int i = 0; i < n; ++i) to[i] = coverage[i] >= 0.5F ? to[i] : 0;
        }
    }
    const uint32_t* main_at(int x, int y) const {
        return &mains_[index(y - rect_.y0) * index(rect_.width()) + index(x - rect_.x0)];
    }

    int reach() const { return static_cast<int>(std::ceil(options_.widest)); }

    uint32_t id_at(std::size_t r, int x, int y) const {
        const float id = *ids_[r].at(x, y);
        return id == 0 && !options_.integers ? 0 : std::bit_cast<uint32_t>(id);
    }
    int64_t covered(std::size_t r, int x, int y) const {
        if (ids_.size() == 1) return kWhole;
        const float c = *ids_[r + 1].at(x, y);
        // The product is exact, and so is the sum.
        return c > 0 ? static_cast<int64_t>(double{std::min(c, 1.0F)} * kWhole + 0.5) : 0;
    }

    // How much of a pixel an object has; beyond the picture its rim goes on.
    int64_t parts(uint32_t id, int x, int y) const {
        x = std::clamp(x, rect_.x0, rect_.x1 - 1);
        y = std::clamp(y, rect_.y0, rect_.y1 - 1);
        int64_t all = 0;
        for (std::size_t r = 0; r < ids_.size() && all < kWhole; r += 2) {
            const uint32_t here = id_at(r, x, y);
            const int64_t has = here != 0 || ids_.size() == 1 ? covered(r, x, y) : 0;
            if (here == id && has > 0 && id != 0) return std::min(has, kWhole);
            all += here == 0 ? 0 : has;
        }
        return id == 0 ? std::max<int64_t>(kWhole - all, 0) : 0;
    }
    int64_t parts(uint32_t id, const Across& at, int across) const {
        return parts(id, at.x + across * at.dx, at.y + across * at.dy);
    }

    // Whether an object has so many of the next pixels wholly that it can't be thin here.
    bool is_wide(uint32_t id, const Across& at, int step) const {
        if (ids_.size() == 1 || id == 0) return false;
        for (int i = 1; i <= wide_; ++i) {
            const int x = at.x + step * i * at.dx, y = at.y + step * i * at.dy;
            if (!rect_.contains(x, y) || !(*ids_[1].at(x, y) >= 1) || id_at(0, x, y) != id) return false;
        }
        return true;
    }

    // One side of a run: up to where there is nothing, or less than on either side.  `greatest` is what its
    // pixel `most` has.
    bool add_side(uint32_t id, const Across& at, int step, int64_t& greatest, Run& run) const {
        const auto limit = static_cast<int64_t>(most_ * kWhole);
        int64_t before = parts(id, at, 0), highest = before, next = parts(id, at, step);
        for (int i = step; std::abs(i) <= reach() + kMargin; i += step) {
            const int64_t here = next;
            if (here <= kNothing) return true;
            next = parts(id, at, i + step);
            const bool valley = here < before && here < next && 2 * here < highest;
            const int64_t has = valley ? here / 2 : here;
            run.sum += has;
            run.moment += has * 2 * i;
            (step < 0 ? run.first : run.last) = i;
            if (here > greatest) {
                greatest = here;
                run.most = i;
            }
            if (valley) return true;
            if (run.sum > limit) return false;
            highest = std::max(highest, here);
            before = here;
        }
        return false;
    }

    std::optional<Run> run_at(uint32_t id, const Across& at) const {
        if (is_wide(id, at, 1) || is_wide(id, at, -1)) return {};
        Run run;
        run.sum = parts(id, at, 0);
        int64_t greatest = run.sum;
        if (run.sum <= kNothing || !add_side(id, at, -1, greatest, run) ||
            !add_side(id, at, 1, greatest, run))
            return {};
        return run;
    }

    // The run in the next row or column that this one goes on in, from the pixel where its middle is.
    std::optional<double> middle_beside(uint32_t id, const Across& at, double middle, int along) const {
        const int start = static_cast<int>(std::lround(middle));
        const Across next = at.moved(start, along);
        if (!rect_.contains(next.x, next.y)) return {};
        std::array<int64_t, 3> has{};
        for (int i = -1; i <= 1; ++i) has[index(i + 1)] = parts(id, at.moved(start + i, along), 0);
        int best = 0;
        if (has[0] > has[1] && has[0] > has[2]) best = -1;
        if (has[2] > has[1] && has[2] > has[0]) best = 1;
        const auto run = run_at(id, at.moved(start + best, along));
        if (!run) return {};
        return run->middle() + start + best;
    }

    // How far the middle moves across from row to row; nothing where the part is but a dot.
    std::optional<double> slope_at(uint32_t id, const Across& at, double middle) const {
        double sum = 0, weights = 0;
        for (const int side : {-1, 1}) {
            double last = middle;
            for (int k = 1; k <= kSteps; ++k) {
                const auto next = middle_beside(id, at, last, side * k);
                if (!next || std::fabs(*next - last) > 2) break;
                sum += side * k * (*next - middle);
                weights += k * k;
                last = *next;
            }
        }
        return weights > 0 ? std::optional(sum / weights) : std::nullopt;
    }

    std::optional<ThinPoint> of(uint32_t id, int x, int y) const {
        const Across row{x, y, 1, 0}, column{x, y, 0, 1};
        const auto in_row = run_at(id, row), in_column = run_at(id, column);
        if (!in_row && !in_column) return {};
        const bool by_row = in_row && (!in_column || in_row->sum <= in_column->sum);
        return across(id, by_row ? row : column, by_row ? *in_row : *in_column);
    }

    std::optional<ThinPoint> across(uint32_t id, const Across& at, const Run& run) const {
        const double middle = run.middle();
        // A middle between two pixels is the first one's.
        if (!(middle > -0.5) || !(middle <= 0.5)) return {};
        const auto slope = slope_at(id, at, middle);
        if (!slope) return {};
        const double length = std::sqrt(1 + *slope * *slope), width = run.width() / length;
        if (width > options_.widest || width < kNarrowest) return {};
        ThinPoint out;
        const auto along = static_cast<float>(1 / length), aside = static_cast<float>(*slope / length);
        out.at = {at.x, at.y, 0, 0, 0, 0, static_cast<float>(width), id};
        (at.dx == 1 ? out.at.dx : out.at.dy) = static_cast<float>(middle);
        out.at.tx = at.dx == 1 ? aside : along;
        out.at.ty = at.dx == 1 ? along : aside;
        const Across before = at.moved(run.first - 1, 0), behind = at.moved(run.last + 1, 0),
                     most = at.moved(run.most, 0);
        out.beside = {main_but(id, before), main_but(id, behind)};
        out.near = near(most);
        out.place = place(double{out.near}, double{near(before)}, double{near(behind)});
        return out;
    }

    // Who else has most of a pixel.
    uint32_t main_but(uint32_t id, const Across& at) const {
        const int x = std::clamp(at.x, rect_.x0, rect_.x1 - 1), y = std::clamp(at.y, rect_.y0, rect_.y1 - 1);
        std::pair<int64_t, uint32_t> best{0, 0};
        int64_t left = kWhole;
        for (std::size_t r = 0; r < ids_.size(); r += 2) {
            const uint32_t here = id_at(r, x, y);
            if (here == 0) continue;
            const int64_t has = covered(r, x, y);
            left -= has;
            if (here != id) best = std::max(best, {has, here});
        }
        return id != 0 && left > best.first ? 0 : best.second;
    }

    float near(const Across& at) const {
        if (!depth_ || !depth_->rect.contains(at.x, at.y)) return 0;
        const float z = *depth_->at(at.x, at.y);
        return z > 0 && std::isfinite(z) ? 1 / z : 0;
    }

    ThinPoint::Place place(double here, double before, double behind) const {
        const auto is_nearer = [](double a, double b) { return a > (1 + kSame) * b; };
        if (!depth_) return ThinPoint::Place::kAmong;
        if (is_nearer(here, before) && is_nearer(here, behind)) return ThinPoint::Place::kBefore;
        if (is_nearer(before, here) && is_nearer(behind, here)) return ThinPoint::Place::kBehind;
        if ((is_nearer(here, before) && is_nearer(behind, here)) ||
            (is_nearer(before, here) && is_nearer(here, behind)))
            return ThinPoint::Place::kBetween;
        return ThinPoint::Place::kAmong;
    }

    std::span<const View> ids_;
    const View* depth_;
    const FindThinParts::Options& options_;
    Rect rect_;
    std::span<const uint32_t> mains_;
    const double most_ = options_.widest * 1.5 + 1;  // pixels in a run
    const int wide_ = std::min(static_cast<int>(std::ceil(most_)), reach() + kMargin);
};

void put(Outputs out, const ThinPoint& p) {
    const LinePoint& at = p.at;
    const std::array values{at.strength,
                            at.dx,
                            at.dy,
                            at.tx,
                            at.ty,
                            std::bit_cast<float>(at.owner),
                            std::bit_cast<float>(p.beside[0]),
                            std::bit_cast<float>(p.beside[1]),
                            p.near,
                            static_cast<float>(p.place)};
    static_assert(values.size() == FindThinParts::kOutputs);
    for (std::size_t i = 0; i < values.size(); ++i) *out[i].at(at.x, at.y) = values[i];
}

}  // namespace

Halo FindThinParts::halo() const {
    const int wide = static_cast<int>(std::ceil(options_.widest)) + kMargin + 1;
    const int reach = wide + 2 * kSteps + 2;  // as runs beside it may lie aside
    return {reach, reach};
}

// Where there is none, only the output that says so is written.
void FindThinParts::compute(const Inputs& in, Outputs out, Scratch& scratch) const {
    const Rect& rect = out[0].rect;
    if (options_.widest <= 0) {
        for (int y = rect.y0; y < rect.y1; ++y) std::fill_n(out[0].row(y), rect.width(), 0.0F);
        return;
    }
    const Parts parts(in.slot(0), in.slot(1), options_, scratch);
    const auto marks = scratch.take<uint8_t>(index(rect.width()));
    for (int y = rect.y0; y < rect.y1; ++y) {
        std::fill_n(out[0].row(y), rect.width(), 0.0F);
        parts.mark(y, rect.x0, rect.x1, marks.data());
        each_where(
            marks.data(), rect.width(), [](uint8_t m) { return m != 0; },
            [&](int i) {
                if (const auto found = parts.at(rect.x0 + i, y)) put(out, *found);
            });
    }
}

std::vector<ThinPoint> thin_points_in(std::span<const View> outputs, const Rect& block) {
    std::vector<ThinPoint> out;
    for (int y = block.y0; y < block.y1; ++y) {
        const auto add = [&](int i) {
            const int x = block.x0 + i;
            const auto value = [&](std::size_t k) { return *outputs[k].at(x, y); };
            const auto id = [&](std::size_t k) { return std::bit_cast<uint32_t>(value(k)); };
            out.push_back({{x, y, value(1), value(2), value(3), value(4), value(0), id(5)},
                           {id(6), id(7)},
                           value(8),
                           static_cast<ThinPoint::Place>(value(9))});
        };
        each_where(
            outputs[0].at(block.x0, y), block.width(), [](float width) { return width > 0; }, add);
    }
    return out;
}

}  // namespace keyline

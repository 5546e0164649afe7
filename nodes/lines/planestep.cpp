// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/node_adaptor.h"
#include "engine/simd/plane_step.h"

#include <algorithm>
#include <array>

namespace keyline {

namespace {

// 1 / depth is linear on every plane, however it lies.  So what a pixel's neighbours differ by beyond what
// the surfaces on either side go on with is a step from one to another: a floor that runs away has none, a
// crease neither, as there both sides say opposite things.
struct PlaneStep {
    static constexpr Info info{
        "planestep", "Steps in depth that no surface explains: where one part stands before another."};

    struct Params {
        Input in;

        static constexpr auto fields = declare(
            input(&Params::in, "in",
                  "The depth, one sample a pixel, not averaged; 0 and less is infinitely far.", matte("Z")));
    };
    // Slope of nearness, as a share of the nearer one: 0.01 is a centimetre at a metre, 1 nothing behind.
    static constexpr std::array outputs{"dx", "dy", "magnitude"};

    explicit PlaneStep(const Params& p) : in(p.in) {}

    static Halo halo() { return {kReach, kReach}; }

    // At the rim of the picture nobody knows both surfaces.
    void compute(const Inputs& inputs, Outputs out, Scratch& scratch) const {
        const View& depth = inputs[in][0];
        const Rect& rect = out[0].rect;
        Nearness nearness(depth, rect, scratch);
        const int inner_x0 = std::clamp(depth.rect.x0 + kReach, rect.x0, rect.x1),
                  inner_x1 = std::clamp(depth.rect.x1 - kReach, inner_x0, rect.x1);
        for (int y = rect.y0; y < rect.y1; ++y) {
            const bool known_y = y - kReach >= depth.rect.y0 && y + kReach < depth.rect.y1;
            const auto fill = [&](int x0, int x1, bool known_x) {
                simd::plane_step_row(nearness.around(x0, y), x1 - x0, known_x, known_y,
                                     {out[0].at(x0, y), out[1].at(x0, y), out[2].at(x0, y)});
            };
            fill(rect.x0, inner_x0, false);
            fill(inner_x0, inner_x1, true);
            fill(inner_x1, rect.x1, false);
        }
    }

    const Input in;

private:
    static constexpr int kReach = 2;

    // 1 / depth of the rows around one; they are asked for from top to bottom.
    class Nearness {
    public:
        Nearness(const View& depth, const Rect& rect, Scratch& scratch)
            : depth_(depth),
              x0_(rect.x0 - kReach),
              width_(index(rect.width() + 2 * kReach)),
              next_(std::max(rect.y0 - kReach, depth.rect.y0)),
              values_(scratch.take<double>(kRows * width_)) {
            std::ranges::fill(values_, 0.0);
        }

        // From x on; rows that are not there are others.
        std::array<const double*, 5> around(int x, int y) {
            for (; next_ < std::min(y + kReach + 1, depth_.rect.y1); ++next_) fill();
            std::array<const double*, 5> out;
            for (int i = 0; i < kRows; ++i) out[index(i)] = row(y - kReach + i) + (x - x0_);
            return out;
        }

    private:
        static constexpr int kRows = 2 * kReach + 1;

        double* row(int y) const { return &values_[index((y % kRows + kRows) % kRows) * width_]; }
        void fill() {
            const int from = std::max(x0_, depth_.rect.x0),
                      to = std::min(x0_ + static_cast<int>(width_), depth_.rect.x1);
            simd::nearness_row(depth_.at(from, next_), to - from, row(next_) + (from - x0_));
        }

        const View& depth_;
        int x0_;
        std::size_t width_;
        int next_;  // row to fill
        std::span<double> values_;
    };
};

}  // namespace

KEYLINE_NODE(planestep, PlaneStep)

}  // namespace keyline

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/spline.h"
#include "engine/kit/strokes.h"
#include "engine/node/node_adaptor.h"

#include <algorithm>

namespace keyline {

namespace {

enum class Auto { kAuto };

constexpr auto words(Auto) {
    return std::array{Word<Auto>{"auto", Auto::kAuto, "as far as the strokes say that they may be off"}};
}

struct Smooth {
    static constexpr Info info{
        "smooth", "Strokes without the tremor of the pixels that they were found in; corners stay."};

    struct Params {
        Input in;
        std::variant<Auto, double> tolerance;
        double abstract = 0;

        static constexpr auto fields = declare(
            input(&Params::in, "in", "The strokes.", data<Strokes>()),
            field(&Params::tolerance, "tolerance",
                  "What is tremor: deviations of so many pixels, and not of more, which are shape.",
                  between(0, 20)),
            field(&Params::abstract, "abstract",
                  "How much a hand may simplify beyond that, in pixels of a display window 1080 high.",
                  between(0, 8)));
    };

    explicit Smooth(const Params& p) : params(p) {}

    Strokes derive(const Inputs& in) const {
        Strokes out = in.datum<Strokes>(params.in);
        const double abstract = params.abstract * display_unit(out);
        for (Stroke& s : out.strokes) {
            const double* given = std::get_if<double>(&params.tolerance);
            const double noise = (given ? *given : typical_epsilon(s)) + abstract;
            if (noise > 0) smooth(s, noise, 1 + abstract);
        }
        arrange(out);
        return out;
    }
    static std::size_t datum_bytes() { return kUsualStrokes; }

    const Params params;

private:
    static double typical_epsilon(const Stroke& s) {
        std::vector<double> all;
        for (const StrokeVertex& v : s.vertices) all.push_back(v.epsilon);
        const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
        std::ranges::nth_element(all, middle);
        return *middle;
    }
};

}  // namespace

KEYLINE_NODE(smooth, Smooth)

}  // namespace keyline

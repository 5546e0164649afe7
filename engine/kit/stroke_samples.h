// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/kit/strokes.h"
#include "engine/node/node_adaptor.h"

#include <compare>
#include <cstdint>
#include <optional>
#include <vector>

// What an image is beside strokes, most often on the side of what they belong to: on the line itself samples
// are mixed of both sides.

namespace KEYLINE_API keyline {

struct StrokeSample {
    uint32_t stroke = 0, vertex = 0;
    float value = 0;
    friend bool operator==(const StrokeSample&, const StrokeSample&) = default;
};

// In the order of strokes and vertices; where the image has ended it is 0, and there is no sample.
struct StrokeSamples {
    static constexpr const char* kind = "samples beside strokes";

    std::vector<StrokeSample> samples;
    std::size_t bytes() const { return samples.size() * sizeof(StrokeSample); }
    friend bool operator==(const StrokeSamples&, const StrokeSamples&) = default;
};

// The pixels beside strokes, from top to bottom and from left to right, so that each tile of an image finds
// its own.
struct PlacesBeside {
    static constexpr const char* kind = "places beside strokes";

    struct Place {
        int y = 0, x = 0;
        uint32_t stroke = 0, vertex = 0;
        friend auto operator<=>(const Place&, const Place&) = default;
    };
    std::vector<Place> places;
    std::size_t bytes() const { return places.size() * sizeof(Place); }
    friend bool operator==(const PlacesBeside&, const PlacesBeside&) = default;
};

struct FindPlacesBeside {
    struct Params {
        Input strokes;
        static constexpr auto fields = declare(input(&Params::strokes, "strokes", "", data<Strokes>()));
    };
    enum Side { kNear, kFar };

    PlacesBeside derive(const Inputs& in) const;
    static std::size_t datum_bytes() {
        return kUsualStrokes / sizeof(StrokeVertex) * sizeof(PlacesBeside::Place);
    }

    Side side = kNear;
};

// The operation that makes samples of an image.
struct SampleBeside {
    struct Params {
        Input image, places;
        static constexpr auto fields = declare(input(&Params::image, "image", "", matte()),
                                               input(&Params::places, "places", "", data<PlacesBeside>()));
    };
    using State = std::vector<StrokeSample>;
    using Partial = std::vector<StrokeSample>;

    static State start(const Rect&) { return {}; }
    static Partial map(const State&, const Inputs& in, const Rect& block, Scratch&);
    static void fold(State& state, Partial&& found) { state.insert(state.end(), found.begin(), found.end()); }
    static StrokeSamples finish(State state);

    static constexpr std::size_t kUsual = kUsualStrokes / sizeof(StrokeVertex) * sizeof(StrokeSample);
    static std::size_t state_bytes(const Rect&) { return kUsual; }
    static std::size_t partial_bytes(const Rect&) { return kUsual; }
    static std::size_t datum_bytes(const Rect&) { return kUsual; }
};

// Gives samples back to those who go through all strokes and their vertices in order.
class SampleReader {
public:
    explicit SampleReader(const StrokeSamples& samples)
        : next_(samples.samples.begin()), end_(samples.samples.end()) {}

    // Nothing outside the image.
    std::optional<float> at(uint32_t stroke, uint32_t vertex) {
        if (next_ == end_ || next_->stroke != stroke || next_->vertex != vertex) return {};
        return (next_++)->value;
    }

private:
    std::vector<StrokeSample>::const_iterator next_, end_;
};

// Where there is no image: none of its samples.
struct NoSamples {
    struct Params {
        static constexpr auto fields = declare();
    };
    static StrokeSamples derive(const Inputs&) { return {}; }
    static std::size_t datum_bytes() { return 0; }
};

}  // namespace keyline

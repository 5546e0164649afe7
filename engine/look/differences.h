// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/geometry.h"
#include "engine/io/image_source.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace KEYLINE_API keyline {

// How far two samples may be apart and still count as the same: as a number, or as a share of the larger one.
// Ids are the same or they are not.
struct Tolerance {
    double absolute = 0, relative = 0;
};

// How often errors come, by their size; each is known to 1 %.
class ErrorCounts {
public:
    void add(double error);
    // The error that a share of all samples does not exceed, from 0 to 1.
    double percentile(double share) const;

private:
    static constexpr std::size_t kBins = 32768;  // the upper half of a positive float's bits
    std::vector<int64_t> bins_ = std::vector<int64_t>(kBins);
    int64_t all_ = 0;
};

// One channel of two pictures.  An error is the distance of two samples; two NaN have none, and one that is
// not finite on one side only is infinite.
struct ChannelDifference {
    std::string channel;
    bool is_id = false;           // then errors are no measure, and only `different` counts
    int64_t samples = 0;          // of both data windows together
    int64_t different = 0;        // beyond the tolerance
    int64_t infinite = 0;         // errors
    double largest = 0, sum = 0;  // of the finite ones
    int x = 0, y = 0;             // where the largest is, or the first that is infinite
    ErrorCounts counts;

    double mean() const { return samples > infinite ? sum / static_cast<double>(samples - infinite) : 0; }
};

struct TypeDifference {
    std::string channel;
    SampleType a, b;
};

struct AttributeDifference {
    std::string name;
    const Attribute *a = nullptr, *b = nullptr;  // null: not there
};

struct PictureDifferences {
    bool display = false, data = false;  // windows that differ
    std::vector<std::string> only_in_a, only_in_b;
    std::vector<TypeDifference> types;
    std::vector<AttributeDifference> attributes;  // of the sources' headers
    std::vector<ChannelDifference> channels;      // that both have
};

// The largest finite error of a pixel's channels that are no ids, over both data windows.
struct ErrorMap {
    Rect window;
    std::vector<float> errors;
};

// Of all channels, or of those that a selection names as `id:SELECTION` does in a graph.  Samples are 0
// outside of data windows.  The map is filled where it is not null.  Throws Failure (kGraph) where nothing is
// called so.
PictureDifferences differences_of(const ImageSource& a, const ImageSource& b, const std::string& selection,
                                  const Tolerance& tolerance, ErrorMap* map);

}  // namespace keyline

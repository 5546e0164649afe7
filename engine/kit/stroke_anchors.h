// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/kit/stroke_samples.h"
#include "engine/kit/strokes.h"
#include "engine/node/node_adaptor.h"

// Where on a surface strokes lie, from the pass that tells it beside them.

namespace KEYLINE_API keyline {

// Of strokes and of what the coordinates are beside them, on the side of what they belong to; the third may
// be NoSamples.  A vertex without a finite place takes that of the last that has one, or the first; a stroke
// without any keeps the anchors that it has.
struct TakeAnchors {
    struct Params {
        Input strokes, first, second, third;
        static constexpr auto fields = declare(input(&Params::strokes, "strokes", "", data<Strokes>()),
                                               input(&Params::first, "first", "", data<StrokeSamples>()),
                                               input(&Params::second, "second", "", data<StrokeSamples>()),
                                               input(&Params::third, "third", "", data<StrokeSamples>()));
    };
    Strokes derive(const Inputs& in) const;
    static std::size_t datum_bytes() { return kUsualStrokes; }

    StrokeAnchor kind = StrokeAnchor::kPosition;
};

// The strokes anchored on what surface_places() gives.
Stream with_anchors(Builder& builder, const Stream& strokes, const Stream& places);

}  // namespace keyline

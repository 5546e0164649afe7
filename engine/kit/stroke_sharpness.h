// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/kit/stroke_samples.h"
#include "engine/kit/strokes.h"
#include "engine/node/node_adaptor.h"

// The angle in which surfaces meet along strokes, from normals beside them.

namespace KEYLINE_API keyline {

// Of strokes and of what X, Y and Z of normals are beside them: first on the near sides, then on the far.
// Where only the near side has a normal, there is nothing behind: the surfaces are back to back, 180 degrees.
// Where none is known the angle stays as it was.
struct TakeSharpness {
    struct Params {
        Input strokes, near_x, near_y, near_z, far_x, far_y, far_z;
        static constexpr auto fields = declare(input(&Params::strokes, "strokes", "", data<Strokes>()),
                                               input(&Params::near_x, "near_x", "", data<StrokeSamples>()),
                                               input(&Params::near_y, "near_y", "", data<StrokeSamples>()),
                                               input(&Params::near_z, "near_z", "", data<StrokeSamples>()),
                                               input(&Params::far_x, "far_x", "", data<StrokeSamples>()),
                                               input(&Params::far_y, "far_y", "", data<StrokeSamples>()),
                                               input(&Params::far_z, "far_z", "", data<StrokeSamples>()));
    };
    static Strokes derive(const Inputs& in);
    static std::size_t datum_bytes() { return kUsualStrokes; }
};

// The strokes with the sharpness that an image of normals, X Y Z, tells.
Stream with_sharpness(Builder& builder, const Stream& strokes, const Stream& normals);

}  // namespace keyline

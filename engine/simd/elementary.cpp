// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/elementary.h"

#include "engine/simd/elementary-inl.h"

namespace keyline::elementary {

namespace {

namespace body = simd::HWY_NAMESPACE;
namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::CappedTag<double, 1> kOne;

}  // namespace

double exp(double x) { return hn::GetLane(body::exp(kOne, hn::Set(kOne, x))); }

double log(double x) { return hn::GetLane(body::log(kOne, hn::Set(kOne, x))); }

double pow(double x, double y) {
    if (y == 0 || x == 1) return 1;
    return exp(y * log(x));
}

}  // namespace keyline::elementary

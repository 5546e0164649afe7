// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/numbers.h"

namespace keyline {

float Largest::map(float, const Inputs& in, const Rect& block, Scratch&) {
    const View& view = in.slot(0)[0];
    float most = -std::numeric_limits<float>::infinity();
    for (int y = block.y0; y < block.y1; ++y)
        for (int i = 0; i < block.width(); ++i) most = view.row(y)[i] > most ? view.row(y)[i] : most;
    return most;
}

Numbers Percentiles::finish(RankSearch search) {
    search.finish_round();
    Numbers out;
    for (std::size_t i = 0; i < 2; ++i)
        out.values.push_back(search.value(i).value_or(std::numeric_limits<float>::quiet_NaN()));
    return out;
}

}  // namespace keyline

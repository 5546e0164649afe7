// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/kit/strokes.h"

namespace KEYLINE_API keyline {

// Where two strokes run so close that there would be less than `apart` pixels between their inks, the later
// in the list grows thin, down to nothing where it would run inside the other; of a stroke that comes back to
// itself, the later part does.
void give_way(Strokes& strokes, double apart);

}  // namespace keyline

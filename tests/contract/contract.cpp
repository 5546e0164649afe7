// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/contract/contract.h"

namespace keyline::testing {

std::span<const Promise> promises() {
    static constexpr Promise all[] = {
        {"Declaration", check_declaration, false},
        {"RoundTrip", check_round_trip, false},
        {"Digest", check_digest, false},
        {"Refusals", check_refusals, false},
        {"Schedules", check_schedules, true},
        {"SpecialValues", check_special_values, true},
        {"Windows", check_windows, true},
        {"Identity", check_identity, true},
        {"Extent", check_extent, true},
        {"Halo", check_halo, true},
        {"Outputs", check_outputs, true},
        {"Ends", check_ends, true},
    };
    return all;
}

}  // namespace keyline::testing

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/node/node_type.h"

#include <span>
#include <string>
#include <vector>

// What every node promises, whatever it computes.  Run it on a node of your own with
//
//     registry().add(make_node_type<Mine>());
//     for (const Promise& promise : promises())
//         EXPECT_THAT(promise.check(*registry().find("mine")), IsEmpty()) << promise.name;
//
// Parameters and images are drawn from what the node declares, always the same ones.  A range may be narrowed
// for that with tested_to() where its upper end would take too long.

namespace keyline::testing {

// What is wrong, in words; empty where the promise is kept.
using Complaints = std::vector<std::string>;

struct Promise {
    const char* name;  // in CamelCase, as test names go
    Complaints (*check)(const NodeType& type);
    bool computes;  // for nodes without files only: those are what the test does not know
};
std::span<const Promise> promises();

// contract_declaration.cpp

// The node, its fields and their words are described, and every default is a value that the field takes.
Complaints check_declaration(const NodeType& type);
// Parameters written as JSON and read again are the same parameters.
Complaints check_round_trip(const NodeType& type);
// Equal parameters have one digest, different ones have two.
Complaints check_digest(const NodeType& type);
// An unknown key, a value of the wrong kind or out of range, and a missing one are refused, with the place.
Complaints check_refusals(const NodeType& type);

// contract_pixels.cpp

// The same bytes for every tile size and number of threads as without any tiles.
Complaints check_schedules(const NodeType& type);
// The same where samples are NaN, infinite, -0, denormal or huge.
Complaints check_special_values(const NodeType& type);
// The same where windows are empty, one pixel, one row, one column, or far off the origin.
Complaints check_windows(const NodeType& type);
// What says that it changes nothing, changes nothing.
Complaints check_identity(const NodeType& type);

// contract_extent.cpp

// Outside its data window a picture is 0, and that is all: the same picture with its whole data window and
// with one cut to what is not 0 gives the same over the display window.
Complaints check_extent(const NodeType& type);

// contract_ends.cpp

// With each parameter at either end of its range, a picture of a few pixels is refused, becomes large (which
// is told by its size), or is computed in seconds, by the planner's estimate and in truth.
Complaints check_ends(const NodeType& type);

// contract_halo.cpp

// A region is computed from the pixels that the operation demands for it and from no others, nothing is
// written beside it, and it is the same as that part of the whole.
Complaints check_halo(const NodeType& type);
// Each output of an operation is the same whether the others are read or not.
Complaints check_outputs(const NodeType& type);

}  // namespace keyline::testing

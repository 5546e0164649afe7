// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/registry.h"
#include "tests/contract/contract.h"
#include "tests/support/draw.h"

#include <gmock/gmock.h>

// Every node that there is, by every promise.

namespace keyline::testing {
namespace {

struct Case {
    const NodeType* type;
    const Promise* promise;
    friend void PrintTo(const Case& c, std::ostream* out) { *out << c.type->name << ' ' << c.promise->name; }
};

std::vector<Case> cases() {
    std::vector<Case> out;
    for (const auto& [name, type] : registry().types())
        for (const Promise& promise : promises())
            if (!promise.computes || !has_files(type)) out.push_back({&type, &promise});
    return out;
}

class EveryNode : public ::testing::TestWithParam<Case> {};

TEST_P(EveryNode, KeepsItsPromise) {
    EXPECT_THAT(GetParam().promise->check(*GetParam().type), ::testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Contract, EveryNode, ::testing::ValuesIn(cases()),
                         [](const auto& test) { return test.param.type->name + test.param.promise->name; });

}  // namespace
}  // namespace keyline::testing

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/error.h"

#include <gtest/gtest.h>
#include <tuple>

namespace keyline {
namespace {

TEST(Error, TellsPlaceNodeWhatAndHint) {
    const Error e{ErrorKind::kGraph,
                  {"g.json", 3, 7},
                  "node 'a' (gaussian)",
                  "unknown key 'sgma'",
                  "did you mean 'sigma'?"};
    EXPECT_EQ(e.text(), "g.json:3:7: error: node 'a' (gaussian): unknown key 'sgma'; did you mean 'sigma'?");
}

TEST(Error, LeavesOutWhatIsEmpty) {
    EXPECT_EQ((Error{ErrorKind::kInput, {}, {}, "no such file", {}}.text()), "error: no such file");
    EXPECT_EQ((Error{ErrorKind::kGraph, {"--set a.b=1", 0, 0}, {}, "bad", {}}.text()),
              "--set a.b=1: error: bad");
}

TEST(Error, InternalOnesSaySo) {
    EXPECT_EQ((Error{ErrorKind::kInternal, {}, "node 'a'", "wrong", {}}.text()),
              "error: internal: node 'a': wrong");
}

TEST(InQuotes, CutsAtSixtyCharactersNotBytes) {
    EXPECT_EQ(in_quotes(std::string(60, 'x')), "'" + std::string(60, 'x') + "'");
    EXPECT_EQ(in_quotes(std::string(61, 'x')), "'" + std::string(60, 'x') + "…'");
    std::string umlauts;
    for (int i = 0; i < 60; ++i) umlauts += "ü";
    EXPECT_EQ(in_quotes(umlauts), "'" + umlauts + "'");
}

TEST(InQuotes, EscapesControlCharacters) { EXPECT_EQ(in_quotes("a\nb\x1b[0m"), "'a\\nb\\x1b[0m'"); }

TEST(DidYouMean, FindsTheNearestAndOnlyNearOnes) {
    EXPECT_EQ(did_you_mean("sgma", {"in", "sigma"}), "did you mean 'sigma'?");
    EXPECT_EQ(did_you_mean("radius", {"in", "sigma"}), "");
    EXPECT_EQ(did_you_mean("a", {"b"}), "");
}

TEST(DidYouMean, NeighboursSwappedAreOneSlip) {
    // With two words at hand, the swap decides.
    EXPECT_EQ(did_you_mean("sgima", {"sigma", "sgimnb"}), "did you mean 'sigma'?");
    EXPECT_EQ(did_you_mean("ab", {"ba"}), "did you mean 'ba'?");
}

TEST(Warning, NeverHoldsTheWordOfErrors) {
    const Error w{ErrorKind::kFailed, {"g.json", 1, 2}, {}, "error: Error: ERROR: in 'error:.exr'", {}};
    EXPECT_EQ(w.warning_text(), "g.json:1:2: warning: error : Error : ERROR : in 'error :.exr'");
}

TEST(Diagnostics, SortsByPlaceAndKeepsTheOrderWithin) {
    Diagnostics d;
    for (const auto& [line, column, what] :
         {std::tuple(3, 1, "e"), {2, 9, "c"}, {2, 9, "d"}, {0, 0, "b"}, {2, 1, "x"}})
        d.error({ErrorKind::kGraph, {"file", line, column}, {}, what, {}});
    d.error({ErrorKind::kGraph, {}, {}, "a", {}});
    d.sort_by_place();
    std::string order;
    for (const Error& e : d.errors()) order += e.what;
    EXPECT_EQ(order, "abxcde");
}

TEST(Listed, ReadsAsASentence) {
    EXPECT_EQ(listed({"a"}), "'a'");
    EXPECT_EQ(listed({"a", "b", "c"}), "'a', 'b' and 'c'");
}

}  // namespace
}  // namespace keyline

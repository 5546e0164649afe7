// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/params/validate.h"

#include "engine/json/json_reader.h"

#include <gmock/gmock.h>

namespace keyline {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// A declaration that no struct has, as a group's or a plugin's would be.
const std::vector<FieldInfo>& declared() {
    static const std::vector<FieldInfo> fields{
        {"in", "", TypeInfo::input({}, false), {}, true},
        {"count", "", TypeInfo::integer({1, 4}), {}, true},
        {"shape", "", TypeInfo::one_of({{"disk", ""}, {"square", ""}}), {}},
        {"file", "", TypeInfo::file(), {}},
        {"tint", "", TypeInfo::color({0, 1}), {}},
        {"box", "", TypeInfo::numbers(2, TypeInfo::integer({})), {}},
        {"stops", "", TypeInfo::list(TypeInfo::tuple({TypeInfo::number({0, 1}), TypeInfo::string()})), {}},
        {"lights",
         "",
         TypeInfo::list(TypeInfo::object({{"power", "", TypeInfo::number({0, 9}), {}, true}})),
         {}},
        {"names", "", TypeInfo::map(TypeInfo::number({0, 1})), {}},
    };
    return fields;
}

std::vector<std::string> faults(const std::string& json) {
    Diagnostics diagnostics;
    ParamReader reader(diagnostics, "node", {});
    validate(declared(), parse_json(json, "g.json"), reader);
    std::vector<std::string> out;
    for (const Error& e : diagnostics.errors()) {
        out.push_back(std::to_string(e.place.column) + " " + e.what);
        if (!e.hint.empty()) out.back() += "; " + e.hint;
    }
    EXPECT_EQ(reader.failed(), !out.empty());
    return out;
}

// With the two that must be there.
std::vector<std::string> faults_of(const std::string& member) {
    return faults(R"({"in": "a", "count": 1, )" + member + "}");
}

TEST(Validate, PassesWhatIsDeclared) {
    EXPECT_THAT(faults(R"({"in": "a:R", "count": 4, "shape": "disk", "file": "a.####.exr", "tint": "#102030",
        "box": [1, -2], "stops": [[0, "x"], [1, "y"]], "lights": [{"power": 1}], "names": {"any": 0.5}})"),
                IsEmpty());
}

TEST(Validate, TellsAllFaultsOfAnObject) {
    EXPECT_THAT(faults(R"({"cuont": 2, "shape": "disc"})"),
                ElementsAre("1 input 'in' is missing", "1 parameter 'count' is missing",
                            "23 'shape' is \"disc\"; it must be one of 'disk' and 'square'; did you mean "
                            "'disk'?",
                            "2 unknown key 'cuont'; did you mean 'count'?"));
}

TEST(Validate, TellsKindsAndRanges) {
    EXPECT_THAT(faults(R"({"in": 1, "count": 5})"), ElementsAre("8 'in' is 1, a number; it must be an input",
                                                                "20 'count' is 5; it must be from 1 to 4"));
    EXPECT_THAT(faults(R"({"in": "a:", "count": 1.5})"),
                ElementsAre("8 'in' is \"a:\"; it must be \"NODE\" or \"NODE:LAYER\"",
                            "23 'count' is 1.5, a number; it must be a whole number"));
    EXPECT_THAT(faults(R"({"in": "a", "count": null})"),
                ElementsAre("22 'count' is null; it must be a whole number"));
}

TEST(Validate, TellsWhatIsInside) {
    EXPECT_THAT(faults_of(R"("box": [1, 0.5])"),
                ElementsAre("36 'box' is 0.5, a number; it must be a whole number"));
    EXPECT_THAT(faults_of(R"("box": [1])"),
                ElementsAre("32 'box' is [1], an array; it must be a list of 2 numbers"));
    EXPECT_THAT(faults_of(R"("tint": "#12")"),
                ElementsAre("33 'tint' is \"#12\", a string; it must be a colour, [r, g, b] or \"#rrggbb\""));
    EXPECT_THAT(faults_of(R"("stops": [[2, "x"]])"), ElementsAre("36 'stops' is 2; it must be from 0 to 1"));
    EXPECT_THAT(
        faults_of(R"("lights": [{"powre": 1}])"),
        ElementsAre("36 parameter 'power' is missing", "37 unknown key 'powre'; did you mean 'power'?"));
    EXPECT_THAT(faults_of(R"("names": {"mine": 7})"), ElementsAre("43 'mine' is 7; it must be from 0 to 1"));
}

}  // namespace
}  // namespace keyline

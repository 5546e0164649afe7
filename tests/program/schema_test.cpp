// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <gmock/gmock.h>

namespace keyline::test {

namespace {

using testing::HasSubstr;

class SchemaCommand : public ProgramTest {};

TEST_F(SchemaCommand, InstallsWhatItPrints) {
    const Outcome printed = keyline({"schema"});
    const Outcome installed = keyline({"schema", "--install", "editor/schemas"});
    EXPECT_EQ(installed.status, 0) << installed.err;
    EXPECT_THAT(installed.out, HasSubstr("editor/schemas/keyline.schema.json: name it in \"$schema\""));
    EXPECT_EQ(read(folder() / "editor/schemas/keyline.schema.json"), printed.out);
}

TEST_F(SchemaCommand, TellsAFolderThatCannotBeMade) {
    write("a", "a file");
    const Outcome run = keyline({"schema", "--install", "a/b"});
    EXPECT_EQ(run.status, 4);
    EXPECT_THAT(run.err, HasSubstr("a/b/keyline.schema.json"));
}

}  // namespace

}  // namespace keyline::test

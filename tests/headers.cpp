// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0

// The source of a target that is there for its precompiled headers (CMakeLists.txt), which all test programs
// use.

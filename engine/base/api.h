// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// Programs and nodes of others are written against the public headers.  A header is public by opening its
// namespace with KEYLINE_API: the library then shows its symbols, and the header is installed.  All others
// are hidden and stay at home, so that they may change.
#define KEYLINE_API [[gnu::visibility("default")]]

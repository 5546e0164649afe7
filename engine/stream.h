// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/geometry.h"
#include "engine/metadata.h"

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace keyline {

// One channel computed by one operation of a frame: what links, streams and the plan refer to.
struct ValueRef {
    int op = -1;
    int output = 0;
    friend auto operator<=>(const ValueRef&, const ValueRef&) = default;  // NOLINT(modernize-use-nullptr)
};

struct StreamChannel {
    std::string name;
    ValueRef value;
};

// What flows along a link: named channels under one data window.  A channel that a node passes on untouched
// still refers to the operation that made it; nothing is copied.
struct Stream {
    Rect display, window;
    std::vector<StreamChannel> channels;
    std::shared_ptr<const Metadata> metadata = std::make_shared<Metadata>();
    std::filesystem::path file;  // that the metadata came from, for names in it that are relative to it

    std::vector<std::string> names() const;
    const StreamChannel* find(std::string_view name) const;

    // Replaces the channel of that name, or adds it at the end.
    void set(const std::string& name, ValueRef value);
};

}  // namespace keyline

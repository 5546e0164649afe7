// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/geometry.h"
#include "engine/base/image.h"
#include "engine/base/metadata.h"
#include "engine/base/print.h"

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace KEYLINE_API keyline {

// One channel or datum made by one operation of a frame: what links, streams and the plan refer to.
struct ValueRef {
    int op = -1;
    int output = 0;
    friend auto operator<=>(const ValueRef&, const ValueRef&) = default;  // NOLINT(modernize-use-nullptr)
};

std::string to_string(const ValueRef& value);  // "7.0": output 0 of operation 7

// What the samples of a channel are, whatever it is called.
enum class Holds : uint8_t {
    kColour,  // what is seen: colour, and mattes and lines
    kData,    // what is measured: depth, normals, positions, an id's coverage
    kId,      // which object it is: compared, and never computed with
};

// What is known of how the samples of a channel came to be.  No pixel depends on it: it is there so that
// mistakes can be told.  Of what no node says anything, nothing is known, and nothing is told.
struct Nature {
    // What colour is meant for: the light of a scene, or a display, which must not be given it twice.
    enum class For : uint8_t { kUnknown, kScene, kDisplay };
    For colour_for = For::kUnknown;
    bool divided = false;  // by A: not premultiplied any more
    bool slope = false;    // how steep the picture is, in lines as wide as their blur

    friend bool operator==(const Nature&, const Nature&) = default;
};

// What a file says of the channels of one Cryptomatte, rather than of the picture: it goes where they go.
struct CryptomatteInfo {
    std::string name;    // as the attributes have it: "CryptoObject"
    std::string layers;  // as the file's layers have it, without the level: "View.CryptoObject"
    std::string prefix;  // of the attributes: "cryptomatte/1234567/"; empty where there are none
    std::vector<Attribute> attributes;  // named by what follows the prefix
    std::filesystem::path file;         // that they stand in: a manifest is named relative to it
    int levels = 0;
};

struct StreamChannel {
    std::string name;
    ValueRef value;
    Holds holds = Holds::kColour;
    bool integer = false;  // the bits of an unsigned integer stand in each sample, instead of a float
    std::shared_ptr<const CryptomatteInfo> cryptomatte = {};  // that it is a channel of; null: of none
    int place = 0;  // in the Cryptomatte: 4 × level, and 0 to 3 for r g b a
    Nature nature = {};

    // Whether its samples stand for themselves only: no node may make others of them, no file round them.
    bool exact() const { return holds == Holds::kId || cryptomatte != nullptr; }
};

// What flows along a link: named channels under one data window, or one datum.  A channel that a node passes
// on untouched still refers to the operation that made it; nothing is copied.
struct Stream {
    Rect display, window;
    std::vector<StreamChannel> channels;
    std::string data;  // the datum's kind; "": pixels
    ValueRef datum;
    std::shared_ptr<const Metadata> metadata = std::make_shared<Metadata>();  // of the picture
    std::filesystem::path file;                                               // that it was read from

    bool is_data() const { return !data.empty(); }
    // Where the picture ends: the smallest rectangle around both windows.  Inside it and outside the data
    // window the picture is 0, and nodes see that.
    Rect extent() const { return unite(window, display); }

    std::vector<std::string> names() const;
    const StreamChannel* find(std::string_view name) const;

    // The same, or else a channel that spells the same component otherwise: "red" for "R".
    const StreamChannel* find_spelled(std::string_view name) const;

    // Replaces the channel of that name, or adds it at the end.  What a node computed is no id unless it says
    // so.
    void set(StreamChannel channel);
    void set(std::string_view name, ValueRef value) { set(StreamChannel{std::string(name), value}); }

    // What is known of the colour in R G B, where they are there.
    Nature nature_of_colour() const;
    void set_nature_of_colour(const Nature& nature);

    // The channel under another name, and all that it is.
    void set(std::string_view name, StreamChannel channel) {
        channel.name = name;
        set(std::move(channel));
    }
};

// What an image's channels hold, from the attributes of its Cryptomattes, the types of its samples and the
// names.  The attributes leave the stream's metadata for its channels.  `types`: of the channels, in order.
void learn_channels(Stream& stream, std::span<const SampleType> types);

}  // namespace keyline

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/digest.h"
#include "engine/color/color.h"
#include "engine/io/image_source.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <typeindex>
#include <utility>

namespace KEYLINE_API keyline {

// What the frames of a run share, and the runs of a program that keeps it: colour configs with their
// transforms, open images with their headers, what was parsed of them.  Each file is looked at whenever it is
// asked for, and read again once it is another.  What is kept is bounded: kImages open images, kBytes parsed.
//
// Look-up tables that a config names are read once by OpenColorIO, for the whole process.
//
// For any number of threads.
class Session {
public:
    static constexpr std::size_t kImages = 32;
    static constexpr std::size_t kBytes = std::size_t{16} << 20;

    // The config of a file; an empty name is the built-in one.  Throws Failure as ColorConfig::load() does.
    std::shared_ptr<const ColorConfig> colors(const std::filesystem::path& file);

    // Throws Failure as open_image() does.
    std::shared_ptr<const ImageSource> open(const std::filesystem::path& file, const OpenOptions& options);

    // The source that delivers the same and is in use, else this one: what decoding met is then found by all
    // frames that use it.
    std::shared_ptr<const ImageSource> shared(std::shared_ptr<const ImageSource> source);

    // What was made for this key, or make().
    using Made = std::shared_ptr<const void>;
    Made remember(const Digest& key, std::type_index type, std::size_t bytes,
                  const std::function<Made()>& make);

    // For tests: how often something was not there yet.
    struct Counts {
        int configs_loaded = 0, images_opened = 0, values_made = 0;
    };
    Counts counts() const;
    std::size_t images_kept() const;
    std::size_t bytes_kept() const;

private:
    struct Colors {
        std::filesystem::path file;
        Digest identity;
        std::shared_ptr<const ColorConfig> config;
    };
    struct Value {
        std::pair<Digest, std::type_index> key;
        std::size_t bytes = 0;
        Made made;
    };

    mutable std::mutex mutex_;
    Colors colors_;                                         // the last one: a run has one
    std::list<std::shared_ptr<const ImageSource>> images_;  // the last used first
    std::map<Digest, std::weak_ptr<const ImageSource>> in_use_;
    std::list<Value> values_;  // the last used first
    Counts counts_;
};

}  // namespace keyline

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/digest.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

// Colour management by OpenColorIO: a config names colour spaces, displays and views, and makes the
// transforms between them.  Nothing here falls back: what a config does not have is an error that lists what
// it has.

namespace KEYLINE_API keyline {

// Removes every OCIO_… variable from the environment.  OpenColorIO reads switches there (optimisation,
// caches, hidden spaces and views) that change pixels or take names away; results must follow from the graph
// alone.  $OCIO, which names a config, stays: the program reads it.  Call at the start of the program: the
// environment must not change while other threads run.
void clear_ocio_environment();

// The version that runs: "2.1.2".
std::string opencolorio_version();

// A transform of R G B.  A value; copies share immutable state, and any number of threads may apply one at
// the same time without meeting in a lock.  A pixel's result depends on that pixel alone: neither on how many
// are given at once nor on where they lie.
class ColorTransform {
public:
    ColorTransform() = default;  // changes nothing

    // Whether samples pass through untouched.  Where not, a picture's `chromaticities` no longer hold.
    bool identity() const { return !impl_; }

    // Converts n pixels in place; `a` may be null, and is only read.  RGB is taken as it is: not divided by
    // A.  NaN and infinities are allowed.
    void apply(float* r, float* g, float* b, const float* a, std::size_t n) const;

    // The same for premultiplied colour: where A > 0, RGB is divided by A before and multiplied after.
    // Other pixels (A is 0, negative or NaN) are converted as they are; so are all where `a` is null.
    void apply_premultiplied(float* r, float* g, float* b, const float* a, std::size_t n) const;

private:
    friend class ColorConfig;
    struct Impl;
    explicit ColorTransform(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

    std::shared_ptr<const Impl> impl_;  // null: identity
};

// An OCIO config, immutable and safe to use from any thread.  Names are matched as OCIO does: without regard
// to case, and aliases and roles ("scene_linear") stand for their spaces.
class ColorConfig {
public:
    // Throws Failure (kInput): no such file (listing the configs beside it), not a config, or of a version
    // that is later than what this build's OpenColorIO reads (naming both).
    static std::shared_ptr<const ColorConfig> load(const std::filesystem::path& file);

    // The config compiled into the library: color_builtin.h says what it holds.  Takes about a millisecond:
    // make it where a node uses colour, and share it.
    static std::shared_ptr<const ColorConfig> builtin();

    // The same with variables of its context, name and value, that stand in the names of its files and
    // spaces: $SHOT.  Throws BadValue for one that the config does not have, where it says which it has.
    std::shared_ptr<const ColorConfig> in_context(
        const std::vector<std::pair<std::string, std::string>>& variables) const;

    // From one space to another.  Between equal spaces, and from or to data such as 'Raw', it is the
    // identity, as OCIO has it.  Throws Failure: kGraph for a space that is not there, kInput where a file
    // that the config refers to can't be used.
    ColorTransform convert(const std::string& from, const std::string& to) const;

    // From a space to a view of a display; empty stands for the config's default display, and for the
    // default view of the display.  Throws as convert() does.
    ColorTransform display(const std::string& from, const std::string& display,
                           const std::string& view) const;

    // What the config calls a look, in a space: "grade", or several as "+grade, -warm".  Throws as convert()
    // does.
    ColorTransform look(const std::string& space, const std::string& looks, bool inverse) const;

    // A transform that the config names.  Throws as convert() does.
    ColorTransform named(const std::string& transform, bool inverse) const;

    // What a file says, of any kind that OpenColorIO reads: look-up tables (.cube .spi1d .spi3d .csp .3dl
    // .clf …) and colour decisions (.cc .ccc .cdl; `id` is the correction's, empty: the first).  A file is
    // read once for the whole process.  Throws Failure (kInput).
    ColorTransform file(const std::filesystem::path& file, const std::string& id, bool inverse) const;

    // The American Society of Cinematographers' colour decision list: (in × slope + offset) ^ power, then
    // the saturation, by Rec. 709's weights.  Nothing is clipped but what has no power: below 0 it stays.
    struct Decision {
        std::array<double, 3> slope{1, 1, 1}, offset{}, power{1, 1, 1};
        double saturation = 1;
    };
    ColorTransform decide(const Decision& decision, bool inverse) const;

    // What colour in a space is meant for, as far as the config says it.
    enum class SpaceFor { kUnknown, kScene, kDisplay };
    SpaceFor space_for(const std::string& space) const;

    std::vector<std::string> color_spaces() const;  // active ones, in the config's order, without roles
    std::vector<std::string> displays() const;
    std::vector<std::string> views(const std::string& display) const;  // empty for an unknown display

    // Of what it says, with the files that it names as they are.
    Digest digest() const;

    // "the built-in OCIO config" or "OCIO config 'FILE'", for messages.
    const std::string& name() const { return name_; }

private:
    struct Impl;
    ColorConfig(std::string name, std::shared_ptr<const Impl> impl)
        : name_(std::move(name)), impl_(std::move(impl)) {}

    void require_space(const std::string& space) const;
    void require_looks(const std::string& looks) const;
    void require_variable(const std::string& variable) const;
    std::string found_display(const std::string& display) const;
    std::string found_view(const std::string& display, const std::string& view) const;

    std::string name_;
    std::shared_ptr<const Impl> impl_;
};

}  // namespace keyline

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/channels.h"
#include "engine/base/index.h"
#include "engine/base/text.h"
#include "engine/io/text_file.h"
#include "engine/kit/cryptomatte.h"
#include "engine/kit/object_table.h"
#include "engine/kit/wildcard.h"
#include "engine/node/node_adaptor.h"
#include "engine/node/pixel_loop.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>

namespace keyline {

namespace {

// Which entry of a table an object has; kNone: none.
constexpr int kNone = -1;
struct Assigned {
    uint32_t id = 0;
    int entry = kNone;
};

// What a table gives each object, by how much of the pixel that covers: the values of one channel of the
// table's entries for each output, and last the coverage of all that have one.
class LayTable final : public Operation {
public:
    LayTable(std::vector<Assigned> objects, int otherwise, std::vector<std::vector<float>> channels)
        : objects_(std::move(objects)), otherwise_(otherwise), channels_(std::move(channels)) {}

    void compute(const Inputs& in, Outputs out, Scratch&) const override {
        const std::span<const View> ranks = in.slot(0);
        const Rect& rect = out[0].rect;
        for (int y = rect.y0; y < rect.y1; ++y) {
            for (const MutView& channel : out) std::fill_n(channel.row(y), rect.width(), 0.0F);
            for (std::size_t r = 0; r + 1 < ranks.size(); r += 2)
                add(ranks[r].row(y), ranks[r + 1].row(y), y, out);
        }
    }
    double cost() const override { return 40; }

private:
    int entry_of(uint32_t id) const {
        if (id << 1 == 0) return kNone;  // nothing, whichever sign it has
        const auto it = std::ranges::lower_bound(objects_, id, {}, &Assigned::id);
        return it != objects_.end() && it->id == id ? it->entry : otherwise_;
    }

    void add(const float* ids, const float* coverage, int y, Outputs out) const {
        uint32_t last = 0;  // neighbours mostly show the same object
        int entry = kNone;
        for (int x = 0; x < out[0].rect.width(); ++x) {
            const auto id = std::bit_cast<uint32_t>(ids[x]);
            if (id != last) entry = entry_of(id);
            last = id;
            if (entry == kNone) continue;
            for (std::size_t c = 0; c < out.size(); ++c) {
                float& sum = out[c].row(y)[x];
                sum =
                    with_one_nan(sum + (c < channels_.size() ? channels_[c][index(entry)] : 1) * coverage[x]);
            }
        }
    }

    std::vector<Assigned> objects_;  // sorted by id
    int otherwise_;                  // the entry of all other objects
    std::vector<std::vector<float>> channels_;
};

struct Palette {
    static constexpr Info info{"palette", "A colour or a number for each object, by a table of names."};

    struct Params {
        Input in;
        std::string layer;
        std::optional<Map<Color>> colors;
        std::optional<Map<double>> values;
        std::optional<FileName> table;

        static constexpr auto fields = declare(
            input(&Params::in, "in", "The image with the Cryptomatte, all of its layers."),
            field(&Params::layer, "layer",
                  "The Cryptomatte's name, as \"CryptoObject\"; empty where there is but one.")
                .naming(Naming::kCryptomatte),
            field(&Params::colors, "colors",
                  "Colours by name, in which * stands for any characters: { \"hair*\": \"#302018\", \"*\": "
                  "[0.2, 0.2, 0.2] }. The first that matches counts. Makes R G B, premultiplied, and A.")
                .naming(Naming::kObject),
            field(&Params::values, "values", "Numbers by name instead; makes one channel, 'value'.")
                .naming(Naming::kObject),
            field(
                &Params::table, "table",
                "A file of colours or numbers by name instead: .json, or .csv with lines of NAME,#rrggbb or "
                "NAME,R,G,B or NAME,NUMBER; a run of # stands for the frame number."));
    };

    static void check(const Params& p, Check& c) {
        const int given = (p.colors ? 1 : 0) + (p.values ? 1 : 0) + (p.table ? 1 : 0);
        if (given == 1) return;
        c.error(p.colors   ? "colors"
                : p.values ? "values"
                           : "table",
                given == 0 ? "none of 'colors', 'values' and 'table' is given"
                           : "of 'colors', 'values' and 'table' more than one is given",
                "give one of them");
    }

    explicit Palette(Params p) : params(std::move(p)) {}

    Stream expand(Builder& builder) const {
        Stream stream = builder.input(params.in);
        const Cryptomatte matte = find_cryptomatte(builder, stream, params.layer);
        const ObjectTable table = table_at(builder);
        const std::vector<std::string> patterns = patterns_of(table);
        int otherwise = kNone;
        std::vector<Assigned> objects = assigned(builder, *matte.info, patterns, otherwise);
        std::ranges::sort(objects, {}, &Assigned::id);
        const std::vector<const char*> outputs =
            table.colors ? std::vector{"R", "G", "B", "A"} : std::vector{"value"};
        const auto lay = std::make_shared<const LayTable>(std::move(objects), otherwise, channels_of(table));
        const auto values =
            builder.add(lay, {{stream, matte.values()}}, stream.window, static_cast<int>(outputs.size()));
        stream.channels.clear();
        for (std::size_t i = 0; i < outputs.size(); ++i) stream.set(outputs[i], values[i]);
        return stream;
    }

    const Params params;

private:
    const char* table() const { return params.table ? "table" : params.colors ? "colors" : "values"; }

    ObjectTable table_at(Builder& builder) const {
        if (!params.table) return {params.colors, params.values};
        const std::filesystem::path file = params.table->at(builder.frame());
        builder.file(file);
        return parse_object_table(read_text_file(file), file.string());
    }

    static std::vector<std::string> patterns_of(const ObjectTable& table) {
        std::vector<std::string> out;
        if (table.colors)
            for (const auto& [pattern, color] : table.colors->entries) out.push_back(pattern);
        else
            for (const auto& [pattern, value] : table.values->entries) out.push_back(pattern);
        return out;
    }

    static std::vector<std::vector<float>> channels_of(const ObjectTable& table) {
        std::vector<std::vector<float>> out(table.colors ? 3 : 1);
        if (table.colors) {
            for (const auto& [pattern, color] : table.colors->entries) {
                out[0].push_back(static_cast<float>(color.r));
                out[1].push_back(static_cast<float>(color.g));
                out[2].push_back(static_cast<float>(color.b));
            }
        } else {
            for (const auto& [pattern, value] : table.values->entries)
                out[0].push_back(static_cast<float>(value));
        }
        return out;
    }

    std::vector<Assigned> assigned(Builder& builder, const CryptomatteInfo& of,
                                   const std::vector<std::string>& patterns, int& otherwise) const {
        std::vector<std::string> faults;
        const auto manifest = CryptomatteManifest::find(builder, of, faults);
        for (const std::string& fault : faults)
            builder.warn(fmt::format("the Cryptomatte {}: {}", in_quotes(of.layers), fault));
        // It needs no manifest, and holds for what that forgets too.
        if (const auto all = std::ranges::find(patterns, "*"); all != patterns.end())
            otherwise = static_cast<int>(all - patterns.begin());
        return manifest ? by_manifest(builder, *manifest, patterns, otherwise) : by_hash(builder, patterns);
    }

    std::vector<Assigned> by_manifest(Builder& builder, const CryptomatteManifest& manifest,
                                      const std::vector<std::string>& patterns, int otherwise) const {
        std::vector<Assigned> out;
        std::vector<bool> used(patterns.size(), false);
        std::vector<std::string> left;
        for (const auto& [name, id] : manifest.entries()) {
            const auto first = std::ranges::find_if(
                patterns, [&, &name = name](const std::string& p) { return matches(name, p); });
            if (first == patterns.end()) {
                left.push_back(name);
                continue;
            }
            const auto entry = static_cast<int>(first - patterns.begin());
            used[index(entry)] = true;
            out.push_back({id, entry});
        }
        for (std::size_t i = 0; i < patterns.size(); ++i)
            if (!used[i] && patterns[i] != "*") tell_unused(builder, manifest, patterns[i]);
        if (!left.empty() && otherwise == kNone)
            builder.warn(
                fmt::format("'{}' has nothing for {} of {} objects: {}; an entry \"*\" is for all others",
                            table(), left.size(), manifest.size(), some_of(left)));
        return out;
    }

    // A name that an earlier entry takes, or that no object has.
    void tell_unused(Builder& builder, const CryptomatteManifest& manifest,
                     const std::string& pattern) const {
        if (!manifest.ids(pattern).empty())
            return builder.warn(
                fmt::format("'{}': all that {} matches has an entry before it", table(), in_quotes(pattern)));
        const std::string near = did_you_mean(pattern, manifest.names());
        builder.warn(fmt::format("'{}': none of the {} objects of the Cryptomatte is {}{}{}", table(),
                                 manifest.size(), in_quotes(pattern), near.empty() ? "" : "; ", near));
    }

    std::vector<Assigned> by_hash(Builder& builder, const std::vector<std::string>& patterns) const {
        std::vector<Assigned> out;
        for (std::size_t i = 0; i < patterns.size(); ++i) {
            if (patterns[i] == "*") continue;
            if (has_wildcard(patterns[i]))
                builder.bad_parameter(
                    table(),
                    fmt::format("the input has no manifest to look {} up in", in_quotes(patterns[i])),
                    "give whole names, and \"*\" for all others");
            const uint32_t id = cryptomatte_id(literal_name(patterns[i]));
            if (std::ranges::find(out, id, &Assigned::id) == out.end())
                out.push_back({id, static_cast<int>(i)});
        }
        return out;
    }
};

}  // namespace

KEYLINE_NODE(palette, Palette)

}  // namespace keyline

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/cryptomatte.h"

#include "engine/node_adaptor.h"
#include "engine/pixel_loop.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>

namespace keyline {

namespace {

// The coverage of the objects with given ids, over all ranks.
class Coverage final : public Operation {
public:
    explicit Coverage(std::vector<uint32_t> ids) : ids_(std::move(ids)) {}

    void compute(const Inputs& in, Outputs out, Scratch&) const override {
        const std::span<const View> ranks = in[Input{{}, {}, {}, 0}];
        const Rect& rect = out[0].rect;
        for (int y = rect.y0; y < rect.y1; ++y) {
            float* row = out[0].row(y);
            std::fill_n(row, rect.width(), 0.0F);
            for (std::size_t r = 0; r + 1 < ranks.size(); r += 2)
                add(ranks[r].row(y), ranks[r + 1].row(y), rect.width(), row);
        }
    }
    double cost() const override { return 30; }

private:
    void add(const float* ids, const float* coverage, int n, float* sum) const {
        uint32_t last = 0;  // neighbours mostly show the same object
        bool wanted = false;
        for (int x = 0; x < n; ++x) {
            const auto id = std::bit_cast<uint32_t>(ids[x]);
            if (id != last) wanted = std::ranges::binary_search(ids_, id);
            last = id;
            if (wanted) sum[x] = with_one_nan(sum[x] + coverage[x]);
        }
    }

    std::vector<uint32_t> ids_;  // sorted; 0, where there is nothing, is never one
};

struct CryptomatteNode {
    static constexpr Info info{"cryptomatte", "The matte of objects by their names."};

    struct Params {
        Input in;
        std::string layer;
        std::vector<std::string> objects;

        static constexpr auto fields = declare(
            input(&Params::in, "in", "The image with the Cryptomatte, all of its layers."),
            field(&Params::layer, "layer",
                  "The Cryptomatte's name, as \"CryptoObject\"; empty where there is but one."),
            field(&Params::objects, "objects", "Names; * in one stands for any characters.").required());
    };
    static constexpr std::array outputs{"matte"};

    explicit CryptomatteNode(const Params& p) : params(p) {}

    Stream expand(Builder& builder) const {
        Stream stream = builder.input(params.in);
        const Cryptomatte matte = find_cryptomatte(stream, params.layer);
        check_types(builder, matte);
        const auto operation = std::make_shared<const Coverage>(ids(builder, stream, matte));
        const auto value = builder.add(operation, {{stream.window, matte.values()}}, stream.window, 1);
        stream.channels.clear();
        stream.set(outputs[0], value.front());
        return stream;
    }

    const Params params;

private:
    static void check_types(const Builder& builder, const Cryptomatte& matte) {
        for (const Cryptomatte::Rank& rank : matte.ranks)
            if (builder.stored_type(rank.id).value_or(SampleType::kFloat) != SampleType::kFloat)
                fail(ErrorKind::kInput,
                     fmt::format("the ids of the Cryptomatte {} are not stored as float, which destroys them",
                                 in_quotes(matte.name)),
                     "write them with 32 bits");
    }

    std::vector<uint32_t> ids(Builder& builder, const Stream& stream, const Cryptomatte& matte) const {
        const auto manifest = CryptomatteManifest::find(stream, matte, params.layer);
        std::vector<uint32_t> out;
        for (const std::string& object : params.objects) {
            const auto found =
                manifest ? known_ids(builder, *manifest, object) : unlisted_id(builder, object);
            out.insert(out.end(), found.begin(), found.end());
        }
        std::ranges::sort(out);
        return out;
    }

    static std::vector<uint32_t> known_ids(Builder& builder, const CryptomatteManifest& manifest,
                                           const std::string& object) {
        std::vector<uint32_t> ids = manifest.ids(object);
        if (ids.empty())
            builder.bad_parameter("objects",
                                  fmt::format("none of the {} objects of the Cryptomatte is {}",
                                              manifest.size(), in_quotes(object)),
                                  did_you_mean(object, manifest.names()));
        return ids;
    }

    // Without a manifest a name can still be hashed; whether there is such an object can't be told.
    static std::vector<uint32_t> unlisted_id(Builder& builder, const std::string& object) {
        if (object.find('*') != std::string::npos)
            builder.bad_parameter(
                "objects", fmt::format("the input has no manifest to look {} up in", in_quotes(object)),
                "give whole names");
        builder.warn(fmt::format("the input has no manifest; {} is looked for unchecked", in_quotes(object)));
        return {cryptomatte_id(object)};
    }
};

}  // namespace

KEYLINE_NODE(cryptomatte, CryptomatteNode)

}  // namespace keyline

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/cryptomatte.h"

#include "engine/kit/wanted_objects.h"
#include "engine/node/node_adaptor.h"
#include "engine/node/pixel_loop.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <fmt/format.h>

namespace keyline {

namespace {

// The coverage of some objects, over all ranks.
class Coverage final : public Operation {
public:
    explicit Coverage(std::vector<WantedObject> objects)
        : objects_(std::move(objects)), seen_(objects_.size()) {}

    void compute(const Inputs& in, Outputs out, Scratch&) const override {
        const std::span<const View> ranks = in.slot(0);
        const Rect& rect = out[0].rect;
        ran_.store(true, std::memory_order_relaxed);
        for (int y = rect.y0; y < rect.y1; ++y) {
            float* row = out[0].row(y);
            std::fill_n(row, rect.width(), 0.0F);
            for (std::size_t r = 0; r + 1 < ranks.size(); r += 2)
                add(ranks[r].row(y), ranks[r + 1].row(y), rect.width(), row);
        }
    }
    double cost() const override { return 30; }

    // A name that was misspelled covers nothing, as an object does that is out of sight.
    std::vector<std::string> findings() const override {
        std::vector<std::string> out;
        for (std::size_t i = 0; ran_ && i < objects_.size(); ++i)
            if (!seen_[i] && !objects_[i].unchecked.empty())
                out.push_back(
                    fmt::format("no pixel shows {}; is that its name?", in_quotes(objects_[i].unchecked)));
        return out;
    }

private:
    bool find(uint32_t id) const {
        const auto it = std::ranges::lower_bound(objects_, id, {}, &WantedObject::id);
        if (it == objects_.end() || it->id != id) return false;
        seen_[static_cast<std::size_t>(it - objects_.begin())].store(true, std::memory_order_relaxed);
        return true;
    }

    void add(const float* ids, const float* coverage, int n, float* sum) const {
        uint32_t last = 0;  // neighbours mostly show the same object
        bool wanted = false;
        for (int x = 0; x < n; ++x) {
            const auto id = std::bit_cast<uint32_t>(ids[x]);
            if (id != last) wanted = find(id);
            last = id;
            if (wanted) sum[x] = with_one_nan(sum[x] + coverage[x]);
        }
    }

    std::vector<WantedObject> objects_;  // sorted by id; the id 0, where there is nothing, is never one
    mutable std::vector<std::atomic<bool>> seen_;
    mutable std::atomic<bool> ran_ = false;
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
                  "The Cryptomatte's name, as \"CryptoObject\"; empty where there is but one.")
                .naming(Naming::kCryptomatte),
            field(&Params::objects, "objects", "Names; * in one stands for any characters, \\* for a star.")
                .required()
                .naming(Naming::kObject));
    };
    static constexpr std::array outputs{"matte"};

    explicit CryptomatteNode(const Params& p) : params(p) {}

    Stream expand(Builder& builder) const {
        Stream stream = builder.input(params.in);
        const Cryptomatte matte = find_cryptomatte(builder, stream, params.layer);
        const auto operation = std::make_shared<const Coverage>(wanted(builder, *matte.info));
        const auto value = builder.add(operation, {{stream, matte.values()}}, stream.window, 1);
        stream.channels.clear();
        stream.set(outputs[0], value.front());
        return stream;
    }

    const Params params;

private:
    std::vector<WantedObject> wanted(Builder& builder, const CryptomatteInfo& of) const {
        std::vector<std::string> faults;
        const auto manifest = CryptomatteManifest::find(builder, of, faults);
        for (const std::string& fault : faults)
            builder.warn(fmt::format("the Cryptomatte {}: {}", in_quotes(of.layers), fault));
        return wanted_objects(builder, manifest, params.objects);
    }
};

}  // namespace

KEYLINE_NODE(cryptomatte, CryptomatteNode)

}  // namespace keyline

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/channels.h"
#include "engine/base/error.h"
#include "engine/kit/cryptomatte.h"
#include "engine/kit/manifest_text.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <system_error>

namespace keyline {

namespace {

Attribute text_attribute(std::string name, std::string text) {
    return {std::move(name), "string", std::move(text)};
}

// As the specification has it: seven digits of the name's hash.
std::string prefix_for(std::string_view name) {
    return fmt::format("cryptomatte/{}/", fmt::format("{:08x}", murmur3_32(name)).substr(0, 7));
}

bool same_folder(const std::filesystem::path& a, const std::filesystem::path& b) {
    std::error_code error;
    const auto folder = [&](const std::filesystem::path& p) {
        return std::filesystem::weakly_canonical(std::filesystem::absolute(p, error).parent_path(), error);
    };
    return folder(a) == folder(b) && !error;
}

// Whether other programs find its channels: NAME00.r, NAME00.g, … and not NAME.r.
bool is_found(const Stream& stream, const Cryptomatte& matte) {
    return std::ranges::none_of(stream.channels, [&](const StreamChannel& c) {
        return c.cryptomatte == matte.info && split_channel(c.name).layer == matte.name;
    });
}

class Attributes {
public:
    Attributes(Builder& builder, const std::filesystem::path& file) : builder_(builder), file_(file) {}

    void add(const Cryptomatte& matte) {
        const CryptomatteInfo& info = *matte.info;
        const bool renamed = matte.name != info.layers;
        std::string prefix = renamed ? prefix_for(matte.name) : info.prefix;
        if (!taken_.insert(prefix).second) prefix = prefix_for(matte.name);
        for (const Attribute& a : info.attributes)
            if (a.name == "name")
                out_.push_back(text_attribute(prefix + a.name, renamed ? matte.name : info.name));
            else if (a.name == "manif_file")
                add_sidecar(matte, prefix, a);
            else
                out_.push_back({prefix + a.name, a.type, a.value});
    }

    std::vector<Attribute> take() { return std::move(out_); }

private:
    // The file of names stays where it is; beside an image elsewhere it would be missed.
    void add_sidecar(const Cryptomatte& matte, const std::string& prefix, const Attribute& a) {
        if (same_folder(matte.info->file, file_)) return out_.push_back({prefix + a.name, a.type, a.value});
        std::vector<std::string> faults;
        if (auto text = manifest_text(*matte.info, faults)) {
            const auto has = [&](const Attribute& o) { return o.name == prefix + "manifest"; };
            if (std::ranges::none_of(out_, has))
                out_.push_back(text_attribute(prefix + "manifest", std::move(*text)));
            return;
        }
        for (const std::string& fault : faults)
            builder_.warn(fmt::format("the Cryptomatte {} is written without its objects' names: {}",
                                      in_quotes(matte.shown_name()), fault));
    }

    Builder& builder_;
    const std::filesystem::path& file_;
    std::set<std::string> taken_;
    std::vector<Attribute> out_;
};

}  // namespace

std::vector<Attribute> cryptomatte_attributes(Builder& builder, const Stream& stream,
                                              const std::filesystem::path& file) {
    Attributes attributes(builder, file);
    for (const Cryptomatte& matte : cryptomattes_of(stream)) {
        if (matte.info->attributes.empty()) continue;
        if (is_found(stream, matte))
            attributes.add(matte);
        else
            builder.warn(
                fmt::format("the Cryptomatte {} is written without its attributes: its layers are no longer "
                            "called NAME00, NAME01, …",
                            in_quotes(matte.info->layers)));
    }
    return attributes.take();
}

}  // namespace keyline

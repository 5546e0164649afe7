// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/channels.h"
#include "engine/color_operation.h"
#include "engine/cryptomatte.h"
#include "engine/node_adaptor.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace keyline {

constexpr auto words(Depth) {
    return std::array{Word<Depth>{"auto", Depth::kAuto,
                                  "the file's own type for what passed untouched, else half (a Cryptomatte's "
                                  "channels float), or the best the format holds"},
                      Word<Depth>{"half", Depth::kHalf, "16-bit float"},
                      Word<Depth>{"float", Depth::kFloat, "32-bit float"},
                      Word<Depth>{"uint8", Depth::kUint8, "8 bits, 0 to 1"},
                      Word<Depth>{"uint16", Depth::kUint16, "16 bits, 0 to 1"}};
}

namespace {

// An image file, or the frames of a sequence.
struct Write {
    static constexpr Info info{
        "write", "Writes an image: OpenEXR, or by the extension anything that OpenImageIO writes."};

    struct Params {
        Input in;
        FileName file;
        std::vector<std::string> channels;
        Depth depth = Depth::kAuto;
        std::string compression = "zip";
        std::string colorspace;
        Map<Input> layers;

        static constexpr auto fields = declare(
            input(&Params::in, "in", "What to write; display window and metadata come from it."),
            field(&Params::file, "file", "The file; a run of # stands for the frame number.").required(),
            field(&Params::channels, "channels", "The channels or layers to write; all when absent."),
            field(&Params::depth, "depth", "The type of the samples."),
            field(&Params::compression, "compression", "The compression, by the format's own name for it."),
            field(&Params::colorspace, "colorspace",
                  "The OpenColorIO space of the file: every layer with R G B is converted to it from "
                  "scene_linear. Empty leaves samples alone."),
            input(&Params::layers, "layers",
                  "Further inputs by layer name, written as that layer's channels."));
    };

    explicit Write(const Params& p) : params(p) {}

    void write(Builder& builder) const {
        SinkRequest request;
        request.stream = chosen(builder, with_layers(builder));
        if (!params.colorspace.empty())
            request.stream = convert_layers(builder, request.stream,
                                            builder.colors().convert("scene_linear", params.colorspace));
        request.file = params.file.at(builder.frame());
        request.spec = spec(builder, request.stream);
        request.check = [file = request.file](const SinkSpec& s) { check_image(file, s); };
        request.create = [file = request.file](const SinkSpec& s) { return create_image(file, s); };
        builder.add_sink(std::move(request));
    }

    const Params params;

private:
    Stream with_layers(Builder& builder) const {
        Stream stream = builder.input(params.in);
        for (const auto& [layer, in] : params.layers.entries) {
            const Stream more = builder.input(in);
            stream.window = unite(stream.window, more.window);
            for (const StreamChannel& c : more.channels) {
                const std::string name = join_channel(layer, c.name);
                if (stream.find(name))
                    builder.bad_parameter(
                        "layers", fmt::format("the channel {} would be written twice", in_quotes(name)),
                        "give the layer another name");
                stream.set(name, c.value);
            }
        }
        return stream;
    }

    Stream chosen(Builder& builder, const Stream& all) const {
        if (params.channels.empty()) return all;
        const std::vector<std::string> names = all.names();
        std::set<std::size_t> kept;
        for (const std::string& wanted : params.channels) {
            const std::size_t before = kept.size();
            for (std::size_t i = 0; i < names.size(); ++i)
                if (names[i] == wanted || split_channel(names[i]).layer == wanted) kept.insert(i);
            if (kept.size() == before && std::ranges::find(names, wanted) == names.end())
                builder.bad_parameter("channels",
                                      fmt::format("there is no channel or layer {}", in_quotes(wanted)),
                                      there_are(wanted, names));
        }
        Stream out = all;
        out.channels.clear();
        for (const std::size_t i : kept) out.channels.push_back(all.channels[i]);
        return out;
    }

    static std::string there_are(const std::string& wanted, const std::vector<std::string>& names) {
        std::string hint = did_you_mean(wanted, names);
        return hint.empty() ? "there are the channels " + some_of(names) : hint;
    }

    SinkSpec spec(const Builder& builder, const Stream& stream) const {
        SinkSpec s;
        s.display_window = stream.display;
        s.data_window = stream.window;
        s.metadata = still_true(*stream.metadata, stream);
        s.depth = params.depth;
        s.compression = params.compression;
        for (const StreamChannel& c : stream.channels)
            s.channels.push_back({c.name, type_of(builder, c, s.metadata)});
        return s;
    }

    SampleType type_of(const Builder& builder, const StreamChannel& channel, const Metadata& metadata) const {
        if (params.depth == Depth::kAuto)
            return builder.stored_type(channel.value)
                .value_or(is_of_cryptomatte(channel.name, metadata) ? SampleType::kFloat : SampleType::kHalf);
        return params.depth == Depth::kHalf ? SampleType::kHalf : SampleType::kFloat;
    }

    // Its ids are bits that half would round.
    static bool is_of_cryptomatte(const std::string& channel, const Metadata& metadata) {
        return std::ranges::any_of(cryptomatte_entries(metadata),
                                   [&](const CryptomatteEntry& e) { return channel.starts_with(e.name); });
    }

    // Without the Cryptomattes whose channels are not written.
    static Metadata still_true(Metadata metadata, const Stream& stream) {
        for (const auto& [prefix, name] : cryptomatte_entries(metadata)) {
            const auto is_its = [&n = name](const StreamChannel& c) { return c.name.starts_with(n); };
            if (!std::ranges::any_of(stream.channels, is_its)) erase_all(prefix, metadata);
        }
        return metadata;
    }

    static void erase_all(const std::string& prefix, Metadata& metadata) {
        std::vector<std::string> names;
        for (const Attribute& a : metadata.attributes())
            if (a.name.starts_with(prefix)) names.push_back(a.name);
        for (const std::string& name : names) metadata.erase(name);
    }
};

}  // namespace

KEYLINE_NODE(write, Write)

}  // namespace keyline

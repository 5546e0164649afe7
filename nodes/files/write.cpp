// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/bad_value.h"
#include "engine/base/channels.h"
#include "engine/io/other_formats.h"
#include "engine/kit/color_operation.h"
#include "engine/kit/cryptomatte.h"
#include "engine/node/node_adaptor.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <set>

namespace keyline {

constexpr auto words(Depth) {
    return std::array{
        Word<Depth>{"auto", Depth::kAuto,
                    "the file's own type for what passed untouched, else half (float for what is "
                    "measured, as depth is; ids and Cryptomattes 32 bits), or the best the "
                    "format holds"},
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
                  "The OpenColorIO space of the file: every layer of colour is converted to it from "
                  "scene_linear; ids and passes like normals are not. Empty leaves samples alone.")
                .naming(Naming::kColorSpace),
            input(&Params::layers, "layers",
                  "Further inputs by layer name, written as that layer's channels."));
    };

    explicit Write(const Params& p) : params(p) {}

    void write(Builder& builder) const {
        SinkRequest request;
        request.stream = chosen(with_layers(builder));
        if (!params.colorspace.empty())
            request.stream = convert_layers(
                builder, request.stream, builder.colors().convert("scene_linear", params.colorspace),
                {Nature::For::kScene, colour_for(builder.colors(), params.colorspace)});
        request.file = params.file.at(builder.frame());
        // Formats without windows hold what is displayed; what lies beyond is not computed for them.
        if (is_other_format(request.file))
            request.stream.window = intersect(request.stream.window, request.stream.display);
        request.spec = spec(builder, request.stream, request.file);
        tell_of_mistakes(builder, request);
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
                stream.set(name, c);
            }
        }
        return stream;
    }

    Stream chosen(const Stream& all) const {
        if (params.channels.empty()) return all;
        const std::vector<std::string> names = all.names();
        std::set<std::size_t> kept;
        for (const std::string& wanted : params.channels) {
            bool is_there = false;
            for (std::size_t i = 0; i < names.size(); ++i)
                if (names[i] == wanted || split_channel(names[i]).layer == wanted) {
                    kept.insert(i);
                    is_there = true;
                }
            if (!is_there)
                throw BadValue(wanted, fmt::format("there is no channel or layer {}", in_quotes(wanted)),
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

    SinkSpec spec(Builder& builder, const Stream& stream, const std::filesystem::path& file) const {
        SinkSpec s;
        s.display_window = stream.display;
        s.data_window = stream.window;
        s.metadata = *stream.metadata;
        for (Attribute& a : cryptomatte_attributes(builder, stream, file)) s.metadata.set(std::move(a));
        if (const auto dropped = s.metadata.erase_unstorable(); !dropped.empty())
            builder.warn(fmt::format(
                "no file can hold {} of the input's attributes, which have names or types that are "
                "empty or too long: {}",
                dropped.size(), some_of(dropped)));
        s.depth = params.depth;
        s.compression = params.compression;
        for (const StreamChannel& c : stream.channels)
            s.channels.push_back({c.name, type_of(builder, c), c.exact()});
        if (params.depth == Depth::kHalf) tell_of_whole(builder, s);
        return s;
    }

    SampleType type_of(const Builder& builder, const StreamChannel& channel) const {
        const auto stored = builder.stored_type(channel.value);
        // Half would round ids, and the coverage is read with them.
        if (channel.exact()) return stored.value_or(channel.integer ? SampleType::kUint : SampleType::kFloat);
        // What is measured reaches beyond half, and half is too coarse for it.
        const bool is_measured = channel.holds == Holds::kData;
        if (params.depth == Depth::kAuto)
            return stored.value_or(is_measured ? SampleType::kFloat : SampleType::kHalf);
        return params.depth == Depth::kHalf ? SampleType::kHalf : SampleType::kFloat;
    }

    void tell_of_mistakes(Builder& builder, const SinkRequest& request) const {
        const Nature nature = request.stream.nature_of_colour();
        const InOtherFormat becomes = in_other_format(request.file, request.spec);
        if (becomes.whole_numbers && nature.colour_for == Nature::For::kScene)
            builder.warn(Code::kLinearInFile,
                         fmt::format("scene-linear colour goes into {}, which is looked at as it is: it will "
                                     "be too dark",
                                     in_quotes(request.file.filename().string())),
                         "put a 'display' before it, or give the file's 'colorspace'");
        if (becomes.divided && nature.divided)
            builder.warn(Code::kDividedTwice,
                         "R G B are divided by A already, and the file's format divides once more",
                         "put a 'premultiply' before it");
        if (params.depth == Depth::kHalf) tell_of_depth(builder, request.stream);
    }

    static void tell_of_depth(Builder& builder, const Stream& stream) {
        std::vector<std::string> names;
        for (const StreamChannel& c : stream.channels)
            if (is_depth(stream, c) && builder.stored_type(c.value) != SampleType::kHalf)
                names.push_back(c.name);
        if (!names.empty())
            builder.warn(
                Code::kDepthInHalf,
                fmt::format("{}: half ends at 65504, and holds three digits of a depth", some_of(names)),
                "leave 'depth' out: what is measured is then written as float");
    }

    // A Z without X and Y, which would make it a place or a direction.
    static bool is_depth(const Stream& stream, const StreamChannel& channel) {
        if (channel.holds != Holds::kData || channel.exact()) return false;
        const auto [layer, base] = split_channel(channel.name);
        return component_of(base) == "Z" ? !stream.find_spelled(join_channel(layer, "X"))
                                         : is_called_depth(std::string(base));
    }

    static bool is_called_depth(std::string name) {
        std::ranges::transform(name, name.begin(),
                               [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        return name.ends_with("depth");
    }

    static void tell_of_whole(Builder& builder, const SinkSpec& spec) {
        std::vector<std::string> names;
        for (const ChannelInfo& c : spec.channels)
            if (c.exact && c.type != SampleType::kHalf) names.push_back(c.name);
        if (!names.empty())
            builder.warn(fmt::format("{}: ids keep their 32 bits, which half would destroy", some_of(names)));
    }
};

}  // namespace

KEYLINE_NODE(write, Write)

}  // namespace keyline

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/absent_input.h"
#include "engine/io/mended_source.h"
#include "engine/io/other_formats.h"
#include "engine/kit/color_operation.h"
#include "engine/node/node_adaptor.h"
#include "engine/params/missing_file.h"

#include <charconv>
#include <fmt/format.h>

namespace keyline {

constexpr auto words(NanPolicy) {
    return std::array{Word<NanPolicy>{"mend", NanPolicy::kMend,
                                      "NaN becomes 0 and infinity the largest value, with a warning"},
                      Word<NanPolicy>{"keep", NanPolicy::kKeep, "as they are"},
                      Word<NanPolicy>{"error", NanPolicy::kError, "the frame fails"}};
}

namespace {

enum class Missing { kError, kBlack, kHold };

constexpr auto words(Missing) {
    return std::array{
        Word<Missing>{"error", Missing::kError, "the frame fails"},
        Word<Missing>{"black", Missing::kBlack, "zeros, with the windows and channels of the nearest frame"},
        Word<Missing>{"hold", Missing::kHold, "the nearest earlier frame, else the nearest later"}};
}

// An image file, or the frames of a sequence.
struct Read {
    static constexpr Info info{"read", "Reads an image: OpenEXR, or anything else that OpenImageIO reads."};

    struct Params {
        FileName file;
        std::string colorspace;
        std::variant<std::string, int> part;
        std::string view;
        std::variant<std::string, int> frame;
        NanPolicy nan = NanPolicy::kMend;
        Missing missing = Missing::kError;

        static constexpr auto fields = declare(
            field(&Params::file, "file", "The file; a run of # stands for the frame number.").required(),
            field(
                &Params::colorspace, "colorspace",
                "The OpenColorIO space of the file: every layer of colour is converted to scene_linear; ids "
                "and passes like normals are not. Empty leaves samples alone.")
                .naming(Naming::kColorSpace),
            field(&Params::part, "part",
                  "One part of a multi-part file, by name or index; empty takes all parts of the view."),
            field(&Params::view, "view", "The view of a multi-view file; empty takes its default."),
            field(&Params::frame, "frame",
                  "Another frame than the one rendered: a number, or an offset as \"-1\"."),
            field(&Params::nan, "nan", "What becomes of NaN and infinite samples."),
            field(&Params::missing, "missing", "What to do where the file of a frame is not there."));
    };

    static void check(const Params& p, Check& c) {
        if (const auto* text = std::get_if<std::string>(&p.frame); text && !text->empty() && !offset(*text))
            c.error("frame", fmt::format("'frame' is {}; it must be a number, or an offset as \"-1\"",
                                         in_quotes(*text)));
    }

    explicit Read(const Params& p) : params(p) {}

    Stream read(Builder& builder) const {
        const auto source = open(builder);
        Stream stream = builder.add_source(mended(source, params.nan));
        if (params.colorspace.empty()) return known(stream, source->header().file);
        return convert_layers(builder, stream, builder.colors().convert(params.colorspace, "scene_linear"),
                              {Nature::For::kUnknown, Nature::For::kScene});
    }

    const Params params;

private:
    // What files of its kind hold, where nobody says otherwise.
    static Stream known(Stream stream, const std::filesystem::path& file) {
        const bool is_exr = !is_other_format(file);
        const auto colour_for = is_exr                      ? Nature::For::kScene
                                : holds_whole_numbers(file) ? Nature::For::kDisplay
                                                            : Nature::For::kUnknown;
        for (StreamChannel& c : stream.channels)
            if (c.holds == Holds::kColour && !c.exact()) c.nature.colour_for = colour_for;
        return stream;
    }

    static std::optional<int> offset(const std::string& text) {
        const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
        int value = 0;
        const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
        if (error != std::errc{} || end != text.data() + text.size()) return {};
        return value;
    }

    int wanted_frame(int frame) const {
        if (const int* number = std::get_if<int>(&params.frame)) return *number;
        const auto& text = std::get<std::string>(params.frame);
        return text.empty() ? frame : frame + offset(text).value_or(0);
    }

    std::shared_ptr<const ImageSource> open(Context& context) const {
        const int frame = params.file.has_frame() ? wanted_frame(context.frame()) : 0;
        const std::filesystem::path path = params.file.at(frame);
        std::error_code unknown;  // where it can't be looked at, opening it says why
        if (std::filesystem::exists(path, unknown) || unknown) return context.open(path, options());
        const std::optional<int> other = params.missing == Missing::kError ? std::nullopt : stand_in(frame);
        if (!other) throw AbsentInput(path.string(), hint_for_missing(params.file, frame));
        auto source = context.open(params.file.at(*other), options());
        context.warn(fmt::format("frame {} is missing; {} {} stands in", frame,
                                 params.missing == Missing::kBlack ? "black like frame" : "frame", *other));
        return params.missing == Missing::kBlack ? black_like(*source) : source;
    }

    OpenOptions options() const {
        OpenOptions o;
        o.part = std::holds_alternative<int>(params.part) ? fmt::format("{}", std::get<int>(params.part))
                                                          : std::get<std::string>(params.part);
        o.view = params.view;
        return o;
    }

    // The frame on disk to use for a missing one.
    std::optional<int> stand_in(int frame) const {
        const std::vector<int> frames = params.file.frames_on_disk();
        if (frames.empty()) return {};
        const auto later = std::ranges::lower_bound(frames, frame);
        if (later == frames.begin()) return *later;
        const int earlier = *(later - 1);
        if (params.missing == Missing::kHold || later == frames.end()) return earlier;
        return frame - earlier <= *later - frame ? earlier : *later;
    }
};

}  // namespace

KEYLINE_NODE(read, Read)

}  // namespace keyline

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/absent_input.h"
#include "engine/base/digest.h"
#include "engine/io/text_file.h"
#include "engine/kit/strokes_json.h"
#include "engine/node/node_adaptor.h"
#include "engine/params/missing_file.h"

#include <fmt/format.h>

namespace keyline {

namespace {

using StrokesDatum = DatumOf<Strokes>;

// They were read with the windows that the frame is planned by.
class ReadStrokes final : public Derivation {
public:
    ReadStrokes(std::filesystem::path file, std::shared_ptr<const StrokesDatum> strokes)
        : file_(std::move(file)), strokes_(std::move(strokes)) {}
    const char* gives() const override { return Strokes::kind; }
    std::shared_ptr<const Datum> derive(const Inputs&) const override { return strokes_; }
    std::size_t datum_bytes() const override { return strokes_->bytes(); }
    std::filesystem::path file() const override { return file_; }

private:
    std::filesystem::path file_;
    std::shared_ptr<const StrokesDatum> strokes_;
};

struct StrokesRead {
    static constexpr Info info{"strokes_read", "Reads strokes from JSON, as strokes_write makes it."};
    using Gives = Strokes;

    struct Params {
        FileName file;

        static constexpr auto fields = declare(
            field(&Params::file, "file", "The file; a run of # stands for the frame number.").required());
    };

    explicit StrokesRead(Params p) : params(std::move(p)) {}

    Stream read(Builder& builder) const {
        const std::filesystem::path file = params.file.at(builder.frame());
        const auto strokes = parsed(builder, file);
        Stream stream = builder.add_source(std::make_shared<const ReadStrokes>(file, strokes));
        stream.display = strokes->value.display;
        stream.window = strokes->value.window;
        return stream;
    }

    const Params params;

private:
    std::shared_ptr<const StrokesDatum> parsed(Context& context, const std::filesystem::path& file) const {
        std::error_code unknown;  // where it can't be looked at, reading it says why
        if (!std::filesystem::exists(file, unknown) && !unknown)
            throw AbsentInput(file.string(), hint_for_missing(params.file, context.frame()));
        const Digest key = Digester("strokes").add(context.file(file)).digest();
        const std::size_t bytes = std::filesystem::file_size(file, unknown);
        return context.remember<StrokesDatum>(key, unknown ? 0 : bytes, [&] {
            return StrokesDatum(parse_strokes(read_text_file(file), file.string()));
        });
    }
};

}  // namespace

KEYLINE_NODE(strokes_read, StrokesRead)

}  // namespace keyline

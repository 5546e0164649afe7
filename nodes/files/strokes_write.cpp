// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/text_file.h"
#include "engine/kit/strokes_json.h"
#include "engine/node/node_adaptor.h"

namespace keyline {

namespace {

class WriteStrokes final : public DataSink {
public:
    explicit WriteStrokes(std::filesystem::path file) : file_(std::move(file)) {}
    void write(const std::shared_ptr<const Datum>& datum) override {
        write_text_file(file_, strokes_json(datum_as<Strokes>(*datum)));
    }

private:
    std::filesystem::path file_;
};

struct StrokesWrite {
    static constexpr Info info{
        "strokes_write", "Writes strokes as JSON, one file a frame, for scripts to change; nothing is lost."};

    struct Params {
        Input in;
        FileName file;

        static constexpr auto fields = declare(
            input(&Params::in, "in", "The strokes.", data<Strokes>()),
            field(&Params::file, "file", "The file; a run of # stands for the frame number.").required());
    };

    explicit StrokesWrite(Params p) : params(std::move(p)) {}

    void write(Builder& builder) const {
        SinkRequest request;
        request.stream = builder.input(params.in);
        request.file = params.file.at(builder.frame());
        request.create_for_data = [file = request.file] { return std::make_unique<WriteStrokes>(file); };
        builder.add_sink(std::move(request));
    }

    const Params params;
};

}  // namespace

KEYLINE_NODE(strokes_write, StrokesWrite)

}  // namespace keyline

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/interpret.h"

#include "engine/plan/demand.h"
#include "engine/simd/half.h"

#include <cstring>

namespace keyline::testing {

namespace {

// Samples over a window, with room behind the last for a vector to be loaded from there.
struct Samples {
    Rect window;
    std::vector<float> floats;

    explicit Samples(const Rect& w) : window(w), floats(static_cast<std::size_t>(w.area()) + 64) {}
    float* at(int x, int y) {
        return floats.data() + std::ptrdiff_t{y - window.y0} * window.width() + (x - window.x0);
    }
    MutView view(const Rect& behind) { return {floats.data(), window.width(), window, behind}; }
};

class Interpreter {
public:
    explicit Interpreter(const ResolvedFrame& frame) {
        for (const Op& op : frame.ops) {
            std::vector<Samples>& outputs = values_.emplace_back();
            for (const ValueInfo& v : op.outputs) outputs.emplace_back(v.window);
            data_.push_back(op.makes_data() ? datum(op) : nullptr);
            if (op.source)
                decode(op, outputs);
            else if (op.operation && !op.outputs.front().window.empty())
                compute(op, outputs);
        }
    }

    std::vector<std::shared_ptr<const Datum>> data() { return std::move(data_); }

    Image picture(const SinkRequest& request) {
        if (request.stream.is_data()) return {};
        Image image(request.stream.window, std::vector<std::string>{});
        image.display = request.stream.display;
        image.metadata = *request.stream.metadata;
        for (std::size_t c = 0; c < request.stream.channels.size(); ++c) {
            const Samples whole = gathered(request.stream.channels[c].value, image.window, image.window);
            image.channels.push_back({request.stream.channels[c].name,
                                      request.spec.channels[c].type,
                                      {whole.floats.begin(), whole.floats.begin() + image.window.area()}});
        }
        return image;
    }

private:
    static void decode(const Op& op, std::vector<Samples>& outputs) {
        const ImageHeader& header = op.source->header();
        for (std::size_t i = 0; i < outputs.size(); ++i) {
            const ChannelGroup& group = header.groups[op.source_group[i]];
            const SampleType type = group.channels[op.source_channel[i]].type;
            const auto n = static_cast<std::size_t>(group.window.area());
            std::vector<std::byte> bytes(n * sample_size(type));
            std::vector<Plane> planes(group.channels.size());
            planes[op.source_channel[i]] = {
                bytes.data(), static_cast<std::ptrdiff_t>(sample_size(type)) * group.window.width(), type,
                group.window};
            for (int row = 0; row < group.rows(); ++row)
                for (int column = 0; column < group.columns(); ++column)
                    op.source->read_chunk(op.source_group[i], column, row, planes);
            to_floats(bytes.data(), type, outputs[i].floats.data(), n);
        }
    }

    static void to_floats(const std::byte* in, SampleType type, float* out, std::size_t n) {
        if (type == SampleType::kHalf)
            simd::half_to_float(reinterpret_cast<const uint16_t*>(in), out, n);
        else if (n > 0)  // of an integer too the bits; memcpy takes no null pointer, of no bytes either
            std::memcpy(out, in, n * sizeof(float));
    }

    // A value over `rect`, 0 outside its own window and outside `window`.
    Samples gathered(ValueRef v, const Rect& rect, const Rect& window) {
        Samples out(rect);
        Samples& from = values_[static_cast<std::size_t>(v.op)][static_cast<std::size_t>(v.output)];
        const Rect valid = intersect(intersect(rect, window), from.window);
        for (int y = valid.y0; y < valid.y1; ++y)
            std::memcpy(out.at(valid.x0, y), from.at(valid.x0, y),
                        static_cast<std::size_t>(valid.width()) * sizeof(float));
        return out;
    }

    // What an operation is given, each link over the rectangle that rect_of(slot) says.
    struct Given {
        std::vector<Samples> samples;
        std::vector<View> views;
        std::vector<Inputs::Range> slots;
        std::vector<const Datum*> data;
        Inputs inputs() const { return {views, slots, data}; }
    };
    template <class RectOf>
    Given given(const Op& op, const RectOf& rect_of) {
        Given g;
        for (std::size_t s = 0; s < op.links.size(); ++s) {
            const Link& link = op.links[s];
            const Rect rect = link.values.empty() ? Rect{} : rect_of(static_cast<int>(s));
            g.slots.push_back({g.samples.size(), link.values.size()});
            g.data.push_back(link.datum.op < 0 ? nullptr
                                               : data_[static_cast<std::size_t>(link.datum.op)].get());
            for (const ValueRef v : link.values) g.samples.push_back(gathered(v, rect, link.window));
        }
        for (std::size_t s = 0, i = 0; s < op.links.size(); ++s)
            for (std::size_t k = 0; k < g.slots[s].count; ++k, ++i)
                g.views.push_back(g.samples[i].view(end_of_link(op, static_cast<int>(s))));
        return g;
    }

    void compute(const Op& op, std::vector<Samples>& outputs) {
        const Rect& window = op.outputs.front().window;
        const Given g = given(op, [&](int slot) { return view_of_link(op, slot, window); });
        std::vector<MutView> results;
        for (Samples& o : outputs) results.push_back(o.view(o.window));
        Scratch scratch;
        op.operation->compute(g.inputs(), results, scratch);
    }

    // A gather sees one block, which is the whole frame.
    std::shared_ptr<const Datum> datum(const Op& op) {
        const Rect& window = op.outputs.front().window;
        const Given g = given(op, [&](int) { return window; });
        if (op.derivation) return op.derivation->derive(g.inputs());
        Scratch scratch;
        const std::unique_ptr<Gather::State> state = op.gather->start(window);
        for (int round = 1;; ++round) {
            if (!window.empty())
                op.gather->fold(*state, *op.gather->map(*state, g.inputs(), window, scratch));
            if (round == op.gather->rounds()) return op.gather->finish(*state);
            op.gather->end_round(*state);
        }
    }

    std::vector<std::vector<Samples>> values_;        // by operation and output
    std::vector<std::shared_ptr<const Datum>> data_;  // by operation
};

}  // namespace

Interpretation interpret_all(const ResolvedFrame& frame) {
    Interpreter interpreter(frame);
    Interpretation out;
    for (const Sink& sink : frame.sinks) out.images.push_back(interpreter.picture(sink.request));
    out.data = interpreter.data();
    return out;
}

std::vector<Image> interpret(const ResolvedFrame& frame) { return interpret_all(frame).images; }

}  // namespace keyline::testing

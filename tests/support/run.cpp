// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/run.h"

#include "engine/node/node_adaptor.h"
#include "engine/node/registry.h"
#include "engine/plan/planner.h"
#include "engine/plan/resolve.h"
#include "engine/run/execute.h"
#include "engine/simd/half.h"

#include <cstring>
#include <fmt/format.h>
#include <mutex>

namespace keyline::testing {

namespace {

// Images that the graph of this process reads, and those that it writes.
struct Shelf {
    std::vector<Image> images;
    std::vector<Image> written;
    std::vector<std::shared_ptr<const Datum>> data;
};

Shelf& shelf() {
    static Shelf the_shelf;
    return the_shelf;
}

// An image in memory as a source, in chunks of an odd size.
class MemorySource final : public ImageSource {
public:
    explicit MemorySource(const Image& image) : image_(image) {
        header_.display_window = image.display;
        header_.data_window = image.window;
        header_.metadata = image.metadata;
        ChannelGroup group;
        group.window = image.window;
        group.chunk_width = 37;
        group.chunk_height = 11;
        for (const Image::Channel& c : image.channels) group.channels.push_back({c.name, c.type});
        header_.groups.push_back(std::move(group));
    }
    const ImageHeader& header() const override { return header_; }
    std::size_t chunk_memory(std::size_t) const override { return 0; }

    void read_chunk(std::size_t, int column, int row, std::span<const Plane> planes) const override {
        const Rect chunk = header_.groups[0].chunk(column, row);
        for (std::size_t c = 0; c < planes.size(); ++c) {
            if (!planes[c].data) continue;
            const Rect rect = intersect(chunk, planes[c].rect);
            for (int y = rect.y0; y < rect.y1; ++y) {
                const auto offset =
                    static_cast<std::ptrdiff_t>(y - image_.window.y0) * image_.window.width() + rect.x0 -
                    image_.window.x0;
                store(image_.channels[c].samples.data() + offset, planes[c].at(rect.x0, y), planes[c].type,
                      static_cast<std::size_t>(rect.width()));
            }
        }
    }

private:
    static void store(const float* from, std::byte* to, SampleType type, std::size_t n) {
        if (type == SampleType::kHalf)
            simd::float_to_half(from, reinterpret_cast<uint16_t*>(to), n);
        else if (type == SampleType::kUint)
            simd::float_to_uint(from, reinterpret_cast<uint32_t*>(to), n);
        else
            std::memcpy(to, from, n * sizeof(float));
    }

    const Image image_;
    ImageHeader header_;
};

class CaptureSink final : public ImageSink {
public:
    CaptureSink(const SinkSpec& spec, Image& image) : image_(image), channels_(spec.channels) {
        image_ = Image(spec.data_window, std::vector<std::string>{});
        image_.display = spec.display_window;
        image_.metadata = spec.metadata;
        for (ChannelInfo& c : channels_) {
            image_.channels.push_back(
                {c.name, c.type, std::vector<float>(static_cast<std::size_t>(spec.data_window.area()))});
            if (c.type != SampleType::kUint) c.type = SampleType::kFloat;
        }
    }
    Rect region() const override { return image_.window; }
    int chunk_height() const override { return 9; }
    const std::vector<ChannelInfo>& channels() const override { return channels_; }

    EncodedChunk encode(int index, std::span<const Plane> planes) const override {
        for (std::size_t c = 0; c < planes.size(); ++c) {
            const Rect& rect = planes[c].rect;
            for (int y = rect.y0; y < rect.y1; ++y)
                take(planes[c].at(rect.x0, y), planes[c].type, &image_.at(channels_[c].name, rect.x0, y),
                     static_cast<std::size_t>(rect.width()));
        }
        return {index, {}};
    }
    void commit(EncodedChunk) override {}
    void finish() override {}

private:
    static void take(const std::byte* from, SampleType type, float* to, std::size_t n) {
        if (type == SampleType::kUint)
            simd::uint_to_float(reinterpret_cast<const uint32_t*>(from), to, n);
        else
            std::memcpy(to, from, n * sizeof(float));
    }

    Image& image_;
    std::vector<ChannelInfo> channels_;
};

struct MemoryNode {
    static constexpr Info info{"memory", "An image of the test."};
    struct Params {
        std::vector<int> images;
        static constexpr auto fields =
            declare(field(&Params::images, "images", "By frame, from 0; one stands for all."));
    };
    explicit MemoryNode(const Params& p) : images(p.images) {}

    Stream read(Builder& builder) const {
        const auto last = static_cast<int>(images.size()) - 1;
        const int image =
            images[static_cast<std::size_t>(last == 0 ? 0 : std::clamp(builder.frame(), 0, last))];
        return builder.add_source(
            std::make_shared<MemorySource>(shelf().images[static_cast<std::size_t>(image)]));
    }

    const std::vector<int> images;
};

struct CaptureNode {
    static constexpr Info info{"capture", "Hands an image to the test."};
    struct Params {
        Input in;
        int place = 0;
        static constexpr auto fields =
            declare(input(&Params::in, "in", "The image."),
                    field(&Params::place, "place", "Which of the images written it is."));
    };
    explicit CaptureNode(const Params& p) : in(p.in), place(static_cast<std::size_t>(p.place)) {}

    void write(Builder& builder) const {
        SinkRequest request;
        request.stream = builder.input(in);
        request.spec.display_window = request.stream.display;
        request.spec.data_window = request.stream.window;
        request.spec.metadata = *request.stream.metadata;
        for (const StreamChannel& c : request.stream.channels)
            request.spec.channels.push_back(
                {c.name, builder.stored_type(c.value).value_or(SampleType::kFloat)});
        request.create = [place = place](const SinkSpec& spec) {
            return std::make_unique<CaptureSink>(spec, shelf().written[place]);
        };
        builder.add_sink(std::move(request));
    }

    const Input in;
    const std::size_t place;
};

class DataCapture final : public DataSink {
public:
    explicit DataCapture(std::shared_ptr<const Datum>& to) : to_(to) {}
    void write(const std::shared_ptr<const Datum>& datum) override { to_ = datum; }

private:
    std::shared_ptr<const Datum>& to_;
};

struct CaptureDataNode {
    static constexpr Info info{"capture_data", "Hands a datum to the test."};
    struct Params {
        Input in;
        int place = 0;
        static constexpr auto fields =
            declare(input(&Params::in, "in", "The datum.", any_data()),
                    field(&Params::place, "place", "Which of the data written it is."));
    };
    explicit CaptureDataNode(const Params& p) : in(p.in), place(static_cast<std::size_t>(p.place)) {}

    void write(Builder& builder) const {
        SinkRequest request;
        request.stream = builder.input(in);
        request.create_for_data = [place = place] {
            return std::make_unique<DataCapture>(shelf().data[place]);
        };
        builder.add_sink(std::move(request));
    }

    const Input in;
    const std::size_t place;
};

void register_nodes() {
    static std::once_flag once;
    std::call_once(once, [] {
        registry().add(make_node_type<MemoryNode>());
        registry().add(make_node_type<CaptureNode>());
        registry().add(make_node_type<CaptureDataNode>());
    });
}

[[noreturn]] void throw_all(const Diagnostics& diagnostics) {
    std::string all;
    for (const Error& e : diagnostics.errors()) all += e.text() + "\n";
    fail(diagnostics.errors().front().kind, all);
}

}  // namespace

ResolvedFrame resolve_graph(const Json& nodes, const std::vector<std::string>& ids, const Sequences& inputs,
                            int frame, bool leave_out_identities, const std::vector<std::string>& data_ids) {
    register_nodes();
    shelf() = {};
    shelf().written.resize(ids.size());
    shelf().data.resize(data_ids.size());
    Json all = nodes;
    for (const auto& [name, images] : inputs) {
        std::vector<Json> indices;
        for (const Image& image : images) {
            indices.emplace_back(shelf().images.size());
            shelf().images.push_back(image);
        }
        all.set(name, {{"type", "memory"}, {"images", Json::array(indices)}});
    }
    for (std::size_t i = 0; i < ids.size(); ++i)
        all.set(fmt::format("captured{}", i), {{"type", "capture"}, {"in", ids[i]}, {"place", i}});
    for (std::size_t i = 0; i < data_ids.size(); ++i)
        all.set(fmt::format("captured-data{}", i),
                {{"type", "capture_data"}, {"in", data_ids[i]}, {"place", i}});
    const Json graph{{"keyline", 1}, {"nodes", all}};
    Diagnostics diagnostics;
    const auto loaded = Graph::parse(graph.text(), "test.json", ".", {}, diagnostics);
    if (!loaded) throw_all(diagnostics);
    ResolveOptions options;
    options.leave_out_identities = leave_out_identities;
    auto resolved = resolve(*loaded, frame, options, diagnostics);
    if (!resolved) throw_all(diagnostics);
    return std::move(*resolved);
}

std::vector<Image> render(Plan plan) {
    const int threads = plan.threads;
    Executor(threads).run(std::make_unique<FrameRun>(std::move(plan)), false);
    return shelf().written;
}

std::vector<std::shared_ptr<const Datum>> rendered_data() { return shelf().data; }

Image run_graph(const Json& nodes, const std::string& id, const Sequences& inputs,
                const RunOptions& options) {
    ResolvedFrame frame = resolve_graph(nodes, {id}, inputs, options.frame);
    return render(make_plan(std::move(frame), {options.threads, options.tile, options.memory})).front();
}

Image run_graph(const Json& nodes, const std::string& id, const std::map<std::string, Image>& inputs,
                const RunOptions& options) {
    Sequences sequences;
    for (const auto& [name, image] : inputs) sequences[name] = {image};
    return run_graph(nodes, id, sequences, options);
}

Image run(const std::string& type, const Json& params, const std::map<std::string, Image>& inputs,
          const RunOptions& options) {
    Json node = params;
    node.set("type", type);
    std::map<std::string, Image> named;
    for (const auto& [port, image] : inputs) {
        node.set(port, "input-" + port);
        named["input-" + port] = image;
    }
    return run_graph({{"node", node}}, "node", named, options);
}

Image run(const std::string& type, const Json& params, const Image& in, const RunOptions& options) {
    return run(type, params, std::map<std::string, Image>{{"in", in}}, options);
}

std::string error_of(const std::string& type, const Json& params, const Image& in) {
    try {
        run(type, params, in);
        return "";
    } catch (const Failure& f) {
        return f.error().what;
    }
}

}  // namespace keyline::testing

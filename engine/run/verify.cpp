// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/run/verify.h"

#include "engine/base/byte_digest.h"
#include "engine/base/index.h"
#include "engine/json/json_reader.h"

#include <algorithm>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace keyline {

namespace {

namespace fs = std::filesystem;

// Decodes a group of channels, some rows of chunks at once.
class GroupDecoder {
public:
    GroupDecoder(const ImageSource& image, std::size_t group)
        : image_(image),
          group_(image.header().groups[group]),
          index_(group),
          hashes_(group_.channels.size()) {
        // Other formats are decoded from the top down.
        if (image.header().format == "openexr") at_once_ = kAtOnce;
    }

    // Throws Failure (kInput) for what can't be decoded.
    void run() {
        std::vector<Band> bands(index(at_once_));
        for (int first = 0; first < group_.rows(); first += at_once_) {
            const int n = std::min(at_once_, group_.rows() - first);
            tbb::parallel_for(0, n, [&](int i) { decode(first + i, bands[index(i)]); });
            for (int i = 0; i < n; ++i) hash(bands[index(i)]);
        }
    }

    void append_hashes(std::vector<ChannelHash>& out) const {
        for (std::size_t c = 0; c < hashes_.size(); ++c)
            out.push_back({group_.channels[c].name, hashes_[c].digest()});
    }

private:
    static constexpr int kAtOnce = 8;
    using Band = std::vector<std::vector<std::byte>>;  // samples by channel

    void decode(int row, Band& band) const {
        const Rect& w = group_.window;
        const int y = w.y0 + row * group_.chunk_height;
        const Rect rect = intersect(w, {w.x0, y, w.x1, y + group_.chunk_height});
        band.resize(group_.channels.size());
        std::vector<Plane> planes;
        for (std::size_t c = 0; c < band.size(); ++c) {
            const std::size_t row_bytes =
                sample_size(group_.channels[c].type) * static_cast<std::size_t>(w.width());
            band[c].resize(row_bytes * static_cast<std::size_t>(rect.height()));
            planes.push_back(
                {band[c].data(), static_cast<std::ptrdiff_t>(row_bytes), group_.channels[c].type, rect});
        }
        for (int column = 0; column < group_.columns(); ++column)
            image_.read_chunk(index_, column, row, planes);
    }

    void hash(const Band& band) {
        for (std::size_t c = 0; c < band.size(); ++c) hashes_[c].add(band[c]);
    }

    const ImageSource& image_;
    const ChannelGroup& group_;
    const std::size_t index_;
    int at_once_ = 1;
    std::vector<ByteDigester> hashes_;
};

std::vector<ChannelHash> decode_all(const fs::path& file) {
    const auto image = open_image(file);
    std::vector<ChannelHash> out;
    for (std::size_t g = 0; g < image->header().groups.size(); ++g) {
        GroupDecoder decoder(*image, g);
        decoder.run();
        decoder.append_hashes(out);
    }
    return out;
}

// What the disk says of one output.
Verdict look(const Origins& origins, const ResolvedFrame& frame, const Sink& sink) {
    Verdict out;
    out.frame = frame.frame;
    out.file = sink.request.file;
    std::error_code error;
    if (!fs::exists(out.file, error)) {
        out.state = OutputState::kMissing;
        return out;
    }
    std::optional<Value> was;
    try {
        was = read_provenance(out.file);
        // A file of data appears whole.
        if (!sink.request.stream.is_data()) out.hashes = decode_all(out.file);
    } catch (const Failure& f) {
        if (f.error().passing != Passing::kNever && f.error().passing != Passing::kUnfinished) throw;
        out.state = OutputState::kDamaged;
        out.reasons.push_back(f.error().what);
        return out;
    }
    if (!was) {
        out.state = OutputState::kForeign;
        return out;
    }
    const Origin is = origins.of(frame, sink);
    const Value* digest = was->find("digest");
    if (is.digest.known() && digest && digest->text == to_string(is.digest)) return out;
    out.state = OutputState::kStale;
    out.reasons = differences(*was, parse_json(is.text, out.file.string()));
    return out;
}

}  // namespace

std::string_view output_state_name(OutputState state) {
    switch (state) {
        case OutputState::kStale: return "stale";
        case OutputState::kForeign: return "foreign";
        case OutputState::kDamaged: return "damaged";
        case OutputState::kMissing: return "missing";
        case OutputState::kCurrent: break;
    }
    return "current";
}

void verify(const Graph& graph, const RenderOptions& options, bool with_hashes, Diagnostics& diagnostics,
            const std::function<void(const Verdict&)>& hear) {
    const auto session = options.session ? options.session : std::make_shared<Session>();
    ResolveOptions resolving;
    resolving.ocio = options.ocio.empty() ? graph.ocio() : options.ocio;
    resolving.session = session;
    const Origins origins(graph, resolving.ocio, session);
    tbb::task_arena arena(options.threads);
    for (const int frame : options.frames) {
        Diagnostics of_frame;  // its warnings are a render's
        const auto resolved = resolve(graph, frame, resolving, of_frame);
        for (const Error& e : of_frame.errors()) diagnostics.error(e);
        if (!resolved) continue;
        for (const Sink& sink : resolved->sinks) {
            Verdict verdict = arena.execute([&] { return look(origins, *resolved, sink); });
            verdict.node = graph.nodes()[index(sink.node)].id;
            if (!with_hashes) verdict.hashes.clear();
            hear(verdict);
        }
    }
}

bool is_current(const Origins& origins, const ResolvedFrame& frame, const Sink& sink) {
    return look(origins, frame, sink).state == OutputState::kCurrent;
}

}  // namespace keyline

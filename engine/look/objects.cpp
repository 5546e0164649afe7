// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/look/objects.h"

#include "engine/base/error.h"
#include "engine/kit/cryptomatte.h"
#include "engine/kit/manifest_text.h"
#include "engine/look/scan.h"
#include "engine/look/source_channels.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <tuple>

namespace keyline {

namespace {

// Names by id.
class Names {
public:
    Names(const Cryptomatte& matte, std::vector<std::string>& faults) {
        const auto text = manifest_text(*matte.info, faults);
        if (!text) return;
        const CryptomatteManifest manifest = CryptomatteManifest::parse(*text);
        if (!manifest.fault().empty()) faults.push_back("the manifest is not whole: " + manifest.fault());
        for (const auto& [name, id] : manifest.entries()) names_.try_emplace(id, name);
    }
    std::string of(uint32_t id) const {
        const auto it = names_.find(id);
        return it == names_.end() ? fmt::format("{:08x}", id) : it->second;
    }
    bool know(uint32_t id) const { return names_.contains(id); }
    std::size_t size() const { return names_.size(); }

private:
    std::map<uint32_t, std::string> names_;
};

void require_ids(const SourceChannels& channels, const Cryptomatte& matte, const Cryptomatte::Rank& rank) {
    if (channels.type(rank.id) == SampleType::kHalf)
        fail(ErrorKind::kInput,
             fmt::format("the ids of the Cryptomatte {} are stored as half, which destroys them",
                         in_quotes(matte.shown_name())),
             "write them with 32 bits");
    if (channels.place(rank.id).group != channels.place(rank.coverage).group)
        fail(ErrorKind::kInput, fmt::format("ids and coverage of the Cryptomatte {} are in different parts",
                                            in_quotes(matte.shown_name())));
}

using Visit = std::function<void(int x, int y, uint32_t id, double coverage)>;

// Every pixel of one rank in a region that shows an object.
void scan_rank(const ImageSource& source, const SourceChannels& channels, const Cryptomatte& matte,
               const Cryptomatte::Rank& rank, const Rect& region, const Visit& visit) {
    require_ids(channels, matte, rank);
    const SourceChannels::Place id = channels.place(rank.id), coverage = channels.place(rank.coverage);
    std::vector<bool> wanted(source.header().groups[id.group].channels.size());
    wanted[id.channel] = wanted[coverage.channel] = true;
    std::vector<uint32_t> ids;
    std::vector<double> covers;
    scan(source, id.group, wanted, region, [&](const ScannedChunk& chunk) {
        for (int y = chunk.rect.y0; y < chunk.rect.y1; ++y) {
            bits_of(chunk.planes[id.channel], y, ids);
            row_of(chunk.planes[coverage.channel], y, covers);
            for (std::size_t i = 0; i < ids.size(); ++i)
                if (covers[i] > 0) visit(chunk.rect.x0 + static_cast<int>(i), y, ids[i], covers[i]);
        }
    });
}

SeenCryptomatte look_at(const ImageSource& source, const SourceChannels& channels, const Cryptomatte& matte) {
    SeenCryptomatte out{matte.shown_name(), {}, 0, {}};
    const Names names(matte, out.faults);
    std::map<uint32_t, SeenObject> seen;
    for (const Cryptomatte::Rank& rank : matte.ranks)
        scan_rank(source, channels, matte, rank, source.header().data_window,
                  [&](int x, int y, uint32_t id, double coverage) {
                      SeenObject& object = seen[id];
                      ++object.pixels;
                      object.area += coverage;
                      object.window = unite(object.window, {x, y, x + 1, y + 1});
                  });
    out.unseen = names.size();
    for (auto& [id, object] : seen) {
        object.id = id;
        object.name = names.of(id);
        if (names.know(id)) --out.unseen;
        out.objects.push_back(std::move(object));
    }
    std::ranges::sort(out.objects, {},
                      [](const SeenObject& o) { return std::tuple(-o.pixels, o.name, o.id); });
    return out;
}

}  // namespace

std::vector<SeenCryptomatte> objects_of(const ImageSource& source) {
    const SourceChannels channels(source);
    std::vector<SeenCryptomatte> out;
    for (const Cryptomatte& matte : cryptomattes_of(channels.stream))
        out.push_back(look_at(source, channels, matte));
    return out;
}

Pixel pixel_of(const ImageSource& source, int x, int y) {
    const SourceChannels channels(source);
    const Rect one{x, y, x + 1, y + 1};
    Pixel out;
    std::vector<double> row;
    for (std::size_t g = 0; g < source.header().groups.size(); ++g) {
        const ChannelGroup& group = source.header().groups[g];
        const std::size_t first = out.samples.size();
        for (const ChannelInfo& c : group.channels)
            out.samples.push_back({c.name, c.type, 0, group.window.contains(x, y)});
        const std::vector<bool> all(group.channels.size(), true);
        scan(source, g, all, one, [&](const ScannedChunk& chunk) {
            for (std::size_t c = 0; c < chunk.planes.size(); ++c)
                out.samples[first + c].value = row_of(chunk.planes[c], y, row)[0];
        });
    }
    for (const Cryptomatte& matte : cryptomattes_of(channels.stream)) {
        std::vector<std::string> faults;
        const Names names(matte, faults);
        for (const Cryptomatte::Rank& rank : matte.ranks)
            scan_rank(source, channels, matte, rank, one, [&](int, int, uint32_t id, double coverage) {
                out.objects.push_back({matte.shown_name(), names.of(id), coverage});
            });
    }
    return out;
}

}  // namespace keyline

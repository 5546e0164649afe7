// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/wanted_objects.h"

#include "engine/base/channels.h"
#include "engine/node/node_adaptor.h"

#include <algorithm>
#include <fmt/format.h>

namespace keyline {

namespace {

void refuse_unknown(Builder& builder, const CryptomatteManifest& manifest, const std::string& object) {
    std::string near = did_you_mean(object, manifest.names());
    builder.bad_parameter(
        "objects",
        fmt::format("none of the {} objects of the Cryptomatte is {}", manifest.size(), in_quotes(object)),
        near.empty() ? "there are " + some_of(manifest.names()) : near);
}

std::vector<WantedObject> objects_of(Builder& builder,
                                     const std::shared_ptr<const CryptomatteManifest>& manifest,
                                     const std::string& object) {
    std::vector<WantedObject> listed;
    if (manifest)
        for (const uint32_t id : manifest->ids(object)) listed.push_back({id, {}});
    if (!listed.empty()) return listed;
    const bool whole = manifest && manifest->fault().empty();
    if (whole || (manifest && has_wildcard(object))) refuse_unknown(builder, *manifest, object);
    if (has_wildcard(object))
        builder.bad_parameter("objects",
                              fmt::format("the input has no manifest to look {} up in", in_quotes(object)),
                              "give whole names, and \\* for a star that belongs to one");
    builder.warn(fmt::format("{} is not in the manifest; it is looked for by its hash, unchecked",
                             in_quotes(literal_name(object))));
    return {{cryptomatte_id(literal_name(object)), literal_name(object)}};
}

}  // namespace

std::vector<WantedObject> wanted_objects(Builder& builder,
                                         const std::shared_ptr<const CryptomatteManifest>& manifest,
                                         const std::vector<std::string>& patterns) {
    std::vector<WantedObject> out;
    for (const std::string& object : patterns) {
        const auto found = objects_of(builder, manifest, object);
        out.insert(out.end(), found.begin(), found.end());
    }
    std::ranges::sort(out);  // of one id, first the one that is known to be there
    const auto is_same = [](const WantedObject& a, const WantedObject& b) { return a.id == b.id; };
    out.erase(std::unique(out.begin(), out.end(), is_same), out.end());
    return out;
}

}  // namespace keyline

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan/stream_digest.h"

#include <concepts>
#include <string_view>
#include <variant>

namespace keyline {

Digest digest_of(const Stream& stream, const Digest& metadata, const std::vector<Digest>& values) {
    Digester digester("stream");
    for (const Rect& r : {stream.display, stream.window}) digester.add(r.x0).add(r.y0).add(r.x1).add(r.y1);
    for (const StreamChannel& c : stream.channels) {
        digester.add(c.name).add(static_cast<int>(c.holds)).add(c.integer);
        if (c.cryptomatte) digester.add(c.cryptomatte->layers).add(c.cryptomatte->levels).add(c.place);
    }
    for (const Digest& value : values) digester.add(value);
    return digester.add(stream.data).add(metadata).digest();
}

Digest digest_of(const Metadata& metadata) {
    Digester digester("metadata");
    const auto add = [&]<class T>(const T& value) {
        if constexpr (std::same_as<T, std::string>)
            digester.add(value);
        else if constexpr (std::same_as<T, std::vector<std::string>>)
            for (const std::string& s : value) digester.add(s);
        else if constexpr (std::same_as<T, std::vector<std::byte>>)
            digester.add(std::string_view(reinterpret_cast<const char*>(value.data()), value.size()));
        else if constexpr (std::same_as<T, std::vector<int32_t>>)
            for (const int32_t i : value) digester.add(i);
        else
            for (const auto f : value) digester.add(static_cast<double>(f));
    };
    for (const Attribute& a : metadata.attributes()) {
        digester.add(a.name).add(a.type);
        std::visit(add, a.value);
    }
    return digester.digest();
}

}  // namespace keyline

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/oiio/picture_tasks.h"

#include "engine/io/helper/message.h"

#include <stdexcept>

namespace keyline::oiio {

namespace {

void put_texts(MessageWriter& out, const std::vector<std::string>& texts) {
    out.put(uint64_t{texts.size()});
    for (const std::string& text : texts) out.put_text(text);
}

std::vector<std::string> get_texts(MessageReader& in) {
    std::vector<std::string> texts;
    for (auto n = in.get<uint64_t>(); n > 0; --n) texts.push_back(in.get_text());
    return texts;
}

void put_value(MessageWriter& out, const Attribute::Value& value) {
    out.put(uint64_t{value.index()});
    std::visit(
        [&]<class T>(const T& v) {
            if constexpr (std::is_same_v<T, std::string>)
                out.put_text(v);
            else if constexpr (std::is_same_v<T, std::vector<std::string>>)
                put_texts(out, v);
            else
                out.put(v);
        },
        value);
}

Attribute::Value get_value(MessageReader& in) {
    switch (in.get<uint64_t>()) {
        case 0: return in.get_text();
        case 1: return get_texts(in);
        case 2: return in.get_all<int32_t>();
        case 3: return in.get_all<float>();
        case 4: return in.get_all<double>();
        case 5: return in.get_all<std::byte>();
        default: throw std::runtime_error("an attribute of no known kind");
    }
}

void put_metadata(MessageWriter& out, const Metadata& metadata) {
    out.put(uint64_t{metadata.attributes().size()});
    for (const Attribute& a : metadata.attributes()) {
        out.put_text(a.name).put_text(a.type);
        put_value(out, a.value);
    }
}

Metadata get_metadata(MessageReader& in) {
    Metadata metadata;
    for (auto n = in.get<uint64_t>(); n > 0; --n) {
        Attribute a{in.get_text(), {}, {}};
        a.type = in.get_text();
        a.value = get_value(in);
        metadata.set(std::move(a));
    }
    return metadata;
}

Sample get_sample(MessageReader& in) {
    const auto sample = in.get<Sample>();
    if (sample > Sample::kFloat) throw std::runtime_error("samples of no known kind");
    return sample;
}

}  // namespace

std::size_t sample_bytes(Sample sample) {
    return sample == Sample::kUint8 ? 1 : sample == Sample::kFloat ? 4 : 2;
}

std::vector<std::byte> PictureRequest::bytes() const {
    return MessageWriter().put_text(file).put_text(part).put(to_be_read).bytes();
}

PictureRequest PictureRequest::from(std::span<const std::byte> bytes) {
    MessageReader in(bytes);
    PictureRequest r;
    r.file = in.get_text();
    r.part = in.get_text();
    r.to_be_read = in.get<uint8_t>() != 0;
    return r;
}

std::vector<std::byte> PictureHeader::bytes() const {
    MessageWriter out;
    out.put_text(format).put(x).put(y).put(width).put(height);
    out.put(full_x).put(full_y).put(full_width).put(full_height);
    out.put(depth).put(tile_height).put(strip_rows).put(alpha).put(is_deep).put(sample);
    put_texts(out, channels);
    put_texts(out, types);
    put_metadata(out, metadata);
    return out.bytes();
}

PictureHeader PictureHeader::from(std::span<const std::byte> bytes) {
    MessageReader in(bytes);
    PictureHeader h;
    h.format = in.get_text();
    for (int32_t* number : {&h.x, &h.y, &h.width, &h.height, &h.full_x, &h.full_y, &h.full_width,
                            &h.full_height, &h.depth, &h.tile_height, &h.strip_rows, &h.alpha})
        *number = in.get<int32_t>();
    h.is_deep = in.get<uint8_t>() != 0;
    h.sample = get_sample(in);
    h.channels = get_texts(in);
    h.types = get_texts(in);
    h.metadata = get_metadata(in);
    return h;
}

std::vector<std::byte> PictureSpec::bytes() const {
    MessageWriter out;
    out.put_text(file).put_text(format).put(width).put(height).put(alpha).put(is_straight).put(tile_size);
    out.put(sample);
    put_texts(out, channels);
    out.put_text(compression);
    put_metadata(out, metadata);
    return out.bytes();
}

PictureSpec PictureSpec::from(std::span<const std::byte> bytes) {
    MessageReader in(bytes);
    PictureSpec s;
    s.file = in.get_text();
    s.format = in.get_text();
    s.width = in.get<int32_t>();
    s.height = in.get<int32_t>();
    s.alpha = in.get<int32_t>();
    s.is_straight = in.get<uint8_t>() != 0;
    s.tile_size = in.get<int32_t>();
    s.sample = get_sample(in);
    s.channels = get_texts(in);
    s.compression = in.get_text();
    s.metadata = get_metadata(in);
    return s;
}

// Some readers hold the whole file and the whole picture, one beside the other and once more as they came.
HelperBounds bounds_of(uint64_t file_bytes, uint64_t bytes) {
    const uint64_t all = file_bytes + bytes;
    return {(uint64_t{384} << 20) + 4 * all, 8 + (all >> 22), uint64_t{256} << 20};
}

}  // namespace keyline::oiio

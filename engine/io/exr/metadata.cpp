// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/exr/metadata.h"

#include "engine/base/error.h"
#include "engine/io/exr/format.h"
#include "engine/io/system_call.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <utility>

namespace keyline::exr {

namespace {

// Far above what productions store (Cryptomatte manifests of some megabytes), far below what hurts.
constexpr std::size_t kMostHeaderBytes = std::size_t{64} << 20;
constexpr std::size_t kMostAttributes = 20000;

enum class Element { kInt, kFloat, kDouble };

struct NumericType {
    std::string_view name;
    Element element;
    std::size_t count;  // 0: any
};

constexpr std::array<NumericType, 20> kNumericTypes = {{
    {"int", Element::kInt, 1},       {"v2i", Element::kInt, 2},      {"v3i", Element::kInt, 3},
    {"box2i", Element::kInt, 4},     {"rational", Element::kInt, 2}, {"timecode", Element::kInt, 2},
    {"keycode", Element::kInt, 7},   {"float", Element::kFloat, 1},  {"v2f", Element::kFloat, 2},
    {"v3f", Element::kFloat, 3},     {"box2f", Element::kFloat, 4},  {"chromaticities", Element::kFloat, 8},
    {"m33f", Element::kFloat, 9},    {"m44f", Element::kFloat, 16},  {"floatvector", Element::kFloat, 0},
    {"double", Element::kDouble, 1}, {"v2d", Element::kDouble, 2},   {"v3d", Element::kDouble, 3},
    {"m33d", Element::kDouble, 9},   {"m44d", Element::kDouble, 16},
}};

const NumericType* numeric_type(std::string_view name) {
    const auto* const found = std::ranges::find(kNumericTypes, name, &NumericType::name);
    return found == kNumericTypes.end() ? nullptr : found;
}

// Whether `bytes` is a whole number of elements, and the number that the type wants.
template <class T>
std::optional<Attribute::Value> numbers(std::span<const std::byte> bytes, std::size_t count) {
    if (bytes.size() % sizeof(T) != 0 || (count != 0 && bytes.size() != count * sizeof(T))) return {};
    std::vector<T> values(bytes.size() / sizeof(T));
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}

std::string text(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::optional<Attribute::Value> strings(std::span<const std::byte> bytes) {
    std::vector<std::string> values;
    while (!bytes.empty()) {
        if (bytes.size() < 4) return {};
        const auto length = get<uint32_t>(bytes);
        bytes = bytes.subspan(4);
        if (length > bytes.size()) return {};
        values.push_back(text(bytes.first(length)));
        bytes = bytes.subspan(length);
    }
    return values;
}

// Nothing where the bytes can't be a value of the type.
std::optional<Attribute::Value> parsed_value(std::string_view type, std::span<const std::byte> bytes) {
    if (type == "string") return text(bytes);
    if (type == "stringvector") return strings(bytes);
    const NumericType* numeric = numeric_type(type);
    if (numeric == nullptr) return std::vector<std::byte>(bytes.begin(), bytes.end());
    switch (numeric->element) {
        case Element::kInt: return numbers<int32_t>(bytes, numeric->count);
        case Element::kFloat: return numbers<float>(bytes, numeric->count);
        default: return numbers<double>(bytes, numeric->count);
    }
}

// Reads a header from front to back, a block at a time.
class HeaderReader {
public:
    explicit HeaderReader(const InputFile& file) : file_(file) {}

    std::span<const std::byte> take(std::size_t n) {
        if (position_ + n > kMostHeaderBytes) damaged("it does not end");
        if (position_ + n > file_.size())
            fail(ErrorKind::kInput,
                 fmt::format("{}: the file is not finished: its header does not end", file_.name()),
                 kUnfinishedHint, Passing::kUnfinished);
        fetch(position_ + n);
        position_ += n;
        return std::span(bytes_).subspan(position_ - n, n);
    }

    std::string take_name() {
        std::string name;
        while (const auto c = get<char>(take(1))) {
            name += c;
            if (name.size() > kLongestName) damaged(fmt::format("a name at byte {} does not end", position_));
        }
        return name;
    }

    Attribute take_attribute(std::string name) {
        if (++attributes_ > kMostAttributes) damaged(fmt::format("more than {} attributes", kMostAttributes));
        Attribute attribute{std::move(name), take_name(), {}};
        const auto size = get<int32_t>(take(4));
        if (size < 0) damaged(fmt::format("attribute {} has size {}", in_quotes(attribute.name), size));
        auto value = parsed_value(attribute.type, take(static_cast<std::size_t>(size)));
        if (!value)
            damaged(fmt::format("attribute {} has {} bytes, which no {} has", in_quotes(attribute.name), size,
                                in_quotes(attribute.type)));
        attribute.value = std::move(*value);
        return attribute;
    }

    [[noreturn]] void damaged(const std::string& why) const {
        fail(ErrorKind::kInput, fmt::format("{}: damaged header: {}", file_.name(), why));
    }

    uint64_t position() const { return position_; }

private:
    void fetch(std::size_t end) {
        if (end <= bytes_.size()) return;
        const std::size_t old = bytes_.size();
        const std::size_t wanted = std::max(end, old + (std::size_t{1} << 16));
        bytes_.resize(static_cast<std::size_t>(std::min<uint64_t>(wanted, file_.size())));
        file_.read(old, std::span(bytes_).subspan(old));
    }

    const InputFile& file_;
    std::vector<std::byte> bytes_;
    std::size_t position_ = 0, attributes_ = 0;
};

void append_value(std::vector<std::byte>& out, const std::string& value) { append(out, value); }

void append_value(std::vector<std::byte>& out, const std::vector<std::string>& values) {
    for (const std::string& value : values) {
        append(out, static_cast<uint32_t>(value.size()));
        append(out, value);
    }
}

template <class T>
void append_value(std::vector<std::byte>& out, const std::vector<T>& values) {
    const auto bytes = std::as_bytes(std::span(values));
    out.insert(out.end(), bytes.begin(), bytes.end());
}

}  // namespace

std::vector<std::vector<Attribute>> read_attributes(const InputFile& file, uint64_t* end) {
    HeaderReader reader(file);
    reader.take(kMagic.size());
    const bool multipart = (get<uint32_t>(reader.take(4)) & kMultipartFlag) != 0;
    std::vector<std::vector<Attribute>> parts;
    std::string name = reader.take_name();
    do {
        std::vector<Attribute>& attributes = parts.emplace_back();
        for (; !name.empty(); name = reader.take_name())
            attributes.push_back(reader.take_attribute(std::move(name)));
        if (multipart) name = reader.take_name();
    } while (!name.empty());
    if (end) *end = reader.position();
    return parts;
}

bool describes_storage(std::string_view name) {
    static constexpr std::array<std::string_view, 16> kStorage = {"channels",      "chunkCount",
                                                                  "compression",   "dataWindow",
                                                                  "displayWindow", "dwaCompressionLevel",
                                                                  "lineOrder",     "maxSamplesPerPixel",
                                                                  "multiView",     "name",
                                                                  "preview",       "tiles",
                                                                  "type",          "version",
                                                                  "view",          "deepImageState"};
    return std::ranges::find(kStorage, name) != kStorage.end();
}

std::optional<std::string> text_of(std::span<const Attribute> attributes, std::string_view name) {
    const auto found = std::ranges::find(attributes, name, &Attribute::name);
    if (found == attributes.end()) return {};
    const auto* value = std::get_if<std::string>(&found->value);
    return value == nullptr ? std::nullopt : std::optional(*value);
}

std::vector<std::byte> stored_value(const Attribute& attribute) {
    std::vector<std::byte> bytes;
    std::visit([&](const auto& value) { append_value(bytes, value); }, attribute.value);
    const auto read_back = parsed_value(attribute.type, bytes);
    if (!read_back || read_back->index() != attribute.value.index())
        fail(ErrorKind::kOutput,
             fmt::format("attribute {} has {} bytes, which no {} has", in_quotes(attribute.name),
                         bytes.size(), in_quotes(attribute.type)));
    return bytes;
}

void append_attribute(std::vector<std::byte>& header, const Attribute& attribute) {
    const std::vector<std::byte> value = stored_value(attribute);
    append(header, attribute.name);
    append(header, '\0');
    append(header, attribute.type);
    append(header, '\0');
    append(header, static_cast<int32_t>(value.size()));
    header.insert(header.end(), value.begin(), value.end());
}

}  // namespace keyline::exr

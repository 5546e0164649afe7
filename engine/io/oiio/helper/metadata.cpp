// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/oiio/helper/metadata.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

namespace keyline::oiio {

namespace {

using OIIO::ParamValue;
using OIIO::TypeDesc;

// OpenImageIO's name, OpenEXR's.
constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kNames = {{
    {"Copyright", "owner"},
    {"DateTime", "capDate"},
    {"ExposureTime", "expTime"},
    {"FNumber", "aperture"},
    {"FramesPerSecond", "framesPerSecond"},
    {"ImageDescription", "comments"},
    {"PixelAspectRatio", "pixelAspectRatio"},
}};

constexpr std::array<std::string_view, 4> kStoragePrefixes = {"oiio:", "tiff:", "png:", "thumbnail_"};
constexpr std::array<std::string_view, 6> kStorageNames = {
    "compression", "CompressionQuality", "planarconfig", "jpeg:subsampling", "PixelDensity", "gif:LoopCount"};

bool is_storage(std::string_view name) {
    return std::ranges::any_of(kStoragePrefixes, [&](auto prefix) { return name.starts_with(prefix); }) ||
           std::ranges::any_of(kStorageNames, [&](auto word) { return OIIO::Strutil::iequals(name, word); });
}

// What writers without a clock put in where they must put in something.
bool is_no_date(const ParamValue& p) {
    return p.name() == "DateTime" && p.type() == OIIO::TypeString && p.get_string() == "1970:01:01 00:00:00";
}

struct NumericType {
    std::string_view name;  // OpenEXR's
    TypeDesc type;
};

const std::array<NumericType, 19>& numeric_types() {
    static const std::array<NumericType, 19> types = {{
        {"int", TypeDesc::INT},
        {"float", TypeDesc::FLOAT},
        {"double", TypeDesc::DOUBLE},
        {"timecode", OIIO::TypeTimeCode},
        {"keycode", OIIO::TypeKeyCode},
        {"rational", OIIO::TypeRational},
        {"v2i", {TypeDesc::INT, TypeDesc::VEC2}},
        {"v3i", {TypeDesc::INT, TypeDesc::VEC3}},
        {"v2f", {TypeDesc::FLOAT, TypeDesc::VEC2}},
        {"v3f", {TypeDesc::FLOAT, TypeDesc::VEC3}},
        {"v2d", {TypeDesc::DOUBLE, TypeDesc::VEC2}},
        {"v3d", {TypeDesc::DOUBLE, TypeDesc::VEC3}},
        {"m33f", {TypeDesc::FLOAT, TypeDesc::MATRIX33}},
        {"m44f", {TypeDesc::FLOAT, TypeDesc::MATRIX44}},
        {"m33d", {TypeDesc::DOUBLE, TypeDesc::MATRIX33}},
        {"m44d", {TypeDesc::DOUBLE, TypeDesc::MATRIX44}},
        {"chromaticities", {TypeDesc::FLOAT, TypeDesc::SCALAR, TypeDesc::NOSEMANTICS, 8}},
        {"box2i", {TypeDesc::INT, TypeDesc::VEC2, TypeDesc::BOX, 2}},
        {"box2f", {TypeDesc::FLOAT, TypeDesc::VEC2, TypeDesc::BOX, 2}},
    }};
    return types;
}

template <class T>
std::vector<T> numbers(const ParamValue& p) {
    std::vector<T> out(static_cast<std::size_t>(p.datasize()) / sizeof(T));
    std::memcpy(out.data(), p.data(), out.size() * sizeof(T));
    return out;
}

Attribute::Value value_of(const ParamValue& p) {
    switch (p.type().basetype) {
        case TypeDesc::FLOAT: return numbers<float>(p);
        case TypeDesc::DOUBLE: return numbers<double>(p);
        default: return numbers<std::int32_t>(p);
    }
}

// The type's name where OpenEXR has the type, with vectors of any meaning alike; else "".
std::string_view numeric_name(const ParamValue& p) {
    const TypeDesc type = p.type();
    if (type == OIIO::TypeUInt && p.get_int() >= 0) return "int";
    if (type.basetype == TypeDesc::FLOAT && type.arraylen == 8)
        return p.name() == "chromaticities" ? "chromaticities" : "floatvector";
    for (const NumericType& known : numeric_types()) {
        const bool vector = known.type.aggregate != TypeDesc::SCALAR && known.type.arraylen == 0 &&
                            known.type.vecsemantics == TypeDesc::NOSEMANTICS;
        if (vector ? known.type.basetype == type.basetype && known.type.aggregate == type.aggregate &&
                         type.arraylen == 0 && type.vecsemantics != TypeDesc::RATIONAL
                   : known.type == type)
            return known.name;
    }
    return type.basetype == TypeDesc::FLOAT ? "floatvector" : "";
}

Attribute attribute_of(const ParamValue& p) {
    std::string name = p.name().string();
    const auto* const known =
        std::ranges::find(kNames, name, &std::pair<std::string_view, std::string_view>::first);
    if (known != kNames.end()) name = known->second;
    const auto elements = static_cast<std::size_t>(p.nvalues() * std::max(1, p.type().arraylen));
    if (p.type().basetype == TypeDesc::STRING && elements == 1) return {name, "string", p.get_string()};
    if (p.type().basetype == TypeDesc::STRING) {
        std::vector<std::string> strings;
        for (std::size_t i = 0; i < elements; ++i)
            strings.push_back(p.get_string_indexed(static_cast<int>(i)));
        return {name, "stringvector", std::move(strings)};
    }
    if (const std::string_view type = numeric_name(p); !type.empty() && p.nvalues() == 1)
        return {name, std::string(type), value_of(p)};
    return {name, p.type().c_str(), numbers<std::byte>(p)};
}

// What can go into an OpenImageIO attribute of the same meaning; UNKNOWN where nothing can.
TypeDesc type_of(const Attribute& attribute, std::size_t bytes) {
    for (const NumericType& known : numeric_types())
        if (known.name == attribute.type && known.type.size() == bytes) return known.type;
    if (attribute.type == "floatvector" && bytes > 0)
        return {TypeDesc::FLOAT, TypeDesc::SCALAR, TypeDesc::NOSEMANTICS,
                static_cast<int>(bytes / sizeof(float))};
    const TypeDesc written(attribute.type);
    return written.basetype != TypeDesc::STRING && written.size() == bytes ? written : TypeDesc();
}

struct SetAttribute {
    OIIO::ImageSpec& spec;
    const std::string& name;
    const Attribute& attribute;

    void operator()(const std::string& text) const { spec.attribute(name, text); }
    void operator()(const std::vector<std::string>& texts) const {
        const std::vector<OIIO::ustring> strings(texts.begin(), texts.end());
        const TypeDesc type(TypeDesc::STRING, TypeDesc::SCALAR, TypeDesc::NOSEMANTICS,
                            static_cast<int>(strings.size()));
        if (!strings.empty()) spec.attribute(name, type, strings.data());
    }
    template <class T>
    void operator()(const std::vector<T>& values) const {
        const TypeDesc type = type_of(attribute, values.size() * sizeof(T));
        if (type.basetype != TypeDesc::UNKNOWN && !values.empty()) spec.attribute(name, type, values.data());
    }
};

}  // namespace

Metadata metadata_of(const OIIO::ImageSpec& spec) {
    Metadata metadata;
    for (const ParamValue& p : spec.extra_attribs)
        if (!is_storage(p.name().string()) && !is_no_date(p)) metadata.set(attribute_of(p));
    return metadata;
}

void set_metadata(OIIO::ImageSpec& spec, const Metadata& metadata) {
    for (const Attribute& attribute : metadata.attributes()) {
        if (is_storage(attribute.name)) continue;
        const auto* const known =
            std::ranges::find(kNames, attribute.name, &std::pair<std::string_view, std::string_view>::second);
        const std::string name(known != kNames.end() ? known->first : attribute.name);
        std::visit(SetAttribute{spec, name, attribute}, attribute.value);
    }
}

}  // namespace keyline::oiio

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <concepts>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

// Values of a frame that are not pixels: numbers, strokes, a mesh, a camera.
//
// A kind of data is a plain struct that says what it is called, how large it is and whether it is the same as
// another:
//
//     struct Numbers {
//         static constexpr const char* kind = "numbers";
//         std::vector<double> values;
//         std::size_t bytes() const { return values.size() * sizeof(double); }
//         friend bool operator==(const Numbers&, const Numbers&) = default;
//     };
//
// It may have parts, which a link picks by their names as it does a layer of pixels, "lines:outline":
//
//     static std::vector<std::string> part_names();
//     static std::size_t usual_bytes();             // upper bound of the usual frame's, for the planner
//     Numbers part(std::size_t which) const;
//
// Two data that compare equal must be equal to whoever reads them: it is how tests see that one does not
// depend on tiles and threads.

namespace KEYLINE_API keyline {

template <class T>
concept DataKind = std::equality_comparable<T> && requires(const T& t) {
    { T::kind } -> std::convertible_to<const char*>;
    { t.bytes() } -> std::convertible_to<std::size_t>;
};

// One value of some kind: made once a frame, never changed, and shared by all that read it.
class Datum {
public:
    virtual ~Datum() = default;
    virtual const char* kind() const = 0;
    virtual std::size_t bytes() const = 0;
    virtual bool equals(const Datum& other) const = 0;
};

template <DataKind T>
class DatumOf final : public Datum {
public:
    explicit DatumOf(T v) : value(std::move(v)) {}
    const char* kind() const override { return T::kind; }
    std::size_t bytes() const override { return sizeof(*this) + value.bytes(); }
    bool equals(const Datum& other) const override {
        const auto* same_kind = dynamic_cast<const DatumOf*>(&other);
        return same_kind && same_kind->value == value;
    }

    const T value;
};

template <DataKind T>
std::shared_ptr<const Datum> make_datum(T value) {
    return std::make_shared<const DatumOf<T>>(std::move(value));
}

// Throws std::bad_cast for a datum of another kind: links are checked when a graph is loaded, so that only
// two structs of one name come to that.
template <DataKind T>
const T& datum_as(const Datum& datum) {
    return dynamic_cast<const DatumOf<T>&>(datum).value;
}

// The parts of a kind of data.
struct DataParts {
    std::vector<std::string> names;
    std::size_t usual_bytes = 0;
    std::shared_ptr<const Datum> (*pick)(const Datum& whole, std::size_t which) = nullptr;
};

// Null where there are none.
template <DataKind T>
const DataParts* parts_of() {
    if constexpr (requires { T::part_names(); }) {
        static const DataParts parts{
            T::part_names(), T::usual_bytes(),
            [](const Datum& whole, std::size_t which) { return make_datum(datum_as<T>(whole).part(which)); }};
        return &parts;
    } else {
        return nullptr;
    }
}

}  // namespace keyline

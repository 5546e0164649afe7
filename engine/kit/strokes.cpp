// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/strokes.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace keyline {

namespace {

template <class E>
const char* find_word(E value) {
    for (const auto& w : words(E{}))
        if (w.value == value) return w.word;
    return "";
}

auto place(const StrokeVertex& v) { return std::tuple(v.y, v.x); }

double distance(const StrokeVertex& a, const StrokeVertex& b) {
    const double x = b.x - a.x, y = b.y - a.y;
    return std::sqrt(x * x + y * y);
}

auto numbers(const StrokeVertex& v) {
    static_assert(sizeof(StrokeVertex) == StrokeVertex::kNumbers * sizeof(double));
    return std::bit_cast<std::array<double, StrokeVertex::kNumbers>>(v);
}

bool comes_before(const Stroke& a, const Stroke& b) {
    const auto head = [](const Stroke& s) {
        return std::tuple(s.kind, s.near, s.far, place(s.vertices.front()), s.closed, s.vertices.size());
    };
    if (head(a) != head(b)) return head(a) < head(b);
    for (std::size_t i = 0; i < a.vertices.size(); ++i) {
        const auto of_a = numbers(a.vertices[i]), of_b = numbers(b.vertices[i]);
        if (of_a != of_b) return of_a < of_b;
    }
    return false;
}

void begin_at_the_top(Stroke& stroke) {
    const auto top = std::ranges::min_element(stroke.vertices, {}, place);
    std::rotate(stroke.vertices.begin(), top, stroke.vertices.end());
}

}  // namespace

const char* word_of(StrokeKind kind) { return find_word(kind); }
const char* word_of(StrokeEnd end) { return find_word(end); }
const char* word_of(StrokeAnchor anchor) { return find_word(anchor); }

std::size_t Strokes::bytes() const {
    constexpr std::size_t kNode = 4 * sizeof(void*);  // what a map keeps beside an entry
    std::size_t sum = strokes.size() * sizeof(Stroke);
    for (const Stroke& s : strokes) sum += s.vertices.size() * sizeof(StrokeVertex);
    for (const auto& [id, name] : names) sum += kNode + sizeof(id) + sizeof(name) + name.size();
    return sum;
}

std::vector<std::string> Strokes::part_names() {
    std::vector<std::string> names;
    for (const auto& word : words(StrokeKind{})) names.emplace_back(word.word);
    return names;
}

std::size_t Strokes::usual_bytes() { return kUsualStrokes; }

Strokes Strokes::part(std::size_t which) const {
    Strokes out{display, window, names, {}};
    std::ranges::copy_if(strokes, std::back_inserter(out.strokes),
                         [&](const Stroke& s) { return s.kind == words(StrokeKind{})[which].value; });
    arrange(out);
    return out;
}

double length_of(const Stroke& stroke) {
    const std::vector<StrokeVertex>& v = stroke.vertices;
    double sum = 0;
    for (std::size_t i = 1; i < v.size(); ++i) sum += distance(v[i - 1], v[i]);
    if (stroke.closed && !v.empty()) sum += distance(v.back(), v.front());
    return sum;
}

void measure(Stroke& stroke) {
    const double length = length_of(stroke);
    double arc = 0;
    for (std::size_t i = 0; i < stroke.vertices.size(); ++i) {
        StrokeVertex& v = stroke.vertices[i];
        if (i > 0) arc += distance(stroke.vertices[i - 1], v);
        v.arc = arc;
        v.u = length > 0 ? arc / length : 0;
    }
}

void arrange(Strokes& strokes) {
    std::erase_if(strokes.strokes, [](const Stroke& s) { return s.vertices.size() < 2; });
    std::set<uint32_t> owners;
    for (Stroke& s : strokes.strokes) {
        if (s.closed) begin_at_the_top(s);
        measure(s);
        owners.insert({s.near, s.far});
    }
    std::erase_if(strokes.names, [&](const auto& entry) { return !owners.contains(entry.first); });
    std::ranges::stable_sort(strokes.strokes, comes_before);
}

}  // namespace keyline

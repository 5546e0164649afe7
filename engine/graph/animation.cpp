// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/animation.h"

#include "engine/expr/functions.h"
#include "engine/graph/graph_error.h"
#include "engine/json/make_value.h"
#include "engine/params/colour_text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string>
#include <vector>

namespace keyline {

namespace {

using Kind = Value::Kind;

struct Key {
    double frame = 0;
    const Value* value = nullptr;
    const Value* mode = nullptr;  // null: linear where that is possible

    bool is(std::string_view word) const { return mode && mode->text == word; }
};

// Reads the form, whatever the values are.
class Reader {
public:
    explicit Reader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

    bool read(const Value& animation) {
        for (const Member& m : animation.members) {
            if (m.key == "keys")
                read_keys(m.value);
            else if (m.key == "on")
                read_on(m.value);
            else if (m.key == "before" || m.key == "after")
                one_of(m.value, in_quotes(m.key), {"hold", "loop", "extend"});
            else
                refuse_key(m);
        }
        return is_sound_;
    }

    std::vector<Key> keys;
    double on = 1;

private:
    void refuse(const Place& place, std::string what, std::string hint = {}) {
        graph_error(diagnostics_, place, std::move(what), std::move(hint));
        is_sound_ = false;
    }

    void refuse_key(const Member& m) {
        static const std::vector<std::string> kKnown{"keys", "before", "after", "on"};
        const std::string hint = did_you_mean(m.key, kKnown);
        refuse(m.key_place, "unknown key " + in_quotes(m.key),
               hint.empty() ? "what moves has " + listed(kKnown) : hint);
    }

    void one_of(const Value& value, std::string_view name, const std::vector<std::string>& words) {
        if (value.is(Kind::kString) && std::ranges::find(words, value.text) != words.end()) return;
        refuse(value.place, fmt::format("{} is {}; it must be one of {}", name, value.shown(), listed(words)),
               value.is(Kind::kString) ? did_you_mean(value.text, words) : "");
    }

    void read_on(const Value& value) {
        if (value.is(Kind::kNumber) && value.number >= 1 && value.number == std::floor(value.number))
            on = value.number;
        else
            refuse(value.place,
                   fmt::format("'on' is {}; it must be a whole number of frames", value.shown()));
    }

    void read_keys(const Value& list) {
        if (list.items.empty()) refuse(list.place, "'keys' is empty", "a key is [FRAME, VALUE]");
        for (const Value& item : list.items) read_one(item);
    }

    void read_one(const Value& item) {
        const std::size_t n = item.items.size();
        if (!item.is(Kind::kArray) || n < 2 || n > 3 || !item.items[0].is(Kind::kNumber))
            return refuse(
                item.place,
                fmt::format("a key is {}; it must be [FRAME, VALUE] or [FRAME, VALUE, WORD]", item.shown()));
        if (n == 3) one_of(item.items[2], "how a key goes on", {"linear", "smooth", "hold"});
        const Key key{item.items[0].number, &item.items[1], n == 3 ? &item.items[2] : nullptr};
        if (!keys.empty() && key.frame <= keys.back().frame)
            refuse(item.items[0].place,
                   fmt::format("the key of frame {} stands after that of frame {}", key.frame,
                               keys.back().frame),
                   "keys stand in the order of their frames");
        keys.push_back(key);
    }

    Diagnostics& diagnostics_;
    bool is_sound_ = true;
};

// "#rrggbb" as its three numbers, so that it mixes with others.
Value spread(const Value& value) {
    const auto colour = value.is(Kind::kString) ? colour_of_text(value.text) : std::nullopt;
    if (!colour) return value;
    Value out;
    out.kind = Kind::kArray;
    for (const double channel : {colour->r, colour->g, colour->b}) out.items.push_back(number_value(channel));
    return out;
}

bool can_mix(const Value& a, const Value& b) {
    if (a.is(Kind::kNumber) && b.is(Kind::kNumber)) return true;
    return a.is(Kind::kArray) && b.is(Kind::kArray) && std::ranges::equal(a.items, b.items, can_mix);
}

Value mixed(const Value& a, const Value& b, double t) {
    if (a.is(Kind::kNumber)) return number_value(a.number + (b.number - a.number) * t);
    Value out = a;
    for (std::size_t i = 0; i < a.items.size(); ++i) out.items[i] = mixed(a.items[i], b.items[i], t);
    return out;
}

class Curve {
public:
    Curve(const std::vector<Key>& keys, Diagnostics& diagnostics) : keys_(keys), diagnostics_(diagnostics) {}

    // Between keys, or at `frame` beyond the first or last, as `end` says.
    std::optional<Value> at(double frame, std::string_view before, std::string_view after) const {
        const double first = keys_.front().frame, last = keys_.back().frame;
        const std::string_view end = frame < first ? before : frame > last ? after : "";
        if (end == "loop" && last > first) frame = first + modulo(frame - first, last - first);
        if (end != "extend") frame = std::clamp(frame, first, last);
        const auto next = std::ranges::find_if(keys_, [&](const Key& k) { return k.frame > frame; });
        const std::size_t to = std::clamp<std::size_t>(static_cast<std::size_t>(next - keys_.begin()), 1,
                                                       std::max<std::size_t>(keys_.size() - 1, 1));
        if (keys_.size() == 1) return *keys_[0].value;
        return between(keys_[to - 1], keys_[to], frame, end == "extend");
    }

private:
    std::optional<Value> between(const Key& from, const Key& to, double frame, bool beyond) const {
        const Value a = spread(*from.value), b = spread(*to.value);
        const bool mixes = can_mix(a, b);
        if (!mixes && from.mode && !from.is("hold")) {
            graph_error(
                diagnostics_, from.mode->place,
                fmt::format("there is nothing between {} and {}", from.value->shown(), to.value->shown()),
                "write \"hold\"");
            return std::nullopt;
        }
        if (frame >= to.frame && !beyond) return *to.value;
        if (!mixes || from.is("hold")) return frame < to.frame ? *from.value : *to.value;
        const double t = (frame - from.frame) / (to.frame - from.frame);
        return mixed(a, b, from.is("smooth") && !beyond ? t * t * (3 - 2 * t) : t);
    }

    const std::vector<Key>& keys_;
    Diagnostics& diagnostics_;
};

std::string_view word(const Value& animation, std::string_view name) {
    const Value* value = animation.find(name);
    return value ? std::string_view(value->text) : "hold";
}

}  // namespace

bool is_animation(const Value& value) {
    const Value* keys = value.is(Kind::kObject) ? value.find("keys") : nullptr;
    return keys && keys->is(Kind::kArray);
}

std::optional<Value> animated(const Value& animation, int frame, Diagnostics& diagnostics) {
    Reader reader(diagnostics);
    if (!reader.read(animation)) return std::nullopt;
    const double held = held_frame(frame, reader.keys.front().frame, reader.on);
    auto value =
        Curve(reader.keys, diagnostics).at(held, word(animation, "before"), word(animation, "after"));
    if (value) value->place = animation.place;
    return value;
}

bool check_animation(const Value& animation, Diagnostics& diagnostics) {
    return Reader(diagnostics).read(animation);
}

}  // namespace keyline

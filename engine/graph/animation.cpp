// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/animation.h"

#include "engine/expr/functions.h"
#include "engine/graph/graph_error.h"
#include "engine/graph/tangent.h"
#include "engine/json/make_value.h"
#include "engine/params/colour_text.h"

#include <algorithm>
#include <array>
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
    const Value* mode = nullptr;  // a word; null: linear where that is possible
    Tangent in = {}, out = {};

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
        for (std::size_t i = 0; i < keys.size(); ++i) check_tangents(i);
        return is_sound_;
    }

    std::vector<Key> keys;
    double on = 1;

private:
    void refuse(const Place& place, std::string what, std::string hint = {}) {
        graph_error(diagnostics_, place, std::move(what), std::move(hint), {}, Code::kMotion);
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
        Key key{item.items[0].number, &item.items[1]};
        if (n == 3) read_way(item.items[2], key);
        if (!keys.empty() && key.frame <= keys.back().frame)
            refuse(item.items[0].place,
                   fmt::format("the key of frame {} stands after that of frame {}", key.frame,
                               keys.back().frame),
                   "keys stand in the order of their frames");
        keys.push_back(key);
    }

    // How the value goes on from the key, and how it arrives there.
    void read_way(const Value& way, Key& key) {
        if (!way.is(Kind::kObject)) {
            one_of(way, "how a key goes on", {"linear", "smooth", "hold"});
            key.mode = &way;
            return;
        }
        for (const Member& m : way.members)
            if (m.key == "in")
                read_tangent(m, key.in);
            else if (m.key == "out")
                read_tangent(m, key.out);
            else
                refuse(m.key_place, "unknown key " + in_quotes(m.key), "a key's tangents are 'in' and 'out'");
    }

    void read_tangent(const Member& m, Tangent& tangent) {
        if (m.value.items.size() == 2 && m.value.items[0].is(Kind::kNumber))
            tangent = {m.value.items[0].number, &m.value.items[1], m.value.place};
        else
            refuse(m.value.place, fmt::format("{} is {}; it must be [FRAMES, RISE], seen from the key",
                                              in_quotes(m.key), m.value.shown()));
    }

    // A curve may not turn back in time, and has an end that it goes to.
    void check_tangents(std::size_t i) {
        const Key& key = keys[i];
        const double before = i > 0 ? key.frame - keys[i - 1].frame : 0;
        const double after = i + 1 < keys.size() ? keys[i + 1].frame - key.frame : 0;
        check_tangent(key.in, "in", -before, 0);
        check_tangent(key.out, "out", 0, after);
        if (key.in && i > 0 && keys[i - 1].mode)
            refuse(key.in.place,
                   fmt::format("the curve arrives here, and the key before goes on {}",
                               keys[i - 1].mode->shown()),
                   "write { \"out\": [FRAMES, RISE] } there, or nothing");
    }

    void check_tangent(const Tangent& tangent, const char* name, double least, double most) {
        if (!tangent || (tangent.frames >= least && tangent.frames <= most)) return;
        const bool is_at_end = least == most;
        refuse(tangent.place,
               is_at_end
                   ? fmt::format("'{}' leads nowhere: there is no key on that side", name)
                   : fmt::format("'{}' goes {} frames; it must be from {} to {}, which is the next key there",
                                 name, tangent.frames, least, most));
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

Value sum(const Value& a, const Value& b) {
    if (a.is(Kind::kNumber)) return number_value(a.number + b.number);
    Value out = a;
    for (std::size_t i = 0; i < a.items.size(); ++i) out.items[i] = sum(a.items[i], b.items[i]);
    return out;
}

// Numbers, or lists of the same form.
struct Part {
    double weight;
    Value value;
};

Value weighted(const std::array<Part, 4>& parts) {
    Value out = parts[0].value;
    if (out.is(Kind::kNumber)) {
        double total = 0;
        for (const Part& p : parts) total += p.weight * p.value.number;
        return number_value(total);
    }
    for (std::size_t i = 0; i < out.items.size(); ++i) {
        std::array<Part, 4> of_item = parts;
        for (Part& p : of_item) p.value = Value(p.value.items[i]);
        out.items[i] = weighted(of_item);
    }
    return out;
}

// What a point of a curve is, seen from a key: null is the straight way to the other one.
Value point(const Value& key, const Tangent& tangent, const Value& other, double straight) {
    return tangent ? sum(key, spread(*tangent.rise)) : mixed(key, other, straight);
}

class Curve {
public:
    Curve(const std::vector<Key>& keys, Diagnostics& diagnostics) : keys_(keys), diagnostics_(diagnostics) {}

    // Whether there is a way from each key to the next; where there is none, that is told.
    bool is_sound() const {
        for (std::size_t i = 0; i + 1 < keys_.size(); ++i)
            if (!has_way(keys_[i], keys_[i + 1])) return false;
        return true;
    }

    // Between keys, or at `frame` beyond the first or last, as `end` says.
    Value at(double frame, std::string_view before, std::string_view after) const {
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
    static Value between(const Key& from, const Key& to, double frame, bool beyond) {
        const Value a = spread(*from.value), b = spread(*to.value);
        const bool mixes = can_mix(a, b);
        if (frame >= to.frame && !beyond) return *to.value;
        if (mixes && !beyond && (from.out || to.in)) return curved(from, to, a, b, frame);
        if (!mixes || from.is("hold")) return frame < to.frame ? *from.value : *to.value;
        const double t = (frame - from.frame) / (to.frame - from.frame);
        return mixed(a, b, from.is("smooth") && !beyond ? t * t * (3 - 2 * t) : t);
    }

    // Where it says that there is something between two keys; null where it does not.
    static const Place* way_between(const Key& from, const Key& to) {
        if (from.mode) return from.is("hold") ? nullptr : &from.mode->place;
        return from.out ? &from.out.place : to.in ? &to.in.place : nullptr;
    }

    bool has_way(const Key& from, const Key& to) const {
        const Value a = spread(*from.value);
        if (!can_mix(a, spread(*to.value))) {
            const Place* wanted = way_between(from, to);
            if (wanted)
                graph_error(
                    diagnostics_, *wanted,
                    fmt::format("there is nothing between {} and {}", from.value->shown(), to.value->shown()),
                    "write \"hold\"", {}, Code::kMotion);
            return !wanted;
        }
        for (const Tangent& tangent : {from.out, to.in})
            if (tangent && !can_mix(a, spread(*tangent.rise))) {
                graph_error(diagnostics_, tangent.rise->place,
                            fmt::format("a tangent rises by {}, and the value is {}; they must be alike",
                                        tangent.rise->shown(), from.value->shown()),
                            {}, {}, Code::kMotion);
                return false;
            }
        return true;
    }

    static Value curved(const Key& from, const Key& to, const Value& a, const Value& b, double frame) {
        const double frames = to.frame - from.frame;
        const BezierWeights w = bezier_at(frame - from.frame, from.out ? from.out.frames : frames / 3,
                                          frames + (to.in ? to.in.frames : -frames / 3), frames);
        return weighted({{{w.start, a},
                          {w.leaving, point(a, from.out, b, 1.0 / 3)},
                          {w.arriving, point(b, to.in, a, 1.0 / 3)},
                          {w.end, b}}});
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
    const Curve curve(reader.keys, diagnostics);
    if (!curve.is_sound()) return std::nullopt;
    const double held = held_frame(frame, reader.keys.front().frame, reader.on);
    Value value = curve.at(held, word(animation, "before"), word(animation, "after"));
    value.place = animation.place;
    return value;
}

bool check_animation(const Value& animation, Diagnostics& diagnostics) {
    return Reader(diagnostics).read(animation);
}

}  // namespace keyline

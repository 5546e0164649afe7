// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan/planner.h"
#include "engine/plan/resolve.h"
#include "tests/contract/contract.h"
#include "tests/support/draw.h"
#include "tests/support/interpret.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <exception>
#include <fmt/format.h>
#include <limits>

namespace keyline::testing {

namespace {

constexpr unsigned kSeed = 2;
constexpr int kLargestHaloForSmallTiles = 8;
constexpr int kWhole = 1 << 12;  // a tile larger than every image drawn

int largest_halo(const ResolvedFrame& frame) {
    int halo = 0;
    for (const Op& op : frame.ops)
        if (op.operation) halo = std::max({halo, op.operation->halo().x, op.operation->halo().y});
    return halo;
}

std::string difference(const Image& actual, const Image& expected) {
    const auto result = compare_images("", "", actual, expected);
    return result ? "a NaN has other bits" : result.message();
}

// Which of two NaNs an operation passes on the compiler decides, so what is computed has one.  An id is bits,
// and no number.
std::string other_nan(const NodeType& type, const ResolvedFrame& frame) {
    if (std::ranges::find(type.outputs, "owner") != type.outputs.end()) return "";
    const Image image = interpret(frame).front();
    const Stream& stream = frame.sinks.front().request.stream;
    for (std::size_t c = 0; c < image.channels.size(); ++c) {
        if (frame.info(stream.channels[c].value).stored || stream.channels[c].exact()) continue;
        for (const float v : image.channels[c].samples)
            if (std::isnan(v) && std::bit_cast<uint32_t>(v) !=
                                     std::bit_cast<uint32_t>(std::numeric_limits<float>::quiet_NaN()))
                return fmt::format("a NaN of {} is not the one that computed pixels have",
                                   image.channels[c].name);
    }
    return "";
}

// What a case's node gives: an image or a datum.
struct Result {
    std::vector<Image> images;
    std::vector<std::shared_ptr<const Datum>> data;
};

Result plain_result(const ResolvedFrame& frame) {
    Interpretation all = interpret_all(frame);
    Result out;
    for (std::size_t i = 0; i < frame.sinks.size(); ++i) {
        const Stream& stream = frame.sinks[i].request.stream;
        if (stream.is_data())
            out.data.push_back(all.data[static_cast<std::size_t>(stream.datum.op)]);
        else
            out.images.push_back(std::move(all.images[i]));
    }
    return out;
}

// "" where both are the same.
std::string difference(const Result& actual, const Result& expected) {
    for (std::size_t i = 0; i < expected.data.size(); ++i)
        if (!actual.data[i]->equals(*expected.data[i])) return "the datum is another";
    for (std::size_t i = 0; i < actual.images.size(); ++i)
        if (!same(actual.images[i], expected.images[i]))
            return difference(actual.images[i], expected.images[i]);
    return "";
}

// Calls complain(what) for every schedule under which the engine's result is not the plain evaluation's.
template <class Complain>
void compare_schedules(const NodeCase& c, const std::vector<int>& tiles, const std::vector<int>& threads,
                       const Complain& complain) {
    const Result expected = plain_result(c.resolve());
    for (const int tile : tiles)
        for (const int n : threads) {
            ResolvedFrame frame = c.resolve();
            if (tile < kLargestHaloForSmallTiles && largest_halo(frame) > kLargestHaloForSmallTiles) continue;
            Result actual{render(make_plan(std::move(frame), {n, tile, 0})), rendered_data()};
            const std::string found = difference(actual, expected);
            if (found.empty()) continue;
            return complain(fmt::format("with tiles of {} and {} threads: {}", tile, n, found));
        }
}

// Runs a check on drawn cases; whatever it throws is a complaint too.
template <class Check>
Complaints on_cases(const NodeType& type, int count, const std::function<Rect(Draw&)>& window,
                    const Check& check) {
    Complaints out;
    Draw draw(kSeed);
    for (int i = 0; i < count && out.empty(); ++i) {
        NodeCase c;
        const auto complain = [&](const std::string& what) { out.push_back(what + "\n" + c.text()); };
        try {
            c = draw_case(type, draw, window);
            check(c, draw, complain);
        } catch (const std::exception& e) {
            complain(fmt::format("threw: {}", e.what()));
        }
    }
    return out;
}

void sprinkle(Image& image, Draw& draw) {
    using Limits = std::numeric_limits<float>;
    const std::vector<float> specials{Limits::quiet_NaN(),
                                      -Limits::quiet_NaN(),
                                      Limits::infinity(),
                                      -Limits::infinity(),
                                      -0.0F,
                                      Limits::denorm_min(),
                                      -1e-40F,
                                      Limits::max(),
                                      Limits::lowest()};
    for (Image::Channel& c : image.channels) {
        c.type = SampleType::kFloat;
        for (float& s : c.samples)
            if (draw.one_in(5)) s = draw.of(specials);
    }
}

const std::vector<Rect>& odd_windows() {
    static const std::vector<Rect> windows{{0, 0, 0, 0},   {7, -3, 7, 9},       {0, 0, 1, 1},
                                           {-8, 5, -7, 6}, {3, 3, 40, 4},       {-2, -20, -1, 20},
                                           {0, 0, 2, 2},   {-65, -65, -63, -63}};
    return windows;
}

}  // namespace

Complaints check_schedules(const NodeType& type) {
    Complaints out = on_cases(type, 4, {}, [](const NodeCase& c, Draw&, const auto& complain) {
        compare_schedules(c, {1, 7, 64, 100, kWhole}, {1, 2, 7}, complain);
    });
    if (!out.empty()) return out;
    const auto large = [](Draw& draw) { return draw.window(260, 150); };
    return on_cases(type, 2, large, [](const NodeCase& c, Draw&, const auto& complain) {
        compare_schedules(c, {64, 100}, {7}, complain);
    });
}

Complaints check_special_values(const NodeType& type) {
    return on_cases(type, 6, {}, [&](NodeCase& c, Draw& draw, const auto& complain) {
        for (auto& [name, images] : c.inputs)
            for (Image& image : images) sprinkle(image, draw);
        if (const std::string nan = other_nan(type, c.resolve()); !nan.empty()) complain(nan);
        compare_schedules(c, {13, 64}, {1, 2}, complain);
    });
}

Complaints check_windows(const NodeType& type) {
    const auto check = [](const NodeCase& c, Draw&, const auto& complain) {
        compare_schedules(c, {7, 64}, {2}, complain);
    };
    const auto odd = [](Draw& draw) { return draw.of(odd_windows()); };
    const auto far = [](Draw& draw) { return translate(draw.window(), 100000, -70000); };
    Complaints out = on_cases(type, 25, odd, check);
    return out.empty() ? on_cases(type, 3, far, check) : out;
}

Complaints check_identity(const NodeType& type) {
    return on_cases(type, 60, {}, [](const NodeCase& c, Draw&, const auto& complain) {
        const ResolvedFrame computed = c.resolve(false);
        const std::size_t operations = computed.ops.size();
        const Result expected = plain_result(computed);
        const ResolvedFrame left_out = c.resolve(true);
        if (left_out.ops.size() == operations) return;
        const std::string found = difference(plain_result(left_out), expected);
        if (!found.empty()) complain("says that it changes nothing, and does: " + found);
    });
}

}  // namespace keyline::testing

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/options.h"
#include "cli/common/report.h"
#include "cli/look/commands.h"
#include "cli/look/diff_report.h"
#include "engine/base/text.h"
#include "engine/io/describe_image.h"
#include "engine/look/heat_map.h"
#include "engine/look/linear_picture.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <memory>

namespace keyline::cli {

namespace {

struct DiffArguments {
    std::string a, b, layer, tolerance, relative, heat;
    bool flip = false, metadata = false, json = false;
};

double read_tolerance(const std::string& option, const std::string& text) {
    double number = 0;
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, number);
    if (!text.empty() && (error != std::errc{} || rest != end || !std::isfinite(number) || number < 0))
        throw Failure(
            {ErrorKind::kGraph, {option + " " + text, 0, 0}, {}, "it must be a number from 0 on", {}});
    return number;
}

// A file, and what it is told to hold.
struct LookedAt {
    explicit LookedAt(const std::string& name) : file(name), image(describe_image(name)) {
        if (image.fault) throw Failure(*image.fault);
    }

    std::vector<std::string> views() const {
        std::vector<std::string> out;
        const auto add = [&](const std::string& view) {
            if (!view.empty() && std::ranges::find(out, view) == out.end()) out.push_back(view);
        };
        for (const ImagePart& part : image.parts) {
            std::ranges::for_each(part.views, add);
            add(part.view);
        }
        return out;
    }

    std::unique_ptr<ImageSource> open(const std::string& view) const {
        OpenOptions options;
        options.view = view;
        return open_image(file, options);
    }

    // Whole numbers are sRGB, as displays take them; floats are light.
    Encoding encoding() const {
        return image.parts.front().channels.front().type.starts_with("uint") && image.format != "openexr"
                   ? Encoding::kSrgb
                   : Encoding::kLinear;
    }

    std::string file;
    ImageDescription image;
};

// The largest of a map, and where it is.
FlipResult result_of(const ErrorMap& map) {
    FlipResult out;
    double sum = 0;
    for (const float v : map.errors) sum += double{v};
    const auto largest = std::ranges::max_element(map.errors);
    const auto at = static_cast<int>(largest - map.errors.begin());
    out.mean = sum / static_cast<double>(map.errors.size());
    out.largest = *largest;
    out.x = map.window.x0 + at % map.window.width();
    out.y = map.window.y0 + at / map.window.width();
    return out;
}

ErrorMap flip_map(const std::string& layer, const LookedAt& a, const LookedAt& b, const ImageSource& of_a,
                  const ImageSource& of_b) {
    const Rect window = unite(of_a.header().display_window, of_b.header().display_window);
    return {window, flip(linear_picture(of_a, layer, window, a.encoding()),
                         linear_picture(of_b, layer, window, b.encoding()))};
}

// 1 is the most that FLIP can be; other errors go as far as the largest.
void write_heat(const DiffArguments& arguments, const ErrorMap& map) {
    const float most = arguments.flip ? 1 : *std::ranges::max_element(map.errors);
    write_heat_map(arguments.heat, map, most);
    if (!arguments.json)
        print_result(fmt::format("{}: white is an error of {:.4g}\n", escaped(arguments.heat), most));
}

// In one view, which both have.
DiffReport compare(const DiffArguments& arguments, const LookedAt& a, const LookedAt& b,
                   const std::string& view, bool is_first) {
    const Tolerance tolerance{read_tolerance("--tolerance", arguments.tolerance),
                              read_tolerance("--relative", arguments.relative)};
    const auto of_a = a.open(view), of_b = b.open(view);
    const ImageHeader &in_a = of_a->header(), &in_b = of_b->header();
    const bool wants_heat = is_first && !arguments.heat.empty();
    ErrorMap map;
    DiffReport out{view, in_a.display_window, in_b.display_window, in_a.data_window, in_b.data_window, {},
                   {}};
    out.found = differences_of(*of_a, *of_b, arguments.layer, tolerance,
                               wants_heat && !arguments.flip ? &map : nullptr);
    if (arguments.flip) {
        map = flip_map(arguments.layer, a, b, *of_a, *of_b);
        out.flip = result_of(map);
    }
    if (wants_heat) write_heat(arguments, map);
    return out;
}

std::vector<DiffReport> compare_views(const DiffArguments& arguments, const LookedAt& a, const LookedAt& b) {
    std::vector<std::string> views = a.views();
    if (views != b.views())
        fail(ErrorKind::kInput,
             fmt::format("the views of {} and {} are not the same", in_quotes(a.file), in_quotes(b.file)),
             "keyline info tells them");
    if (views.empty()) views.emplace_back();
    std::vector<DiffReport> out;
    for (const std::string& view : views) out.push_back(compare(arguments, a, b, view, out.empty()));
    return out;
}

std::string json_of(const DiffArguments& arguments, const std::vector<DiffReport>& reports, bool same) {
    JsonWriter json(JsonWriter::Style::kIndented);
    json.begin_object().field("a", arguments.a).field("b", arguments.b).field("same", same);
    json.key("pictures").begin_array();
    for (const DiffReport& r : reports) write_diff(json, r);
    return json.end_array().end_object().text() + "\n";
}

std::string text_of(const DiffArguments& arguments, const std::vector<DiffReport>& reports, bool same) {
    std::string out = fmt::format("{} and {} {}\n", escaped(arguments.a), escaped(arguments.b),
                                  same ? "are the same" : "differ");
    for (const DiffReport& r : reports) out += diff_text(arguments.a, arguments.b, r);
    return out;
}

// 1 is no error here: the pictures differ.
int run(const DiffArguments& arguments) {
    const std::vector<DiffReport> reports =
        compare_views(arguments, LookedAt(arguments.a), LookedAt(arguments.b));
    const bool same =
        std::ranges::none_of(reports, [&](const DiffReport& r) { return r.differ(arguments.metadata); });
    print_result(arguments.json ? json_of(arguments, reports, same) : text_of(arguments, reports, same));
    return same ? 0 : 1;
}

}  // namespace

void add_diff(const Command& program) {
    const Command command = program.add(
        "diff", "What two images differ in; the status is 0 where they are the same, 1 where they differ");
    const auto arguments = std::make_shared<DiffArguments>();
    command.argument("A", arguments->a, "An image file");
    command.argument("B", arguments->b, "The one to compare it with");
    command.option("--layer", arguments->layer, "NAME",
                   "Compare just this layer or channel, named as in a graph after the colon");
    command.option("--tolerance", arguments->tolerance, "E",
                   "Samples that are no further apart are the same; ids never");
    command.option("--relative", arguments->relative, "R",
                   "Nor are those that are no further apart than this share of the larger one");
    command.option("--heat", arguments->heat, "FILE",
                   "Write where the errors are, as a picture: the largest of a pixel's channels, or FLIP");
    command.flag("--flip", arguments->flip,
                 "Tell how different R G B look, by FLIP: 8 and 16 bits as sRGB, floats as light up to 1");
    command.flag("--metadata", arguments->metadata, "Attributes that differ count as a difference");
    command.flag("--json", arguments->json, "As JSON");
    command.runs([arguments] { return run(*arguments); });
}

}  // namespace keyline::cli

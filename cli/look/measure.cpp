// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/options.h"
#include "cli/common/report.h"
#include "cli/look/commands.h"
#include "engine/base/text.h"
#include "engine/io/text_file.h"
#include "engine/json/json_writer.h"
#include "engine/kit/strokes_json.h"
#include "engine/measure/accuracy.h"
#include "engine/measure/drawn.h"
#include "engine/measure/form.h"
#include "engine/measure/motion.h"
#include "engine/params/file_name.h"
#include "engine/params/frames.h"

#include <fmt/format.h>
#include <memory>
#include <optional>

namespace keyline::cli {

namespace {

struct MeasureArguments {
    std::string drawing, truth, extra, missed, frames, vector, drawn;
    AccuracyOptions accuracy;
    bool json = false;
};

struct Measured {
    Form form;
    std::optional<Accuracy> accuracy;  // where there is a truth
    std::optional<DrawnWidth> drawn;   // where there is a picture
};

// A file and the name of one of its layers: FILE:LAYER.
struct FileLayer {
    FileName file;
    std::string layer;

    FileLayer(const std::string& text, const char* usual) : file(text), layer(usual) {
        const std::size_t colon = text.find_last_of(':');
        if (colon == std::string::npos || text.find('/', colon) != std::string::npos) return;
        file = FileName(text.substr(0, colon));
        layer = text.substr(colon + 1);
    }
};

Strokes read_strokes(const std::string& file) { return parse_strokes(read_text_file(file), file); }

double percent(double part, double whole) { return whole > 0 ? 100 * part / whole : 0; }

KindOfLines sum_of(const std::vector<KindOfLines>& kinds, const Offsets& offsets) {
    KindOfLines out;
    out.offsets = offsets;
    for (const KindOfLines& k : kinds) {
        out.length += k.length;
        out.matched += k.matched;
    }
    return out;
}

std::string drawn_row(const char* name, const KindOfLines& k) {
    const Offsets& o = k.offsets;
    return fmt::format("    {:<13}{:>10.0f}{:>10.1f}{:>10.3f}{:>10.3f}{:>10.3f}{:>10.3f}\n", name, k.length,
                       percent(k.matched, k.length), o.rms, o.robust, o.most, o.bias);
}

std::string truth_row(const char* name, const KindOfLines& k) {
    return fmt::format("    {:<13}{:>10.0f}{:>10.1f}\n", name, k.length, percent(k.matched, k.length));
}

std::string text_of(const Accuracy& accuracy, const MeasureArguments& a) {
    std::string out = fmt::format("  against {}, within {} pixels and {} degrees\n", escaped(a.truth),
                                  a.accuracy.within, a.accuracy.angle);
    out += "    drawn        pixels    % true    off rms    robust      95 %      bias\n";
    for (const KindOfLines& k : accuracy.drawn) out += drawn_row(word_of(k.kind), k);
    out += drawn_row("all", sum_of(accuracy.drawn, accuracy.offsets));
    out += "    true         pixels   % drawn\n";
    for (const KindOfLines& k : accuracy.truth) out += truth_row(word_of(k.kind), k);
    out += truth_row("all", sum_of(accuracy.truth, {}));
    return out + fmt::format("    precision {:.3f}, recall {:.3f}, F {:.3f}\n", accuracy.precision,
                             accuracy.recall, accuracy.f());
}

std::string text_of(const Measured& measured) {
    const Form& form = measured.form;
    std::string out = "  in itself\n";
    const auto line = [&](const char* name, const std::string& text) {
        out += fmt::format("    {:<17}{}\n", name, text);
    };
    line("strokes",
         fmt::format("{} of {} vertices, {:.0f} pixels", form.strokes, form.vertices, form.length));
    line("doubles", fmt::format("{:.1f} %", 100 * form.doubles));
    line("loose ends", fmt::format("{} of {}, {:.1f} in 1000 pixels", form.loose_ends, form.ends,
                                   form.loose_per_thousand()));
    line("closed outlines", fmt::format("{} of {} objects wholly in view", form.closed, form.objects));
    line("ripple", fmt::format("{:.3f} pixels", form.ripple));
    line("width", fmt::format("changes by {:.3f} a pixel at most (95 %), spreads by {:.1f} %",
                              form.width_slope, 100 * form.width_spread));
    line("curves", fmt::format("{}, {:.1f} in 100 pixels", form.curves, form.curves_per_hundred()));
    if (measured.drawn && measured.drawn->length > 0)
        line("drawn width", fmt::format("spreads by {:.1f} %, told from {:.0f} pixels",
                                        100 * measured.drawn->spread, measured.drawn->length));
    else if (measured.drawn)
        line("drawn width",
             "no stroke runs straight and alone for long enough, where the picture has a line");
    return out;
}

void write_kinds(JsonWriter& json, const char* name, const std::vector<KindOfLines>& kinds) {
    json.key(name).begin_array();
    for (const KindOfLines& k : kinds) {
        json.begin_object().field("kind", word_of(k.kind)).field("pixels", k.length);
        json.field("matched", k.matched).field("rms", k.offsets.rms).field("robust", k.offsets.robust);
        json.field("most", k.offsets.most).field("bias", k.offsets.bias).end_object();
    }
    json.end_array();
}

std::string json_of(const Measured& measured, const MeasureArguments& a) {
    JsonWriter json(JsonWriter::Style::kIndented);
    json.begin_object().field("file", a.drawing);
    if (measured.accuracy) {
        const Accuracy& p = *measured.accuracy;
        json.key("accuracy").begin_object().field("truth", a.truth);
        json.field("precision", p.precision).field("recall", p.recall).field("f", p.f());
        json.field("rms", p.offsets.rms).field("robust", p.offsets.robust);
        json.field("most", p.offsets.most).field("bias", p.offsets.bias);
        write_kinds(json, "drawn", p.drawn);
        write_kinds(json, "true", p.truth);
        json.end_object();
    }
    const Form& f = measured.form;
    json.key("form").begin_object().field("strokes", f.strokes).field("vertices", f.vertices);
    json.field("pixels", f.length).field("doubles", f.doubles).field("ends", f.ends);
    json.field("looseEnds", f.loose_ends).field("objects", f.objects).field("closed", f.closed);
    json.field("ripple", f.ripple).field("widthSlope", f.width_slope);
    json.field("widthSpread", f.width_spread).field("curves", f.curves);
    if (measured.drawn) {
        json.field("drawnWidthPixels", measured.drawn->length);
        if (measured.drawn->length > 0) json.field("drawnWidthSpread", measured.drawn->spread);
    }
    return json.end_object().end_object().text() + "\n";
}

void write(const std::string& file, const Strokes& strokes) {
    if (!file.empty()) write_text_file(file, strokes_json(strokes));
}

int measure_one(const MeasureArguments& a) {
    if (a.truth.empty() && !(a.extra.empty() && a.missed.empty()))
        fail(ErrorKind::kGraph, "what is extra or missed shows against a truth", "give its file too");
    const Strokes drawing = read_strokes(a.drawing);
    Measured measured{form_of(drawing), {}, {}};
    if (!a.drawn.empty()) {
        const FileLayer drawn(a.drawn, "");
        measured.drawn = width_in(drawing, read_drawn_lines(drawn.file.at(0), drawn.layer));
    }
    if (!a.truth.empty()) measured.accuracy = accuracy_of(drawing, read_strokes(a.truth), a.accuracy);
    if (measured.accuracy) {
        write(a.extra, measured.accuracy->extra);
        write(a.missed, measured.accuracy->missed);
    }
    print_result(a.json ? json_of(measured, a)
                        : escaped(a.drawing) + "\n" +
                              (measured.accuracy ? text_of(*measured.accuracy, a) : std::string()) +
                              text_of(measured));
    return 0;
}

// From frame to frame.
struct Moving {
    Steadiness steadiness;
    bool compared = false;  // there are pictures
    std::optional<double> flicker;
};

std::string text_of(const Moving& moving, const MeasureArguments& a) {
    const Steadiness& s = moving.steadiness;
    std::string out =
        fmt::format("{}, frames {}, as {} has them move\n", escaped(a.drawing), a.frames, escaped(a.vector));
    const auto line = [&](const char* name, const std::string& text) {
        out += fmt::format("    {:<17}{}\n", name, text);
    };
    line("looked for", fmt::format("{:.0f} pixels in {} pairs of frames", s.length, s.pairs));
    line("swim", fmt::format("{:.3f} pixels, rms {:.3f}, at most {:.3f} (95 %)", s.swim.robust, s.swim.rms,
                             s.swim.most));
    line("pops", fmt::format("{:.2f} %, flecks {:.2f} %", 100 * s.pops, 100 * s.flecks));
    line("lost ink", fmt::format("{:.2f} %", 100 * s.lost_ink));
    line("drift", fmt::format("{:.3f} pixels from frame to frame, {:.3f} from the first to the last, of "
                              "{:.0f} that stay in view",
                              s.drift, s.shot_drift, s.drifted));
    if (moving.compared && !moving.flicker) line("flicker", "the pictures have no lines to compare");
    if (moving.flicker) line("flicker", fmt::format("{:.1f} % of the drawn pixels", 100 * *moving.flicker));
    return out;
}

std::string json_of(const Moving& moving, const MeasureArguments& a) {
    const Steadiness& s = moving.steadiness;
    JsonWriter json(JsonWriter::Style::kIndented);
    json.begin_object().field("file", a.drawing).field("frames", a.frames).field("vector", a.vector);
    json.field("pairs", s.pairs).field("pixels", s.length).field("swim", s.swim.robust);
    json.field("swimRms", s.swim.rms).field("swimMost", s.swim.most).field("pops", s.pops);
    json.field("flecks", s.flecks).field("lostInk", s.lost_ink).field("drift", s.drift);
    json.field("shotDrift", s.shot_drift);
    json.field("driftPixels", s.drifted);
    if (moving.flicker) json.field("flicker", *moving.flicker);
    return json.end_object().text() + "\n";
}

int measure_frames(const MeasureArguments& a) {
    if (a.vector.empty() || a.frames.empty())
        fail(ErrorKind::kGraph, "frames are held against each other by '--frames' and '--vector'",
             "give both");
    if (!a.truth.empty())
        fail(ErrorKind::kGraph, "a truth is for one frame",
             "leave out '--frames' and '--vector', or the truth");
    const FileName drawings(a.drawing);
    const FileLayer passes(a.vector, "Vector");
    std::vector<MovingFrame> frames;
    std::vector<DrawnFrame> pictures;
    for (const int frame : parse_frames(a.frames)) {
        frames.push_back(
            {read_strokes(drawings.at(frame).string()), read_motion(passes.file.at(frame), passes.layer)});
        if (a.drawn.empty()) continue;
        const FileLayer drawn(a.drawn, "");
        pictures.push_back({read_drawn_lines(drawn.file.at(frame), drawn.layer), frames.back().motion});
    }
    if (frames.size() < 2)
        fail(ErrorKind::kGraph, "one frame has no other to be held against",
             "give two and more to '--frames'");
    Moving moving{steadiness_of(frames, a.accuracy), !pictures.empty(), {}};
    if (moving.compared) moving.flicker = flicker_of(pictures);
    print_result(a.json ? json_of(moving, a) : text_of(moving, a));
    return 0;
}

int run(const MeasureArguments& a) {
    return a.frames.empty() && a.vector.empty() ? measure_one(a) : measure_frames(a);
}

}  // namespace

void add_measure(const Command& program) {
    const Command command = program.add("measure", "How good a drawing's lines are");
    const auto a = std::make_shared<MeasureArguments>();
    command.argument("STROKES", a->drawing, "The drawing, as 'strokes_write' makes it");
    command.argument("TRUTH", a->truth, "Lines that are known to be true, as strokes too").optional();
    command.option("--within", a->accuracy.within, {0.01, 100}, "PIXELS",
                   "How far a line may be from the true one");
    command.option("--angle", a->accuracy.angle, {0, 90}, "DEGREES", "How far it may turn away from it");
    command.option("--frames", a->frames, "SPEC",
                   "Hold these frames against each other, as 1-24; STROKES names them by #");
    command.option("--vector", a->vector, "FILE[:LAYER]",
                   "How pixels move: images with a layer of X Y Z W, as Cycles' Vector");
    command.option("--drawn", a->drawn, "FILE[:LAYER]",
                   "The lines as pixels, the A of an image or its only channel: how even they are, and how "
                   "much they flicker");
    command.option("--extra", a->extra, "FILE", "Write what is drawn and not true, as strokes");
    command.option("--missed", a->missed, "FILE", "Write what is true and not drawn, as strokes");
    command.flag("--json", a->json, "As JSON");
    command.runs([a] { return run(*a); });
}

}  // namespace keyline::cli

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/author/starter.h"

#include "engine/json/json_layout.h"
#include "engine/json/json_writer.h"

#include <fmt/format.h>
#include <initializer_list>
#include <string_view>
#include <utility>
#include <vector>

namespace keyline::cli {

namespace {

std::string json(std::string_view text) { return JsonWriter().value(text).text(); }

// A share of the picture that is worth a few nodes.
constexpr double kSome = 0.005;

// As people write it: two digits.
std::string rounded(double number) { return fmt::format("{:.2g}", number); }

std::string pass(const std::string& selection) { return json("render:" + selection); }

// Lines of the object of nodes.
class Nodes {
public:
    using Members = std::vector<std::pair<std::string_view, std::string>>;  // name and JSON

    void comment(std::string_view text) { out_ += fmt::format("\n// {}\n", text); }
    void add(std::string_view id, std::string_view type, const Members& members) {
        out_ += fmt::format("{}: {{ \"type\": {}", json(id), json(type));
        for (const auto& [name, value] : members) out_ += fmt::format(", \"{}\": {}", name, value);
        out_ += " },\n";
    }
    std::string text() const { return out_.substr(0, out_.rfind(',')); }

private:
    std::string out_;
};

class Writer {
public:
    explicit Writer(const Starter& starter) : s_(starter), p_(starter.passes) {}

    std::string text() {
        nodes_.add("render", "read", {{"file", json("${plate}")}});
        lines();
        if (s_.look == Look::kDrawing) tones();
        comp();
        return fmt::format(
            R"({{ "keyline": 1, "about": {}, "variables": {{ "plate": {}, "out": {}, "look": {} }}, "nodes": {{ {} }} }})",
            json(about()), json(s_.plate), json(s_.out + ".exr"), json(s_.out + ".png"), nodes_.text());
    }

private:
    std::string about() const {
        switch (s_.look) {
            case Look::kDrawing: return "Flat tones under ink";
            case Look::kOver: return "Ink over the render";
            case Look::kLines: return "Ink on paper";
        }
        return {};
    }

    // By their names where there is a Cryptomatte, else all of one.
    Nodes::Members owned() const {
        if (p_.objects.empty()) return {};
        return {{"owner", "\"render\""}, {"layer", json(p_.objects)}};
    }

    void contours(std::string_view id, const std::string& cryptomatte, Nodes::Members more) {
        Nodes::Members members{{"in", "\"render\""}, {"layer", json(cryptomatte)}};
        if (!p_.depth.empty()) members.emplace_back("depth", pass(p_.depth));
        members.insert(members.end(), more.begin(), more.end());
        nodes_.add(id, "contours", members);
        sure_.push_back(json(id));
    }

    void trace(std::string_view id, std::string_view of, const char* low, const char* high,
               Nodes::Members more) {
        Nodes::Members members{{"in", json(of)}, {"low", low}, {"high", high}};
        members.insert(members.end(), more.begin(), more.end());
        for (auto& m : owned()) members.push_back(m);
        if (!sure_.empty()) members.emplace_back("except", sure_.size() == 1 ? sure_[0] : "\"sure\"");
        nodes_.add(id, "trace", members);
        traced_.push_back(json(id));
    }

    void outlines() {
        if (p_.objects.empty() && p_.materials.empty()) return;
        nodes_.comment("Outlines know their object: they are closed and exact.");
        if (!p_.objects.empty()) contours("objects", p_.objects, {});
        if (!p_.materials.empty()) contours("paints", p_.materials, {{"kind", "\"material\""}});
        if (sure_.size() > 1)
            nodes_.add("sure", "chain",
                       {{"in", "[" + sure_[0] + ", " + sure_[1] + "]"},
                        {"priority", R"(["outline", "occlusion", "intersection", "material"])"}});
    }

    void creases() {
        if (p_.normal.empty()) return;
        nodes_.comment("Where a surface bends.  Too many lines: raise low and high.");
        nodes_.add("turn", "gradient", {{"in", pass(p_.normal)}, {"operator", "\"sobel\""}});
        trace("creases", "turn", "0.15", "0.4", {});
    }

    void folds() {
        if (p_.depth.empty()) return;
        nodes_.comment("Where one part stands before another: steps in depth, as a share of it.");
        nodes_.add("steps", "planestep", {{"in", pass(p_.depth)}});
        trace("folds", "steps", "0.004", "0.01", {{"kind", "\"fold\""}});
    }

    // All that a picture without passes has.
    void edges() {
        nodes_.comment(
            "No pass tells of shape: lines are where the picture changes.  Too many: raise low and high.");
        nodes_.add("grey", "ycolor", {{"in", pass(p_.beauty)}, {"clamp", "true"}, {"gamma", "2.2"}});
        const std::string low = rounded(0.4 * s_.levels.slope), high = rounded(1.2 * s_.levels.slope);
        trace("edges", "grey", low.c_str(), high.c_str(), {{"sigma", "1.4"}});
    }

    void lines() {
        outlines();
        creases();
        folds();
        if (sure_.empty() && traced_.empty()) edges();
        std::string all = sure_.empty() ? "" : sure_.size() == 1 ? sure_[0] : "\"sure\"";
        for (const std::string& t : traced_) all += (all.empty() ? "" : ", ") + t;
        nodes_.comment("One hand for all of them: joined, without tremor, with a width and tips.");
        nodes_.add("lines", "chain", {{"in", "[" + all + "]"}, {"min_length", "7"}});
        nodes_.add("calm", "smooth", {{"in", "\"lines\""}});
        Nodes::Members weight{{"in", "\"calm\""}, {"width", "4"}};
        if (s_.levels.distance > 0)
            weight.emplace_back("by_depth", fmt::format(R"({{ "reference": {}, "power": 0.5 }})",
                                                        rounded(s_.levels.distance)));
        weight.emplace_back("by_kind",
                            R"({ "crease": 0.6, "fold": 0.8, "intersection": 0.7, "material": 0.7 })");
        nodes_.add("wide", "weight", weight);
        nodes_.add("tipped", "taper", {{"in", "\"wide\""}, {"start", "10"}, {"end", "14"}});
        nodes_.add("ink", "draw",
                   {{"in", "\"tipped\""}, {"color", "[0.02, 0.018, 0.025]"}, {"like", "\"render\""}});
    }

    void tones() {
        nodes_.comment("Where the sun arrives: light, cut in two where this frame's own light parts.");
        nodes_.add("light", "ycolor", {{"in", pass(p_.light.empty() ? p_.beauty : p_.light)}});
        std::string light = "light";
        if (!p_.is_raw) {
            nodes_.add("colour", "ycolor", {{"in", pass(p_.albedo)}});
            nodes_.add("bare", "math", {{"in", "\"light\""}, {"op", "\"divide\""}, {"b", "\"colour\""}});
            light = "bare";
        }
        nodes_.add("soft", "gaussian", {{"in", json(light)}, {"sigma", "0.8"}});
        nodes_.add("sunny", "threshold",
                   {{"in", "\"soft\""},
                    {"low", rounded(0.85 * s_.levels.light)},
                    {"high", rounded(1.15 * s_.levels.light)}});

        nodes_.comment("Two flat tones of each surface's own colour.");
        nodes_.add("lit", "grade", {{"in", pass(p_.albedo)}, {"multiply", "[0.98, 0.95, 0.88]"}});
        nodes_.add("shade", "grade", {{"in", pass(p_.albedo)}, {"multiply", "[0.5, 0.52, 0.64]"}});
        nodes_.add("tones", "keymix", {{"a", "\"lit\""}, {"b", "\"shade\""}, {"mask", "\"sunny\""}});
        if (s_.levels.colourless > kSome && !p_.beauty.empty()) as_rendered();
    }

    void as_rendered() {
        nodes_.comment("What has no colour of its own, as metal, stays as it is rendered.");
        nodes_.add("own", "ycolor", {{"in", pass(p_.albedo)}});
        nodes_.add("coloured", "threshold", {{"in", "\"own\""}, {"low", "0.005"}, {"high", "0.02"}});
        nodes_.add("surfaces", "keymix",
                   {{"a", "\"tones\""}, {"b", pass(p_.beauty)}, {"mask", "\"coloured\""}});
        tones_ = "surfaces";
    }

    void comp() {
        std::string below = s_.look == Look::kDrawing ? json(tones_) : pass(p_.beauty);
        if (s_.look == Look::kLines) nodes_.comment("The paper.");
        if (s_.look == Look::kLines || (s_.look == Look::kDrawing && p_.has_alpha))
            nodes_.add("paper", "constant",
                       {{"color", s_.look == Look::kLines ? "[0.9, 0.88, 0.83]" : "[0.72, 0.83, 0.92]"},
                        {"like", "\"render\""}});
        if (s_.look == Look::kLines) below = "\"paper\"";
        if (s_.look == Look::kDrawing && p_.has_alpha) {
            nodes_.add("scene", "keymix", {{"a", below}, {"b", "\"paper\""}, {"mask", pass(p_.beauty)}});
            below = "\"scene\"";
        }
        nodes_.comment("For what comes after, and for the eye.");
        nodes_.add("comp", "over", {{"fg", "\"ink\""}, {"bg", below}});
        nodes_.add("out", "write", {{"in", "\"comp\""}, {"file", json("${out}")}, {"channels", kColour}});
        Nodes::Members show{{"in", "\"comp\""}};
        if (s_.look != Look::kOver) show.emplace_back("view", "\"Un-tone-mapped\"");
        nodes_.add("show", "display", show);
        nodes_.add(
            "png", "write",
            {{"in", "\"show\""}, {"file", json("${look}")}, {"channels", kColour}, {"depth", "\"uint8\""}});
    }

    static constexpr const char* kColour = R"(["R", "G", "B", "A"])";

    const Starter& s_;
    const RenderPasses& p_;
    Nodes nodes_;
    std::string tones_ = "tones";  // the node that has them
    std::vector<std::string> sure_,
        traced_;  // ids in quotes: from Cryptomattes, and what is sought beside them
};

}  // namespace

bool can_look(Look look, const RenderPasses& passes) {
    const bool has_lines = !passes.beauty.empty() || !passes.objects.empty() || !passes.materials.empty() ||
                           !passes.normal.empty() || !passes.depth.empty();
    switch (look) {
        case Look::kDrawing:
            return !passes.albedo.empty() && !(passes.light.empty() && passes.beauty.empty());
        case Look::kOver: return !passes.beauty.empty();
        case Look::kLines: return has_lines;
    }
    return false;
}

std::string starter_graph(const Starter& starter) {
    return json_layout(Writer(starter).text(), "the starter");
}

}  // namespace keyline::cli

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/author/graph_test.h"
#include "cli/author/test_images.h"
#include "cli/common/report.h"
#include "cli/common/temporary_folder.h"
#include "engine/json/json_writer.h"
#include "engine/look/objects.h"
#include "engine/run/render.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fmt/format.h>

namespace keyline::cli {

namespace {

namespace fs = std::filesystem;
using Kind = Value::Kind;

constexpr const char* kWrite = "test/write";  // no node of a file is called so

Value value_at(const Place& place, Kind kind) {
    Value out;
    out.kind = kind;
    out.place = place;
    return out;
}

Value text_value(const std::string& text, const Place& place) {
    Value out = value_at(place, Kind::kString);
    out.text = text;
    return out;
}

Value number_value(double number, const Place& place) {
    Value out = value_at(place, Kind::kNumber);
    out.number = number;
    return out;
}

Value object_of(const std::vector<std::pair<std::string, Value>>& members, const Place& place) {
    Value out = value_at(place, Kind::kObject);
    for (const auto& [key, value] : members) out.members.push_back({key, place, value});
    return out;
}

std::string in_folder(const std::string& folder, const std::string& file) {
    return (fs::path(folder) / file).lexically_normal().string();
}

// The files of a test's images, by the name of the image.
std::vector<std::pair<std::string, std::string>> image_files(const GraphTest& test,
                                                             const TemporaryFolder& folder) {
    std::vector<std::pair<std::string, std::string>> out;
    for (const Member& m : test.images.members) {
        const Value* given = m.value.is(Kind::kObject) ? m.value.find("file") : nullptr;
        std::string file =
            given ? in_folder(test.folder, given->text) : folder / fmt::format("{}.exr", out.size());
        if (!given) write_test_image(read_test_image(m.value), file);
        out.emplace_back(m.key, std::move(file));
    }
    return out;
}

Value write_node(const GraphTest& test, const std::string& file) {
    return object_of({{"type", text_value("write", test.place)},
                      {"in", text_value(test.output, test.place)},
                      {"file", text_value(file, test.place)},
                      {"depth", text_value("float", test.place)}},
                     test.place);
}

std::string json_of(const Value& value) { return JsonWriter().value(value).text(); }

// Nodes by themselves: images are read by nodes of their names.
std::unique_ptr<const Graph> graph_of_nodes(const GraphTest& test, const TemporaryFolder& folder,
                                            const std::string& made, Diagnostics& diagnostics) {
    Value nodes = test.nodes;
    for (const auto& [name, file] : image_files(test, folder))
        nodes.members.push_back(
            {name, test.place,
             object_of({{"type", text_value("read", test.place)}, {"file", text_value(file, test.place)}},
                       test.place)});
    nodes.members.push_back({"test_output", test.place, write_node(test, made)});
    Value root = object_of({{"keyline", number_value(1, test.place)}}, test.place);
    root.members.push_back({"nodes", test.place, std::move(nodes)});
    if (!test.values.members.empty()) root.members.push_back({"variables", test.place, test.values});
    LoadOptions options;
    options.frame = test.frame;
    auto graph = Graph::of_what_is_sound(root, test.folder, options, diagnostics);
    return diagnostics.ok() ? std::move(graph) : nullptr;
}

// A graph file: images take the place of the files that its nodes read.
std::unique_ptr<const Graph> graph_of_file(const GraphTest& test, const TemporaryFolder& folder,
                                           const std::string& made, Diagnostics& diagnostics) {
    LoadOptions options;
    options.frame = test.frame;
    const auto set = [&](const std::string& target, const std::string& value) {
        options.set.push_back({target, value, fmt::format("{}, {}", test.place.text(), target)});
    };
    for (const auto& [name, file] : image_files(test, folder)) set(name + ".file", file);
    for (const Member& m : test.set) set(m.key, json_of(m.value));
    for (const Member& m : test.values.members)
        options.var.push_back({m.key, json_of(m.value), fmt::format("{}, {}", test.place.text(), m.key)});
    options.added = json_of(object_of({{kWrite, write_node(test, made)}}, test.place));
    options.only = {kWrite};
    return Graph::load(in_folder(test.folder, test.graph), options, diagnostics);
}

class Listener final : public RenderObserver {
public:
    explicit Listener(Diagnostics& told) : told_(told) {}
    void warning(const Error& e) override { told_.warning(e); }
    void error(const Error& e) override { told_.error(e); }

private:
    Diagnostics& told_;
};

// Renders what the test looks at; what is wrong is told.
void make(const Graph& graph, const GraphTest& test, Diagnostics& told) {
    RenderOptions options;
    options.frames = {test.frame};
    options.provenance = false;
    Listener listener(told);
    const std::atomic<bool> never = false;
    render(graph, options, listener, never);
}

double sample_at(const ImageSource& source, const std::string& channel, int x, int y) {
    for (const PixelSample& s : pixel_of(source, x, y).samples)
        if (s.channel == channel) return s.value;
    return 0;
}

std::string plural(int64_t n, const char* what) { return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s"); }

std::vector<std::string> compare(const ImageSource& expected, const ImageSource& made, const GraphTest& test,
                                 bool is_file) {
    const PictureDifferences found = differences_of(expected, made, "", test.tolerance, nullptr);
    std::vector<std::string> out;
    if (found.display)
        out.push_back(fmt::format("it is {}, expected {}", to_string(made.header().display_window),
                                  to_string(expected.header().display_window)));
    for (const std::string& name : found.only_in_a)
        out.push_back(fmt::format("there is no channel {}", in_quotes(name)));
    if (is_file)
        for (const std::string& name : found.only_in_b)
            out.push_back(fmt::format("the channel {} is not expected", in_quotes(name)));
    for (const ChannelDifference& c : found.channels) {
        if (c.different == 0) continue;
        out.push_back(
            fmt::format("channel {}: {} of {} differ, the most at ({}, {}): {:.6g}, expected {:.6g}",
                        in_quotes(c.channel), c.different, plural(c.samples, "sample"), c.x, c.y,
                        sample_at(made, c.channel, c.x, c.y), sample_at(expected, c.channel, c.x, c.y)));
    }
    return out;
}

// One grid without a name is compared with the only channel that there is.
std::vector<std::string> compare_with_image(const GraphTest& test, const std::string& made,
                                            const TemporaryFolder& folder) {
    TestImage image = read_test_image(*test.expected);
    const auto source = open_image(made);
    if (image.is_unnamed) {
        std::vector<std::string> names;
        for (const ChannelGroup& g : source->header().groups)
            for (const ChannelInfo& c : g.channels) names.push_back(c.name);
        if (names.size() != 1)
            return {fmt::format("it has the channels {}; say which a grid is of, as in {{ \"{}\": … }}",
                                listed(names), names[0])};
        image.channels.front().name = names.front();
    }
    const std::string expected = folder / "expected.exr";
    write_test_image(image, expected);
    return compare(*open_image(expected), *source, test, false);
}

void compare_with_file(const GraphTest& test, const std::string& file, const std::string& made, bool bless,
                       TestResult& out) {
    const std::string golden = in_folder(test.folder, file);
    std::error_code error;
    if (fs::exists(golden, error))
        out.faults = compare(*open_image(golden), *open_image(made), test, true);
    else
        out.faults.push_back(fmt::format("{} is not there; --bless makes it", in_quotes(file)));
    if (out.faults.empty() || !bless) return;
    fs::create_directories(fs::path(golden).parent_path());
    fs::copy_file(made, golden, fs::copy_options::overwrite_existing);
    out.faults.clear();
    out.blessed = true;
}

// What was told must be what is expected, and no error beside it.
void compare_messages(const GraphTest& test, const Diagnostics& told, TestResult& out) {
    const auto is_told = [](const std::vector<Error>& all, const std::string& wanted) {
        return std::ranges::any_of(
            all, [&](const Error& e) { return e.text().find(wanted) != std::string::npos; });
    };
    if (!test.error.empty() && !is_told(told.errors(), test.error))
        out.faults.push_back(fmt::format("no error says {}", in_quotes(test.error)));
    if (!test.warning.empty() && !is_told(told.warnings(), test.warning))
        out.faults.push_back(fmt::format("no warning says {}", in_quotes(test.warning)));
    if (test.error.empty() || !out.faults.empty())
        for (const Error& e : told.errors()) out.faults.push_back(e.text());
}

void note_what_is_touched(const Graph& graph, const GraphTest& test, TestResult& out) {
    for (const int i : graph.nodes_in_use())
        out.reached.insert(graph.nodes()[static_cast<std::size_t>(i)].id);
    out.branches = branches_of(graph, test.frame).taken;
    for (const Member& node : test.nodes.members)
        if (const Value* type = node.value.find("type"))
            for (const Member& m : node.value.members) out.parameters.insert(type->text + "." + m.key);
}

void run(const GraphTest& test, bool bless, TestResult& out) {
    const TemporaryFolder folder;
    const std::string made = folder / "made.exr";
    Diagnostics told;
    const auto graph = test.graph.empty() ? graph_of_nodes(test, folder, made, told)
                                          : graph_of_file(test, folder, made, told);
    if (graph) {
        note_what_is_touched(*graph, test, out);
        make(*graph, test, told);
    }
    compare_messages(test, told, out);
    if (!test.expected || !out.faults.empty() || !told.ok()) return;
    const Value* file = test.expected->is(Kind::kObject) ? test.expected->find("file") : nullptr;
    if (file)
        compare_with_file(test, file->text, made, bless, out);
    else
        out.faults = compare_with_image(test, made, folder);
}

}  // namespace

Branches branches_of(const Graph& graph, int frame) {
    Branches out;
    for (const Variables::Chosen& v : graph.variables().chosen()) {
        for (const std::string& choice : v.choices)
            out.all.insert(fmt::format("{} = {}", v.name, in_quotes(choice)));
        out.taken.insert(fmt::format("{} = {}", v.name, in_quotes(v.now)));
    }
    Diagnostics told;  // by the loader
    for (int i = 0; const GraphNode& node : graph.nodes()) {
        const int index = i++;
        if (!node.enabled) continue;
        const std::string yes = in_quotes(node.id) + " enabled", no = in_quotes(node.id) + " not enabled";
        out.all.insert({yes, no});
        out.taken.insert(graph.is_enabled(index, frame, told).value_or(true) ? yes : no);
    }
    return out;
}

TestResult run_graph_test(const GraphTest& test, bool bless) {
    const auto begin = std::chrono::steady_clock::now();
    TestResult out;
    try {
        run(test, bless, out);
    } catch (...) {
        out.faults.push_back(error_of(std::current_exception()).text());
    }
    out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return out;
}

}  // namespace keyline::cli

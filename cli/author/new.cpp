// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/author/commands.h"
#include "cli/author/starter.h"
#include "cli/common/options.h"
#include "cli/common/report.h"
#include "cli/common/sequences.h"
#include "engine/base/text.h"
#include "engine/io/text_file.h"
#include "engine/params/file_name.h"
#include "engine/params/frames.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include <string>
#include <unistd.h>
#include <vector>

namespace keyline::cli {

namespace {

namespace fs = std::filesystem;

struct NewArguments {
    std::string image, file, look;
    bool still = false, force = false;
};

struct NamedLook {
    const char* name;
    Look look;
    const char* help;
};
constexpr std::array kLooks{NamedLook{"drawing", Look::kDrawing, "flat tones under ink"},
                            NamedLook{"over", Look::kOver, "ink over the render"},
                            NamedLook{"lines", Look::kLines, "ink on paper"}};

// What is read: a file, or all frames of one.
struct Plate {
    std::string name;         // as a graph has it
    std::string first;        // the file that is looked at
    std::vector<int> frames;  // that are on disk; none of a single file
};

// What a file's name has that would mean something in a graph means itself.
std::string as_letters(const std::string& name) {
    std::string out;
    for (const char c : name)
        out += std::string_view("#$@~%\\").find(c) == std::string::npos ? std::string(1, c)
                                                                        : std::string("\\") + c;
    return out;
}

Plate plate_of(const NewArguments& arguments) {
    const std::vector<std::string> files = files_of(arguments.image);
    if (files.front() != arguments.image)
        return {arguments.image, files.front(), FileName(arguments.image).frames_on_disk()};
    const std::string name = as_letters(arguments.image), pattern = with_frame_number(name);
    if (!arguments.still && pattern != name) {
        std::vector<int> frames = FileName(pattern).frames_on_disk();
        if (frames.size() > 1) return {pattern, arguments.image, std::move(frames)};
    }
    return {name, arguments.image, {}};
}

// "street" of plates/street.####.exr.
std::string short_name(const Plate& plate) {
    std::string out = fs::path(plate.name).stem().string();
    std::erase(out, '\\');
    if (!plate.frames.empty()) out = out.substr(0, out.find('#'));
    while (!out.empty() && std::string_view("._-").find(out.back()) != std::string_view::npos) out.pop_back();
    return out.empty() ? "graph" : out;
}

std::vector<const NamedLook*> possible_looks(const RenderPasses& passes) {
    std::vector<const NamedLook*> out;
    for (const NamedLook& l : kLooks)
        if (can_look(l.look, passes)) out.push_back(&l);
    return out;
}

std::vector<std::string> names_of(const std::vector<const NamedLook*>& looks) {
    std::vector<std::string> out;
    for (const NamedLook* l : looks) out.emplace_back(l->name);
    return out;
}

const NamedLook& look_called(const std::string& name, const std::vector<const NamedLook*>& possible) {
    for (const NamedLook* l : possible)
        if (name == l->name) return *l;
    const bool is_one = std::ranges::any_of(kLooks, [&](const NamedLook& l) { return name == l.name; });
    throw Failure({ErrorKind::kGraph,
                   {"--look " + name, 0, 0},
                   {},
                   is_one ? "the image lacks passes for it" : "there is no such look",
                   "possible: " + listed(names_of(possible))});
}

bool can_ask() { return isatty(STDIN_FILENO) != 0 && isatty(STDERR_FILENO) != 0; }

// The answer, or what is offered where there is none.
std::string ask(const std::string& question, const std::string& offered) {
    std::cerr << fmt::format("{} [{}] ", question, escaped(offered)) << std::flush;
    std::string answer;
    std::getline(std::cin, answer);
    return answer.empty() ? offered : answer;
}

std::string ask_for_look(const std::vector<const NamedLook*>& possible) {
    std::string question;
    for (const NamedLook* l : possible)
        question += fmt::format("{}{}: {}", question.empty() ? "" : ", ", l->name, l->help);
    return ask("The look (" + question + ")?", possible.front()->name);
}

// What was found, so that what is missing shows.
std::string found(const RenderPasses& p) {
    std::vector<std::string> out;
    const auto add = [&](const char* what, const std::string& name) {
        if (!name.empty()) out.push_back(fmt::format("{} {}", what, name == "." ? "R G B" : in_quotes(name)));
    };
    add("beauty", p.beauty);
    add("albedo", p.albedo);
    add("light", p.light);
    add("normals", p.normal);
    add("depth", p.depth);
    add("objects", p.objects);
    add("materials", p.materials);
    return fmt::format("{}", fmt::join(out, ", "));
}

// As the graph names a file: from its own folder.
std::string seen_from(const std::string& graph, const std::string& name) {
    const fs::path file(name);
    if (file.is_absolute()) return name;
    const fs::path folder =
        graph.empty() || graph == "-" ? fs::current_path() : fs::absolute(graph).parent_path();
    return fs::absolute(file).lexically_relative(folder.lexically_normal()).string();
}

void write_graph(const NewArguments& arguments, const std::string& text) {
    if (arguments.file.empty() || arguments.file == "-") return print_result(text);
    std::error_code error;
    if (!arguments.force && fs::exists(arguments.file, error))
        fail(ErrorKind::kOutput, fmt::format("{}: there is a file of this name", escaped(arguments.file)),
             "choose another, or replace it with --force");
    write_text_file(arguments.file, text);
}

void tell(const NewArguments& arguments, const RenderPasses& passes, const Plate& plate) {
    print_message("found " + found(passes));
    if (arguments.file.empty() || arguments.file == "-") return;
    const std::string graph = shell_word(arguments.file);
    const std::string frames = plate.frames.empty() ? "" : " --frames all";
    print_message(fmt::format("look at it:  keyline view {} comp\nmake it:     keyline render {}{}", graph,
                              graph, frames));
}

int run(NewArguments arguments) {
    const Plate plate = plate_of(arguments);
    const auto source = open_image(plate.first);
    Starter starter;
    starter.passes = find_passes(*source);
    const std::vector<const NamedLook*> possible = possible_looks(starter.passes);
    if (possible.empty())
        fail(ErrorKind::kInput,
             fmt::format(
                 "{}: no layer in it is called as renderers call colour, normals or depth, and there is "
                 "no Cryptomatte",
                 escaped(plate.first)),
             "'keyline info' lists its layers");
    if (arguments.look.empty()) arguments.look = can_ask() ? ask_for_look(possible) : possible.front()->name;
    starter.look = look_called(arguments.look, possible).look;
    if (arguments.file.empty() && can_ask())
        arguments.file = ask("The graph's file?", short_name(plate) + ".json");
    starter.levels = levels_of(*source, starter.passes);
    starter.plate = seen_from(arguments.file, plate.name);
    starter.out = "out/" + short_name(plate) + (plate.frames.empty() ? "" : ".####");
    write_graph(arguments, starter_graph(starter));
    tell(arguments, starter.passes, plate);
    return 0;
}

}  // namespace

void add_new(const Command& program) {
    const Command command =
        program.add("new", "Write a first graph for the passes that a render has; asks on a terminal");
    const auto arguments = std::make_shared<NewArguments>();
    command.argument(
        "IMAGE", arguments->image,
        "A frame of the render, or street.####.exr; where others lie beside it, the graph reads all");
    command.option("-o,--graph", arguments->file, "FILE",
                   "Where the graph goes; standard output when absent");
    command.option("--look", arguments->look, "drawing|over|lines",
                   "Flat tones under ink, ink over the render, or ink on paper; the first that the passes "
                   "allow when absent");
    command.flag("--still", arguments->still, "Read this file for every frame");
    command.flag("--force", arguments->force, "Replace a file that is there");
    command.runs([arguments] { return run(*arguments); });
}

}  // namespace keyline::cli

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/image_source.h"
#include "tests/io/exr_files.h"
#include "tests/program/program.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <map>

// keyline new: first graphs, which run as they are.

namespace keyline::test {

namespace {

using ::testing::HasSubstr;
using ::testing::Not;

using Names = std::map<std::string, std::string>;  // of layers of the plate, and what they become

// How one renderer calls what the plate has.
struct Renderer {
    std::string name;
    Names layers;       // "" for none
    Names components;   // of all layers but those of a Cryptomatte: "R" → "red"
    std::string found;  // what new says
};

std::string renamed(const std::string& channel, const Renderer& renderer) {
    const std::size_t dot = channel.rfind('.');
    const std::string layer = channel.substr(0, dot), base = channel.substr(dot + 1);
    const auto it = renderer.layers.find(layer);
    if (it == renderer.layers.end()) return "";
    const auto component = renderer.components.find(layer.substr(layer.find('.') + 1) + "." + base);
    const std::string to = component == renderer.components.end() ? base : component->second;
    return it->second.empty() ? to : it->second + "." + to;
}

std::vector<Renderer> renderers() {
    const std::string crypto = "ViewLayer.CryptoObject00";
    const auto named = [&](const char* beauty, const char* albedo, const char* light, const char* normal,
                           const char* depth, const char* objects) {
        return Names{{"ViewLayer.Combined", beauty}, {"ViewLayer.DiffCol", albedo},
                     {"ViewLayer.DiffDir", light},   {"ViewLayer.Normal", normal},
                     {"ViewLayer.Depth", depth},     {crypto, objects}};
    };
    return {{"cycles",
             named("ViewLayer.Combined", "ViewLayer.DiffCol", "ViewLayer.DiffDir", "ViewLayer.Normal",
                   "ViewLayer.Depth", "ViewLayer.CryptoObject00"),
             {},
             "found beauty 'Combined', albedo 'DiffCol', light 'DiffDir', normals 'Normal', depth 'Depth', "
             "objects 'CryptoObject'"},
            {"cycles5",
             named("ViewLayer.Combined", "ViewLayer.Diffuse Color", "ViewLayer.Diffuse Direct",
                   "ViewLayer.Normal", "ViewLayer.Depth", "ViewLayer.CryptoObject00"),
             {{"Depth.Z", "V"}},
             "found beauty 'Combined', albedo 'Diffuse Color', light 'Diffuse Direct', normals 'Normal', "
             "depth 'Depth', objects 'CryptoObject'"},
            {"arnold",
             named("", "diffuse_albedo", "diffuse_direct", "N", "", "crypto_object00"),
             {},
             "found beauty R G B, albedo 'diffuse_albedo', light 'diffuse_direct', normals 'N', depth 'Z', "
             "objects 'crypto_object'"},
            {"karma",
             named("C", "albedo", "directdiffuse", "N", "depth", "CryptoObject00"),
             {{"Normal.X", "x"}, {"Normal.Y", "y"}, {"Normal.Z", "z"}},
             "found beauty 'C', albedo 'albedo', light 'directdiffuse', normals 'N', depth 'depth', objects "
             "'CryptoObject'"},
            {"renderman",
             named("", "albedo", "directDiffuse", "Nn", "", "CryptoObject00"),
             {{"Normal.X", "R"}, {"Normal.Y", "G"}, {"Normal.Z", "B"}, {"Depth.Z", "z"}},
             "found beauty R G B, albedo 'albedo', light 'directDiffuse', normals 'Nn', depth 'z', objects "
             "'CryptoObject'"},
            {"redshift",
             named("", "DiffuseFilter", "DiffuseLightingRaw", "N", "", "Cryptomatte00"),
             {},
             "found beauty R G B, albedo 'DiffuseFilter', light 'DiffuseLightingRaw', normals 'N', depth "
             "'Z', objects 'Cryptomatte'"},
            {"vray",
             named("", "diffuse", "rawLight", "normals", "zDepth", "cryptomatte00"),
             {{"DiffCol.R", "red"}, {"DiffCol.G", "green"}, {"DiffCol.B", "blue"}},
             "found beauty R G B, albedo 'diffuse', light 'rawLight', normals 'normals', depth 'zDepth', "
             "objects 'cryptomatte'"}};
}

class New : public ProgramTest {
protected:
    // A plate as a renderer would have named it.
    void plate(const Renderer& renderer, const std::string& name) const {
        const fs::path from = plates() / "street_passes.0024.exr";
        const Image image = read_with_openexr(from);
        Image out;
        for (const auto& [channel, pixels] : image)
            if (const std::string to = renamed(channel, renderer); !to.empty()) out[to] = pixels;
        const auto source = open_image(from);
        SinkSpec spec;
        spec.display_window = source->header().display_window;
        spec.data_window = source->header().data_window;
        for (Attribute a : source->header().metadata.attributes()) {
            auto* text = std::get_if<std::string>(&a.value);
            if (text && *text == "ViewLayer.CryptoObject") {
                const std::string level = renderer.layers.at("ViewLayer.CryptoObject00");
                *text = level.substr(0, level.size() - 2);
            }
            spec.metadata.set(std::move(a));
        }
        write_with_keyline(folder() / name, out, spec);
    }

    Outcome make(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "new");
        return keyline(arguments);
    }
    void copy(const std::string& plate, const std::string& name) const {
        fs::copy(plates() / plate, folder() / name);
    }
};

TEST_F(New, FindsThePassesOfEveryRenderer) {
    for (const Renderer& renderer : renderers()) {
        SCOPED_TRACE(renderer.name);
        plate(renderer, renderer.name + ".exr");
        const Outcome made = make({renderer.name + ".exr", "-o", renderer.name + ".json"});
        EXPECT_EQ(made.status, 0) << made.err;
        EXPECT_THAT(made.err, HasSubstr(renderer.found + "\n"));
        const Outcome rendered =
            keyline({"render", renderer.name + ".json", "--only", "png", "--no-provenance"});
        EXPECT_EQ(rendered.status, 0) << rendered.err;
        EXPECT_THAT(rendered.err, Not(HasSubstr("warning")));
    }
    // Where the light stands for the same, so does the picture.
    for (const char* name : {"cycles5", "redshift", "vray"})
        EXPECT_EQ(read(folder() / "out" / fmt::format("{}.png", name)), read(folder() / "out/cycles.png"))
            << name;
}

TEST_F(New, LooksAtOnce) {
    copy("street_passes.0024.exr", "street.exr");
    for (const char* look : {"drawing", "over", "lines"}) {
        const std::string graph = fmt::format("{}.json", look);
        EXPECT_EQ(make({"street.exr", "--look", look, "-o", graph}).status, 0);
        EXPECT_EQ(keyline({"fmt", "--check", graph}).status, 0);
        EXPECT_EQ(keyline({"check", graph}).err, "");
    }
    EXPECT_THAT(read(folder() / "lines.json"), Not(HasSubstr("sunny")));
}

// Light parts where somebody put it by hand: at 0.34 to 0.46 in graphs/toon.json.
TEST_F(New, MeasuresTheFrame) {
    const std::string graph = make({(plates() / "street_passes.0024.exr").string()}).out;
    EXPECT_THAT(graph, HasSubstr(R"("low": 0.37, "high": 0.5)"));
    EXPECT_THAT(graph, HasSubstr(R"("reference": 9.1)"));
    EXPECT_THAT(graph, HasSubstr("as metal, stays as it is rendered"));
    EXPECT_THAT(make({(plates() / "garden.0012.exr").string()}).out, Not(HasSubstr("metal")));
}

TEST_F(New, ReadsAllFramesThatLieBesideTheOneGiven) {
    for (const char* frame : {"0001", "0002"})
        copy(fmt::format("street.{}.exr", frame), fmt::format("street.{}.exr", frame));
    EXPECT_EQ(make({"street.0002.exr", "-o", "graphs/all.json"}).status, 0);
    const std::string all = read(folder() / "graphs/all.json");
    EXPECT_THAT(all, HasSubstr(R"("plate": "../street.####.exr")"));
    EXPECT_THAT(all, HasSubstr(R"("look": "out/street.####.png")"));
    EXPECT_EQ(keyline({"check", "graphs/all.json", "--frames", "all"}).status, 0);
    EXPECT_THAT(make({"street.####.exr"}).out, HasSubstr(R"("plate": "street.####.exr")"));
    EXPECT_THAT(make({"street.0002.exr", "--still"}).out, HasSubstr(R"("plate": "street.0002.exr")"));
}

TEST_F(New, AsksOnATerminal) {
    copy("street.0001.exr", "street.exr");
    const Outcome run = keyline({"new", "street.exr"}, {.environment = {"ANSWERS=lines\n\n", "TERM=dumb"},
                                                        .through = KEYLINE_TERMINAL});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.err,
                HasSubstr("The look (drawing: flat tones under ink, over: ink over the render, lines: "
                          "ink on paper)? [drawing] "));
    EXPECT_THAT(run.err, HasSubstr("The graph's file? [street.json] "));
    EXPECT_THAT(read(folder() / "street.json"), HasSubstr("Ink on paper"));
}

TEST_F(New, WhatCantBeIsTold) {
    copy("street.0001.exr", "street.exr");
    write("there.json", "mine");
    const Outcome there = make({"street.exr", "-o", "there.json"});
    EXPECT_EQ(there.status, 4);
    EXPECT_EQ(
        there.err,
        "error: there.json: there is a file of this name; choose another, or replace it with --force\n");
    EXPECT_EQ(read(folder() / "there.json"), "mine");
    EXPECT_EQ(make({"street.exr", "-o", "there.json", "--force"}).status, 0);
    EXPECT_THAT(
        make({"street.exr", "--look", "oil"}).err,
        HasSubstr("--look oil: error: there is no such look; possible: 'drawing', 'over' and 'lines'"));
    EXPECT_EQ(make({"none.exr"}).status, 3);

    graph(
        R"("r": { "type": "read", "file": "street.exr" }, "m": { "type": "shuffle", "in": "r:UV", "channels": { "U": "U" } },
             "o": { "type": "write", "in": "m", "file": "odd.exr" })");
    ASSERT_EQ(keyline({"render", "graph.json"}).status, 0);
    const Outcome odd = make({"odd.exr"});
    EXPECT_EQ(odd.status, 3);
    EXPECT_THAT(odd.err, HasSubstr("no layer in it is called as renderers call colour, normals or depth"));
}

}  // namespace

}  // namespace keyline::test

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/commands.h"

#include <cstdlib>
#include <fmt/format.h>
#include <iterator>
#include <sstream>
#include <unistd.h>

namespace keyline::bench {

namespace fs = std::filesystem;

namespace {

const fs::path kSources = fs::path(KEYLINE_SOURCE_DIR) / "bench";

Command words(const std::string& text) {
    std::istringstream in(text);
    return {std::istream_iterator<std::string>(in), {}};
}

Command oiiotool_read(const Plate& plate, int threads) {
    const std::string layer = "ViewLayer.Combined.";
    return Command{"oiiotool", "--threads", std::to_string(threads),
                   fmt::format("-i:ch={0}R,{0}G,{0}B,{0}A", layer), plate.file} +
           words("--chnames R,G,B,A");
}

Command oiiotool_write(const fs::path& out) { return words("-d half --compression zip -o") + Command{out}; }

Command render(const std::string& graph, const fs::path& plate, const fs::path& out, int threads) {
    return Command{programs() / "keyline", "render", kSources / graph} +
           Command{"--var", "plate=" + plate.string(), "--var", "out=" + out.string()} +
           words(fmt::format("--threads {} --progress none", threads));
}

// It has no gradient, no thinning and no hysteresis: a threshold on the Laplacian stands for them.
Command oiiotool_lines() {
    return words(
        "--label beauty --chsum:weight=0.2126,0.7152,0.0722,0 --kernel gaussian 9x9 --convolve "
        "--laplacian --abs --subc 0.02 --mulc 1e6 --clamp:min=0:max=1 --dilate 3x3 "
        "--ch 0,0,0,0 --chnames R,G,B,A --mulc 0.02,0.02,0.03,1 beauty --over");
}

Command blender_job(const Plate& plate, const fs::path& out, int threads) {
    return words(fmt::format("blender --background --factory-startup --threads {} --python-exit-code 1 "
                             "--python",
                             threads)) +
           Command{kSources / "blender_job.py",  "--", plate.file, std::to_string(plate.width),
                   std::to_string(plate.height), out};
}

// It reads no layers: one channel of the beauty pass is laid out for it, in a format that costs next to
// nothing.
Peer vips(const std::string& name, const fs::path& folder, const std::string& operation,
          const Command& options, int threads) {
    const fs::path grey = folder / "grey.v";
    return {name, "vips",
            Command{"vips", operation, grey, folder / "vips.v"} + options +
                Command{"--vips-concurrency=" + std::to_string(threads)},
            Command{"vips", "extract_band", folder / "copy.exr", grey, "1"}};
}

}  // namespace

Command operator+(Command a, const Command& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

fs::path programs() {
    static const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
    return folder;
}

Command keyline_job(const fs::path& plate, const fs::path& out, int threads, const Command& more) {
    return render("lines.json", plate, out, threads) + more;
}

Command keyline_toon(const fs::path& plate, const fs::path& out, int threads) {
    return render("toon.json", plate, out, threads);
}

Command openexr_copy(const fs::path& plate, const fs::path& out, int threads) {
    return {programs() / "bench_exr_copy", plate, "ViewLayer.Combined", out, std::to_string(threads)};
}

Command openexr_copy_of_toon(const fs::path& plate, const fs::path& out, int threads) {
    return openexr_copy(plate, out, threads) +
           words("ViewLayer.DiffCol ViewLayer.Normal ViewLayer.Depth ViewLayer.CryptoObject00");
}

Command mosaic(const fs::path& plate, int n, const fs::path& out) {
    return {programs() / "bench_mosaic", plate, std::to_string(n), out};
}

std::vector<Peer> peers(const Plate& plate, const fs::path& folder, int threads) {
    return {
        {"Blender's compositor: blur, Sobel, threshold, dilate, alpha over",
         "blender",
         blender_job(plate, folder / "blender.exr", threads),
         {}},
        {"oiiotool: blur, Laplacian, threshold, dilate, over",
         "oiiotool",
         oiiotool_read(plate, threads) + oiiotool_lines() + oiiotool_write(folder / "oiiotool.exr"),
         {}},
        {"oiiotool: copy of the beauty pass",
         "oiiotool",
         oiiotool_read(plate, threads) + oiiotool_write(folder / "oiiotool.exr"),
         {}},
        vips("libvips: canny of one channel, from and to its own format", folder, "canny", {"--sigma", "1.4"},
             threads),
        vips("libvips: the same without canny", folder, "copy", {}, threads),
    };
}

bool is_installed(const std::string& program) {
    std::istringstream path(std::getenv("PATH") ? std::getenv("PATH") : "");
    for (std::string folder; std::getline(path, folder, ':');)
        if (access((fs::path(folder) / program).c_str(), X_OK) == 0) return true;
    return false;
}

}  // namespace keyline::bench

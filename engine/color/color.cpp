// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/color/color.h"

#include "engine/base/bad_value.h"
#include "engine/color/color_builtin.h"

#include <OpenColorIO/OpenColorIO.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string_view>
#include <unistd.h>

namespace keyline {

namespace ocio = OCIO_NAMESPACE;

namespace {

// OpenColorIO's default but for its approximate log, exp and pow, which builds with SSE use and others do
// not.  (Its faster inverse of look-up tables stays: every program that shows these colours has it.)
constexpr auto kOptimization =
    static_cast<ocio::OptimizationFlags>(ocio::OPTIMIZATION_DEFAULT & ~ocio::OPTIMIZATION_FAST_LOG_EXP_POW);

}  // namespace

struct ColorTransform::Impl {
    ocio::ConstCPUProcessorRcPtr processor;
};

struct ColorConfig::Impl {
    ocio::ConstConfigRcPtr config;
    ocio::ConstContextRcPtr context = config->getCurrentContext();

    // Null for a transform that changes nothing.  Throws OpenColorIO's exceptions.
    std::shared_ptr<const ColorTransform::Impl> processed(const ocio::ConstTransformRcPtr& transform) const {
        auto processor = config->getProcessor(context, transform, ocio::TRANSFORM_DIR_FORWARD)
                             ->getOptimizedCPUProcessor(kOptimization);
        if (processor->isNoOp()) return nullptr;
        return std::make_shared<const ColorTransform::Impl>(ColorTransform::Impl{std::move(processor)});
    }

    std::shared_ptr<const ColorTransform::Impl> prepare(const ocio::ConstTransformRcPtr& transform,
                                                        const std::string& what) const;
};

namespace {

// Pixels that go through OpenColorIO at once: small enough for the stack and the first cache.
constexpr std::size_t kBatch = 256;

enum class Alpha { kStraight, kPremultiplied };

// One pixel of a premultiplied picture is divided and multiplied by this.  NaN compares false.
float divisor(const float* a, std::size_t i) { return a != nullptr && a[i] > 0.0F ? a[i] : 1.0F; }

// Always packed RGBA from one aligned buffer: OpenColorIO then works in place, row by row, without buffers
// of its own, and no pixel can land in another code path because of its address.
template <Alpha alpha>
void apply_batch(const ocio::CPUProcessor& processor, std::array<float*, 3> rgb, const float* a,
                 std::size_t n) {
    alignas(64) std::array<float, 4 * kBatch> pixels;
    for (std::size_t i = 0; i < n; ++i) {
        const float d = alpha == Alpha::kPremultiplied ? divisor(a, i) : 1.0F;
        for (std::size_t c = 0; c < 3; ++c) pixels[4 * i + c] = rgb[c][i] / d;
        pixels[4 * i + 3] = a != nullptr ? a[i] : 1.0F;
    }
    ocio::PackedImageDesc row(pixels.data(), static_cast<long>(n), 1, 4);
    processor.apply(row);
    for (std::size_t i = 0; i < n; ++i) {
        const float d = alpha == Alpha::kPremultiplied ? divisor(a, i) : 1.0F;
        for (std::size_t c = 0; c < 3; ++c) rgb[c][i] = pixels[4 * i + c] * d;
    }
}

template <Alpha alpha>
void apply_batches(const ocio::CPUProcessor& processor, std::array<float*, 3> rgb, const float* a,
                   std::size_t n) {
    for (std::size_t done = 0; done < n; done += kBatch) {
        apply_batch<alpha>(processor, {rgb[0] + done, rgb[1] + done, rgb[2] + done},
                           a != nullptr ? a + done : nullptr, std::min(kBatch, n - done));
    }
}

// Whole, where in_quotes() would cut: a long path that ends early names no file.
std::string quoted(const std::filesystem::path& file) { return fmt::format("'{}'", file.string()); }

// OpenColorIO's message on one line, without the words in front that repeat the file's name.
std::string told_by(const std::exception& e) {
    std::string text = e.what();
    const std::string_view opening = "Error: Loading the OCIO profile '", end = "' failed. ";
    const std::size_t at = text.find(end);
    if (text.starts_with(opening) && at != std::string::npos) text.erase(0, at + end.size());
    std::ranges::replace_if(
        text, [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
    while (text.ends_with('.') || text.ends_with(' ')) text.pop_back();
    return text;
}

struct Version {
    unsigned major = 0, minor = 0;
    auto operator<=>(const Version&) const = default;
    std::string text() const { return fmt::format("{}.{}", major, minor); }
};

Version library_version() {
    const auto v = static_cast<unsigned>(ocio::GetVersionHex());
    return {v >> 24U, v >> 16U & 0xFFU};
}

// The version that a config's text claims; 0.0 where it claims none.
Version claimed_version(std::string_view text) {
    const std::string_view key = "ocio_profile_version";
    const std::size_t at = text.find(key);
    if (at == std::string_view::npos) return {};
    text.remove_prefix(at + key.size());
    text.remove_prefix(std::min(text.find_first_not_of(" \t:\"'"), text.size()));
    Version version;
    const char* const end = text.data() + text.size();
    const auto major = std::from_chars(text.data(), end, version.major);
    if (major.ec == std::errc{} && major.ptr != end && *major.ptr == '.')
        std::from_chars(major.ptr + 1, end, version.minor);
    return version;
}

std::string text_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

[[noreturn]] void fail_to_load(const std::filesystem::path& file, const std::exception& e) {
    const Version claimed = claimed_version(text_of(file)), known = library_version();
    if (claimed > known) {
        fail(ErrorKind::kInput,
             fmt::format("OCIO config {} is of version {}, which is later than this build knows; "
                         "OpenColorIO {} reads versions up to {}",
                         quoted(file), claimed.text(), ocio::GetVersion(), known.text()),
             "use an older version of the config, or the built-in one");
    }
    fail(ErrorKind::kInput, fmt::format("can't read OCIO config {}: {}", quoted(file), told_by(e)));
}

// "; 'DIR' holds 'a.ocio' and 'b.ocio'", or why it holds none.
std::string configs_beside(const std::filesystem::path& file) {
    std::error_code error;
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    if (!std::filesystem::is_directory(folder, error))
        return fmt::format("there is no folder {} either", quoted(folder));
    std::vector<std::string> configs;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error))
        if (entry.path().extension() == ".ocio") configs.push_back(entry.path().filename().string());
    std::ranges::sort(configs);
    if (configs.empty()) return fmt::format("{} holds no .ocio file", quoted(folder));
    return fmt::format("{} holds {}", quoted(folder), listed(configs));
}

void require_file(const std::filesystem::path& file) {
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (std::filesystem::is_regular_file(status)) return;
    if (std::filesystem::exists(status))
        fail(ErrorKind::kInput, fmt::format("OCIO config {} is not a file", quoted(file)));
    fail(ErrorKind::kInput, fmt::format("there is no OCIO config {}; {}", quoted(file), configs_beside(file)),
         "without one, the built-in config is used");
}

std::vector<std::string> roles(const ocio::Config& config) {
    std::vector<std::string> names;
    for (int i = 0; i < config.getNumRoles(); ++i) names.emplace_back(config.getRoleName(i));
    return names;
}

// Every name that stands for a space: its own, its aliases, roles.
std::vector<std::string> space_names(const ocio::Config& config) {
    std::vector<std::string> names = roles(config);
    for (int i = 0; i < config.getNumColorSpaces(); ++i) {
        const auto space = config.getColorSpace(config.getColorSpaceNameByIndex(i));
        names.emplace_back(space->getName());
        for (std::size_t k = 0; k < space->getNumAliases(); ++k) names.emplace_back(space->getAlias(k));
    }
    return names;
}

ocio::TransformDirection direction_of(bool inverse) {
    return inverse ? ocio::TRANSFORM_DIR_INVERSE : ocio::TRANSFORM_DIR_FORWARD;
}

// The names in "+grade, -warm | grade"; of alternatives, which OpenColorIO tries in order, each.
std::vector<std::string> split_looks(const std::string& looks) {
    std::vector<std::string> out;
    for (std::size_t begin = 0; begin < looks.size();) {
        const std::size_t end = std::min(looks.find_first_of(",:|", begin), looks.size());
        std::string name = looks.substr(begin, end - begin);
        name.erase(0, std::min(name.find_first_not_of(" +-"), name.size()));
        name.erase(name.find_last_not_of(' ') + 1);
        if (!name.empty()) out.push_back(std::move(name));
        begin = end + 1;
    }
    return out;
}

[[noreturn]] void refuse_named(const ocio::Config& config, const std::string& transform,
                               const std::string& config_name) {
    std::vector<std::string> known;
    for (int i = 0; i < config.getNumNamedTransforms(); ++i)
        known.emplace_back(config.getNamedTransformNameByIndex(i));
    throw BadValue(transform,
                   known.empty() ? fmt::format("there are no named transforms in {}", config_name)
                                 : fmt::format("there is no named transform {} in {}; it has {}",
                                               in_quotes(transform), config_name, listed(known)),
                   did_you_mean(transform, known), Code::kUnknownColour);
}

}  // namespace

// The same.  Throws Failure (kInput), as when a look-up table is not there.
std::shared_ptr<const ColorTransform::Impl> ColorConfig::Impl::prepare(
    const ocio::ConstTransformRcPtr& transform, const std::string& what) const {
    try {
        return processed(transform);
    } catch (const ocio::Exception& e) {
        fail(ErrorKind::kInput, fmt::format("can't prepare the conversion from {}: {}", what, told_by(e)));
    }
}

std::string opencolorio_version() { return ocio::GetVersion(); }

void clear_ocio_environment() {
    std::vector<std::string> names;
    for (char** variable = environ; variable != nullptr && *variable != nullptr; ++variable) {
        const std::string_view text = *variable;
        if (text.starts_with("OCIO_")) names.emplace_back(text.substr(0, text.find('=')));
    }
    for (const std::string& name : names) unsetenv(name.c_str());
}

void ColorTransform::apply(float* r, float* g, float* b, const float* a, std::size_t n) const {
    if (!identity()) apply_batches<Alpha::kStraight>(*impl_->processor, {r, g, b}, a, n);
}

void ColorTransform::apply_premultiplied(float* r, float* g, float* b, const float* a, std::size_t n) const {
    if (!identity()) apply_batches<Alpha::kPremultiplied>(*impl_->processor, {r, g, b}, a, n);
}

std::shared_ptr<const ColorConfig> ColorConfig::load(const std::filesystem::path& file) {
    require_file(file);
    try {
        auto config = ocio::Config::CreateFromFile(file.c_str());
        return std::shared_ptr<const ColorConfig>(
            new ColorConfig(fmt::format("OCIO config {}", quoted(file)),
                            std::make_shared<const Impl>(Impl{std::move(config)})));
    } catch (const ocio::Exception& e) {
        fail_to_load(file, e);
    }
}

std::shared_ptr<const ColorConfig> ColorConfig::builtin() {
    std::istringstream text(kBuiltinColorConfig);
    auto config = ocio::Config::CreateFromStream(text);
    return std::shared_ptr<const ColorConfig>(
        new ColorConfig("the built-in OCIO config", std::make_shared<const Impl>(Impl{std::move(config)})));
}

std::shared_ptr<const ColorConfig> ColorConfig::in_context(
    const std::vector<std::pair<std::string, std::string>>& variables) const {
    const auto context = impl_->context->createEditableCopy();
    for (const auto& [name, value] : variables) {
        require_variable(name);
        context->setStringVar(name.c_str(), value.c_str());
    }
    return std::shared_ptr<const ColorConfig>(
        new ColorConfig(name_, std::make_shared<const Impl>(Impl{impl_->config, context})));
}

ColorTransform ColorConfig::convert(const std::string& from, const std::string& to) const {
    require_space(from);
    require_space(to);
    auto transform = ocio::ColorSpaceTransform::Create();
    transform->setSrc(from.c_str());
    transform->setDst(to.c_str());
    return ColorTransform(
        impl_->prepare(transform, fmt::format("{} to {} in {}", in_quotes(from), in_quotes(to), name_)));
}

ColorTransform ColorConfig::display(const std::string& from, const std::string& display,
                                    const std::string& view) const {
    require_space(from);
    const std::string chosen_display = found_display(display);
    const std::string chosen_view = found_view(chosen_display, view);
    auto transform = ocio::DisplayViewTransform::Create();
    transform->setSrc(from.c_str());
    transform->setDisplay(chosen_display.c_str());
    transform->setView(chosen_view.c_str());
    return ColorTransform(
        impl_->prepare(transform, fmt::format("{} to view {} of display {} in {}", in_quotes(from),
                                              in_quotes(chosen_view), in_quotes(chosen_display), name_)));
}

ColorTransform ColorConfig::look(const std::string& space, const std::string& looks, bool inverse) const {
    require_space(space);
    require_looks(looks);
    auto transform = ocio::LookTransform::Create();
    transform->setSrc(space.c_str());
    transform->setDst(space.c_str());
    transform->setLooks(looks.c_str());
    transform->setDirection(direction_of(inverse));
    return ColorTransform(impl_->prepare(
        transform, fmt::format("{} to look {} in {}", in_quotes(space), in_quotes(looks), name_)));
}

ColorTransform ColorConfig::named(const std::string& transform, bool inverse) const {
    const auto found = impl_->config->getNamedTransform(transform.c_str());
    if (!found) refuse_named(*impl_->config, transform, name_);
    // One direction may be all that is said of it.
    const auto said = found->getTransform(direction_of(inverse));
    auto turned = ocio::GroupTransform::Create();
    if (!said) turned->setDirection(ocio::TRANSFORM_DIR_INVERSE);
    const auto part = said ? said : found->getTransform(direction_of(!inverse));
    turned->appendTransform(part->createEditableCopy());
    return ColorTransform(impl_->prepare(turned, fmt::format("{} in {}", in_quotes(transform), name_)));
}

ColorTransform ColorConfig::file(const std::filesystem::path& file, const std::string& id,
                                 bool inverse) const {
    std::error_code unknown;  // where it can't be looked at, reading it says why
    if (!std::filesystem::exists(file, unknown) && !unknown)
        fail(Code::kFileMissing, ErrorKind::kInput, fmt::format("{}: no such file", file.string()));
    auto transform = ocio::FileTransform::Create();
    transform->setSrc(std::filesystem::absolute(file).c_str());
    transform->setCCCId(id.empty() ? "0" : id.c_str());
    transform->setInterpolation(ocio::INTERP_BEST);
    transform->setDirection(direction_of(inverse));
    try {
        return ColorTransform(impl_->processed(transform));
    } catch (const ocio::Exception& e) {
        const std::string text = told_by(e);
        const std::string_view opening = "with this error: ";
        const std::size_t at = text.find(opening);
        fail(ErrorKind::kInput,
             fmt::format("can't use {}: {}", quoted(file),
                         at == std::string::npos ? text : text.substr(at + opening.size())));
    }
}

ColorTransform ColorConfig::decide(const Decision& decision, bool inverse) const {
    auto transform = ocio::CDLTransform::Create();
    transform->setStyle(ocio::CDL_NO_CLAMP);
    transform->setSlope(decision.slope.data());
    transform->setOffset(decision.offset.data());
    transform->setPower(decision.power.data());
    transform->setSat(decision.saturation);
    transform->setDirection(direction_of(inverse));
    return ColorTransform(impl_->prepare(transform, "a colour decision"));
}

Digest ColorConfig::digest() const {
    return Digester("colours").add(impl_->config->getCacheID(impl_->context)).digest();
}

void ColorConfig::require_space(const std::string& space) const {
    if (impl_->config->getColorSpace(space.c_str())) return;
    const std::vector<std::string> known_roles = roles(*impl_->config);
    throw BadValue(
        space,
        fmt::format("there is no colour space {} in {}; it has {}{}", in_quotes(space), name_,
                    listed(color_spaces()), known_roles.empty() ? "" : "; roles " + listed(known_roles)),
        did_you_mean(space, space_names(*impl_->config)), Code::kUnknownColour);
}

void ColorConfig::require_looks(const std::string& looks) const {
    std::vector<std::string> known;
    for (int i = 0; i < impl_->config->getNumLooks(); ++i)
        known.emplace_back(impl_->config->getLookNameByIndex(i));
    for (const std::string& look : split_looks(looks)) {
        if (impl_->config->getLook(look.c_str())) continue;
        throw BadValue(looks,
                       known.empty() ? fmt::format("there are no looks in {}", name_)
                                     : fmt::format("there is no look {} in {}; it has {}", in_quotes(look),
                                                   name_, listed(known)),
                       did_you_mean(look, known), Code::kUnknownColour);
    }
}

// A config that lists its variables has no others; one that lists none may use any.
void ColorConfig::require_variable(const std::string& variable) const {
    std::vector<std::string> known;
    for (int i = 0; i < impl_->config->getNumEnvironmentVars(); ++i)
        known.emplace_back(impl_->config->getEnvironmentVarNameByIndex(i));
    if (known.empty() || std::ranges::find(known, variable) != known.end()) return;
    throw BadValue(variable,
                   fmt::format("there is no context variable {} in {}; it has {}", in_quotes(variable), name_,
                               listed(known)),
                   did_you_mean(variable, known), Code::kUnknownColour);
}

std::string ColorConfig::found_display(const std::string& display) const {
    const std::vector<std::string> known = displays();
    if (known.empty()) fail(ErrorKind::kGraph, fmt::format("{} has no displays", name_));
    if (display.empty()) return impl_->config->getDefaultDisplay();
    if (impl_->config->getNumViews(display.c_str()) > 0) return display;
    throw BadValue(
        display,
        fmt::format("there is no display {} in {}; it has {}", in_quotes(display), name_, listed(known)),
        did_you_mean(display, known), Code::kUnknownColour);
}

std::string ColorConfig::found_view(const std::string& display, const std::string& view) const {
    if (view.empty()) return impl_->config->getDefaultView(display.c_str());
    if (*impl_->config->getDisplayViewColorSpaceName(display.c_str(), view.c_str()) != '\0') return view;
    const std::vector<std::string> known = views(display);
    throw BadValue(view,
                   fmt::format("there is no view {} of display {} in {}; it has {}", in_quotes(view),
                               in_quotes(display), name_, listed(known)),
                   did_you_mean(view, known), Code::kUnknownColour);
}

ColorConfig::SpaceFor ColorConfig::space_for(const std::string& space) const {
    const auto found = impl_->config->getColorSpace(space.c_str());
    if (!found) return SpaceFor::kUnknown;
    const auto linear = impl_->config->getColorSpace("scene_linear");
    const std::string_view encoding = found->getEncoding();
    if ((linear && std::string_view(linear->getName()) == found->getName()) || encoding == "scene-linear")
        return SpaceFor::kScene;
    const bool is_for_display = found->getReferenceSpaceType() == ocio::REFERENCE_SPACE_DISPLAY ||
                                encoding == "sdr-video" || encoding == "hdr-video";
    return is_for_display ? SpaceFor::kDisplay : SpaceFor::kUnknown;
}

std::vector<std::string> ColorConfig::color_spaces() const {
    std::vector<std::string> names;
    for (int i = 0; i < impl_->config->getNumColorSpaces(); ++i)
        names.emplace_back(impl_->config->getColorSpaceNameByIndex(i));
    return names;
}

std::vector<std::string> ColorConfig::displays() const {
    std::vector<std::string> names;
    for (int i = 0; i < impl_->config->getNumDisplays(); ++i)
        names.emplace_back(impl_->config->getDisplay(i));
    return names;
}

std::vector<std::string> ColorConfig::views(const std::string& display) const {
    std::vector<std::string> names;
    for (int i = 0; i < impl_->config->getNumViews(display.c_str()); ++i)
        names.emplace_back(impl_->config->getView(display.c_str(), i));
    return names;
}

}  // namespace keyline

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/look/views.h"

namespace keyline {

namespace {

// What OpenOptions call a part.
std::string part_label(const ImageDescription& image, std::size_t index) {
    if (image.parts.size() == 1) return {};
    const std::string& name = image.parts[index].name;
    return name.empty() ? std::to_string(index) : name;
}

}  // namespace

std::vector<PartView> open_views(const std::filesystem::path& file, const ImageDescription& image,
                                 Diagnostics& diagnostics) {
    std::vector<PartView> out;
    for (std::size_t i = 0; i < image.parts.size(); ++i) {
        std::vector<std::string> views = image.parts[i].views;
        if (views.empty()) views.emplace_back();
        for (const std::string& view : views) {
            OpenOptions options;
            options.part = part_label(image, i);
            options.view = view;
            try {
                out.push_back(
                    {options.part, view.empty() ? image.parts[i].view : view, open_image(file, options)});
            } catch (const Failure& f) {
                diagnostics.error(f.error());
            }
        }
    }
    return out;
}

}  // namespace keyline

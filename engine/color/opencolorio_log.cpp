// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/color/opencolorio_log.h"

#include <OpenColorIO/OpenColorIO.h>
#include <atomic>
#include <mutex>
#include <set>
#include <string_view>

namespace keyline {

namespace ocio = OCIO_NAMESPACE;

namespace {

// OpenColorIO's own listener can be given nothing.
std::atomic<void (*)(const std::string&)> listener{nullptr};

// "[OpenColorIO Warning]: text\n" without what stands around it.
std::string without_label(std::string_view text) {
    if (text.starts_with('['))
        if (const std::size_t end = text.find("]: "); end != std::string_view::npos)
            text.remove_prefix(end + 3);
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.remove_suffix(1);
    return std::string(text);
}

void pass_on(const char* text) {
    static std::mutex mutex;
    static std::set<std::string> told;
    const std::string message = without_label(text);
    const std::lock_guard lock(mutex);
    if (!message.empty() && told.insert(message).second) listener.load()(message);
}

}  // namespace

void hear_opencolorio(void (*hear)(const std::string&)) {
    listener = hear;
    ocio::SetLoggingFunction(pass_on);
}

}  // namespace keyline

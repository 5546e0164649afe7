// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/image_module.h"

#include "engine/error.h"
#include "engine/io/output_format.h"

#include <atomic>
#include <dlfcn.h>
#include <fmt/format.h>
#include <stdexcept>
#include <string>

namespace keyline {

namespace {

std::atomic<bool> module_loaded = false;

class Module {
public:
    // Loads it once; it stays, as the code of what it makes is in it.  Throws std::runtime_error, and tries
    // again the next time.
    static const Module& loaded() {
        static const Module module;
        return module;
    }

    KeylineOpenImage* open;
    KeylineCreateImage* create;

private:
    Module() {
        const std::filesystem::path file = module_folder() / "keyline_image_io.so";
        void* handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (handle == nullptr) throw std::runtime_error(dlerror());
        open = reinterpret_cast<KeylineOpenImage*>(symbol(handle, "keyline_open_image"));
        create = reinterpret_cast<KeylineCreateImage*>(symbol(handle, "keyline_create_image"));
        module_loaded = true;
    }

    static void* symbol(void* handle, const char* name) {
        void* address = dlsym(handle, name);
        if (address == nullptr) throw std::runtime_error(dlerror());
        return address;
    }
};

const Module& module_for(const std::filesystem::path& file, ErrorKind kind) {
    try {
        return Module::loaded();
    } catch (const std::runtime_error& error) {
        fail(kind,
             fmt::format(
                 "{}: only OpenEXR files can be used: the module for other formats can't be loaded: {}",
                 file.string(), error.what()),
             "check the installation of Keyline");
    }
}

}  // namespace

std::unique_ptr<ImageSource> open_with_module(const std::filesystem::path& file, const OpenOptions& options) {
    return std::unique_ptr<ImageSource>(module_for(file, ErrorKind::kInput).open(file.c_str(), &options));
}

std::unique_ptr<ImageSink> create_with_module(const std::filesystem::path& file, const SinkSpec& spec) {
    return std::unique_ptr<ImageSink>(module_for(file, ErrorKind::kOutput).create(file.c_str(), &spec));
}

bool needs_module(const std::filesystem::path& file) { return extension_of(file) != "exr"; }

bool module_is_loaded() { return module_loaded; }

std::filesystem::path module_folder() {
    Dl_info library = {};
    if (dladdr(reinterpret_cast<void*>(&module_folder), &library) == 0 || library.dli_fname == nullptr)
        fail(ErrorKind::kInternal, "the folder of the Keyline library is not known");
    return std::filesystem::absolute(library.dli_fname).parent_path() / "keyline";
}

}  // namespace keyline

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/file_identity.h"

#include "engine/base/byte_digest.h"
#include "engine/io/exr/file.h"

#include <span>
#include <sys/stat.h>
#include <vector>

namespace keyline {

namespace {

constexpr std::size_t kBuffer = std::size_t{1} << 20;  // bytes

}  // namespace

Digest file_identity(const std::filesystem::path& file) {
    struct stat status = {};
    std::error_code error;
    const std::filesystem::path canonical = std::filesystem::canonical(file, error);
    if (error || stat(canonical.c_str(), &status) != 0) return {};
    return Digester("file")
        .add(canonical.native())
        .add(status.st_size)
        .add(status.st_mtim.tv_sec)
        .add(status.st_mtim.tv_nsec)
        .add(status.st_ino)
        .digest();
}

Digest file_content(const std::filesystem::path& file) {
    const exr::InputFile in(file);
    std::vector<std::byte> buffer(kBuffer);
    ByteDigester digester;
    for (uint64_t at = 0;;) {
        const std::size_t n = in.read_some(at, buffer);
        if (n == 0) return digester.digest();
        digester.add(std::span(buffer).first(n));
        at += n;
    }
}

}  // namespace keyline

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/image_io_proxy.h"

#include "engine/error.h"

#include <algorithm>
#include <span>
#include <vector>

namespace keyline::oiio {

namespace {

// Anywhere in the file; what lies between its end and `offset` becomes 0.
void write_at(OutputFile& file, std::uint64_t offset, std::span<const std::byte> bytes) {
    if (offset > file.size()) file.append(std::vector<std::byte>(offset - file.size()));
    const std::size_t over = std::min<std::uint64_t>(bytes.size(), file.size() - offset);
    if (over > 0) file.overwrite(offset, bytes.first(over));
    if (over < bytes.size()) file.append(bytes.subspan(over));
}

}  // namespace

std::size_t OutputProxy::write(const void* bytes, std::size_t n) {
    pwrite(bytes, n, m_pos);
    m_pos += static_cast<std::int64_t>(n);
    return n;
}

std::size_t OutputProxy::pwrite(const void* bytes, std::size_t n, std::int64_t offset) {
    if (failure_ || n == 0) return n;
    try {
        write_at(file_, static_cast<std::uint64_t>(offset), {static_cast<const std::byte*>(bytes), n});
    } catch (const Failure&) {
        failure_ = std::current_exception();
    }
    return n;
}

void OutputProxy::rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
}

}  // namespace keyline::oiio

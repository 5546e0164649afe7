// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/oiio/helper/proxy.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <unistd.h>

namespace keyline::oiio {

namespace {

constexpr std::int64_t kSyncStep = 8 << 20;

}  // namespace

std::size_t OutputProxy::write(const void* bytes, std::size_t n) {
    pwrite(bytes, n, m_pos);
    m_pos += static_cast<std::int64_t>(n);
    return n;
}

std::size_t OutputProxy::pwrite(const void* bytes, std::size_t n, std::int64_t offset) {
    const auto* from = static_cast<const char*>(bytes);
    for (std::size_t done = 0; done < n && error_ == 0;) {
        const ssize_t wrote = ::pwrite(descriptor_, from + done, n - done, offset + std::int64_t(done));
        if (wrote > 0)
            done += static_cast<std::size_t>(wrote);
        else if (errno != EINTR)
            error_ = errno;
    }
    size_ = std::max(size_, offset + static_cast<std::int64_t>(n));
    // Starts the disk early, so that the sync at the end has little left to wait for.  Only a hint.
    if (size_ - being_synced_ >= kSyncStep && error_ == 0) {
        sync_file_range(descriptor_, being_synced_, size_ - being_synced_, SYNC_FILE_RANGE_WRITE);
        being_synced_ = size_;
    }
    return n;
}

}  // namespace keyline::oiio

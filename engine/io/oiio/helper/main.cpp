// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0

// See ../picture_tasks.h for what it does.

#include "engine/base/error.h"
#include "engine/io/helper/message.h"
#include "engine/io/helper/server/server.h"
#include "engine/io/oiio/helper/decoder.h"
#include "engine/io/oiio/helper/formats.h"
#include "engine/io/oiio/helper/output.h"

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <unistd.h>

// The clock of this program and of every library in it: what is written does not depend on when.
// NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name): the name in the system header is
// reserved.
extern "C" std::time_t time(std::time_t* to) noexcept {
    if (to != nullptr) *to = 0;
    return 0;
}

namespace keyline::oiio {

namespace {

class Session {
public:
    std::vector<std::byte> perform(const HelperInput& in) {
        switch (static_cast<PictureTask>(in.request.task)) {
            case PictureTask::kOpen: return open(in);
            case PictureTask::kClose: decoder_.reset(); return {};
            case PictureTask::kRead: return read(in);
            case PictureTask::kCreate: return create(in);
            case PictureTask::kWrite: return write(in);
            case PictureTask::kFinish: return finish();
        }
        throw std::runtime_error("a task of no known kind");
    }

private:
    std::vector<std::byte> open(const HelperInput& in) {
        const PictureRequest request = PictureRequest::from(in.bytes);
        decoder_ = std::make_unique<Decoder>(request);
        std::vector<std::byte> header = decoder_->header().bytes();
        if (request.to_be_read) return header;
        try_if_small(*decoder_);
        decoder_.reset();
        return header;
    }

    // A small picture is read whole at once, which costs nothing: its damages are told by who asks first.
    static void try_if_small(Decoder& decoder) {
        constexpr std::size_t kSmall = std::size_t{256} << 10;
        const PictureHeader h = decoder.header();
        const bool is_picture = !h.is_deep && h.depth <= 1 && h.width > 0 && h.height > 0;
        const std::size_t row = is_picture ? decoder.row_bytes(h.sample) : kSmall;
        const auto rows = static_cast<std::size_t>(std::max(h.height, h.tile_height));
        if (row == 0 || row >= kSmall || rows > kSmall / row) return;
        std::vector<std::byte> pixels(row * rows);
        decoder.read_rows(0, h.height, h.sample, pixels.data());
    }

    std::vector<std::byte> read(const HelperInput& in) {
        const auto sample = MessageReader(in.bytes).get<Sample>();
        const int begin = in.request.first_row, rows = in.request.rows;
        if (!decoder_ || begin < 0 || rows < 0 || rows > decoder_->height() - begin)
            throw std::runtime_error("rows that there are not");
        const std::size_t bytes = decoder_->row_bytes(sample) * static_cast<std::size_t>(rows);
        std::vector<std::byte> own(bytes <= in.shared.size() ? 0 : bytes);
        decoder_->read_rows(begin, begin + rows, sample, own.empty() ? in.shared.data() : own.data());
        return own;
    }

    std::vector<std::byte> create(const HelperInput& in) {
        output_.reset();
        output_ = std::make_unique<PictureOutput>(PictureSpec::from(in.bytes), in.descriptor);
        return {};
    }

    std::vector<std::byte> write(const HelperInput& in) {
        const std::span<const std::byte> rows = in.bytes.empty() ? in.shared : in.bytes;
        const int begin = in.request.first_row, count = in.request.rows;
        if (!output_ || begin < 0 || count < 0 || count > output_->height() - begin ||
            rows.size() < output_->row_bytes() * static_cast<std::size_t>(count))
            throw std::runtime_error("rows that there are not");
        output_->write_rows(begin, begin + count, rows.data());
        return {};
    }

    std::vector<std::byte> finish() {
        if (!output_) throw std::runtime_error("nothing to finish");
        output_->finish();
        output_.reset();
        return {};
    }

    std::unique_ptr<Decoder> decoder_;
    std::unique_ptr<PictureOutput> output_;
};

HelperReply::Outcome outcome_of(ErrorKind kind) {
    return kind == ErrorKind::kOutput  ? HelperReply::Outcome::kOutputFailed
           : kind == ErrorKind::kInput ? HelperReply::Outcome::kInputFailed
                                       : HelperReply::Outcome::kFailed;
}

// Of the process of a session.  Keyline's workers are the threads, but saying so makes OpenImageIO start a
// pool and end it again.  The process that sessions are forked from must never do that: a thread of the pool
// may hold its lock at that moment, and a session that wants it would wait for ever.
HelperSession make_session() {
    OIIO::attribute("threads", 1);
    return [session = std::make_shared<Session>()](const HelperInput& in) {
        try {
            return session->perform(in);
        } catch (const Failure& failure) {
            const Error& e = failure.error();
            throw HelperFailure(outcome_of(e.kind), e.what, e.hint, static_cast<uint32_t>(e.passing));
        }
    };
}

}  // namespace

}  // namespace keyline::oiio

int main() {
    setenv("TZ", "UTC0", 1);
    // The list of formats is made here, once, for all sessions.
    keyline::oiio::input_extensions();
    return keyline::serve(keyline::oiio::make_session);
}

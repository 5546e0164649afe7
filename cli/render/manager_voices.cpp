// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/report.h"
#include "cli/render/voice.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <string_view>

namespace keyline::cli {

namespace {

// What managers look for in a log, wherever it stands.  A file or a library may say it too; the blank that it
// then gets takes the meaning from it.
constexpr std::array<std::string_view, 9> kSpells = {
    "openjd_", "PROGRESS:", "FRAME:",      "[ PARSER",      "ACTIVITY:",
    "REPORT:", "@IMAGE@",   "TR_PROGRESS", "TR_EXIT_STATUS"};

std::string without_spells(std::string text) {
    const auto same = [](char a, char b) {
        return std::toupper(static_cast<unsigned char>(a)) == std::toupper(static_cast<unsigned char>(b));
    };
    for (const std::string_view spell : kSpells)
        for (std::size_t from = 0;;) {
            const auto found = std::search(text.begin() + static_cast<std::ptrdiff_t>(from), text.end(),
                                           spell.begin(), spell.end(), same);
            if (found == text.end()) break;
            from = static_cast<std::size_t>(found - text.begin()) + 1;
            text.insert(from, 1, ' ');
        }
    return text;
}

// Percents that never fall, and are 100 only at a good end.
class ManagerVoice : public Voice {
public:
    std::chrono::seconds patience() const override { return std::chrono::seconds(10); }
    void start(const RunBooks& books) override { tell(books); }
    void frame_ended(const RunBooks& books, int, FrameOutcome, double) override { tell(books); }
    void beat(const RunBooks& books) override { tell(books); }
    void frame_waits(int frame, const std::string& for_what) override {
        Voice::frame_waits(frame, without_spells(for_what));
    }
    void warning(const Error& warning) override { print_message(without_spells(warning.warning_text())); }
    void error(const Error& error) override { print_message(without_spells(error.text())); }
    void end(const RunBooks& books, const Ending& ending, const std::vector<int>& untried) override {
        if (ending.status == 0)
            percent(100);
        else
            failed(last_line(ending, books.list.missing()));
        Voice::end(books, ending, untried);
    }

protected:
    virtual void percent(int n) = 0;
    virtual void failed(const std::string& /*why*/) {}

private:
    void tell(const RunBooks& books) {
        last_ = std::max(last_, std::min(99, static_cast<int>(100 * books.part())));
        percent(last_);
    }

    int last_ = 0;
};

class OpenJdVoice final : public ManagerVoice {
    void frame_started(const RunBooks&, int frame, const Plan&) override {
        print_message(fmt::format("openjd_status: frame {}", frame));
    }
    void percent(int n) override { print_message(fmt::format("openjd_progress: {}", n)); }
    void failed(const std::string& why) override { print_message("openjd_fail: " + why); }
};

class TractorVoice final : public ManagerVoice {
    void percent(int n) override { print_message(fmt::format("TR_PROGRESS {}%", n)); }
};

class DeadlineVoice final : public ManagerVoice {
    void percent(int n) override { print_message(fmt::format("Progress: {}%", n)); }
};

// It counts frames by their lines, and wants percents of the frame that the last one names.
class AfanasyVoice final : public ManagerVoice {
    void start(const RunBooks& books) override { name_frame(books); }
    void frame_ended(const RunBooks& books, int, FrameOutcome, double) override { name_frame(books); }
    void beat(const RunBooks& books) override {
        if (books.at_work.empty()) return;
        const auto& [frame, at_work] = *books.at_work.begin();
        last_ = frame == frame_ ? std::max(last_, percents(at_work.part)) : percents(at_work.part);
        frame_ = frame;
        percent(last_);
    }
    void percent(int n) override { print_message(fmt::format("PROGRESS: {}%", n)); }

    static int percents(double part) { return std::min(99, static_cast<int>(100 * part)); }
    static void name_frame(const RunBooks& books) {
        if (books.ended() < books.list.all().size())
            print_message(fmt::format("FRAME: {}", books.list.all()[books.ended()]));
    }

    int frame_ = 0, last_ = 0;
};

}  // namespace

std::unique_ptr<Voice> manager_voice(const std::string& name) {
    if (name == "openjd") return std::make_unique<OpenJdVoice>();
    if (name == "afanasy") return std::make_unique<AfanasyVoice>();
    if (name == "tractor") return std::make_unique<TractorVoice>();
    if (name == "deadline") return std::make_unique<DeadlineVoice>();
    return nullptr;
}

}  // namespace keyline::cli

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/params/file_name.h"

#include "engine/base/error.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <fmt/format.h>
#include <set>

namespace keyline {

namespace {

constexpr std::size_t kMostDigits = 20;  // of padding: more is a slip, and no file system takes it far

// "%04d" and "%d" give the number of digits and the length of the token; nothing for anything else.
struct Token {
    std::size_t length, digits;
};

std::optional<Token> parse_percent(std::string_view text) {
    if (text.starts_with("%d")) return Token{2, 0};
    if (!text.starts_with("%0")) return std::nullopt;
    std::size_t digits = 0;
    const auto [stop, error] = std::from_chars(text.data() + 2, text.data() + text.size(), digits);
    const auto length = static_cast<std::size_t>(stop - text.data());
    if (error != std::errc() || digits == 0 || !text.substr(length).starts_with('d')) return std::nullopt;
    return Token{length + 1, digits};
}

// The frames that the digits at the start of `text` can be read as: all of them, or fewer where digits of
// the name itself follow.
std::vector<int> readings(std::string_view text) {
    std::vector<int> out;
    const std::size_t sign = text.starts_with('-') ? 1 : 0;
    for (std::size_t end = sign + 1; end <= text.size(); ++end) {
        int frame = 0;
        const auto [stop, error] = std::from_chars(text.data(), text.data() + end, frame);
        if (stop != text.data() + end) break;
        if (error == std::errc()) out.push_back(frame);
    }
    return out;
}

std::vector<std::string> entries_of(const std::filesystem::path& folder) {
    std::vector<std::string> out;
    std::error_code error;
    const std::filesystem::path listed = folder.empty() ? "." : folder;
    for (std::filesystem::directory_iterator entry(listed, error), end; !error && entry != end;
         entry.increment(error))
        out.push_back(entry->path().filename().string());
    const bool absent = error == std::errc::no_such_file_or_directory || error == std::errc::not_a_directory;
    if (error && !absent)
        fail(ErrorKind::kInput,
             fmt::format("can't list the folder {}: {}", in_quotes(listed.string()), error.message()));
    return out;
}

// Text, and after it the frame padded to `digits`, or nothing more where there are none.
struct ParsedPiece {
    std::string text;
    std::optional<std::size_t> digits;
};

// From front to back, a token or a letter at a time.
class Parser {
public:
    explicit Parser(std::string_view text) : all_(text), rest_(text) {}

    std::vector<ParsedPiece> parse() {
        refuse_whole_names();
        while (!rest_.empty()) {
            keep(std::min(rest_.find_first_of("#%\\$@"), rest_.size()));
            if (!rest_.empty()) take_special();
        }
        return std::move(pieces_);
    }

private:
    std::string name() const { return "the file name " + in_quotes(all_); }
    [[noreturn]] static void refuse(std::string what, std::string hint = {}) {
        fail(ErrorKind::kGraph, std::move(what), std::move(hint));
    }

    // What is wrong with a name as a whole, and with its beginning.
    void refuse_whole_names() const {
        if (all_.empty()) refuse("a file name is empty");
        if (all_.find('\0') != std::string_view::npos) refuse(name() + " holds a NUL");
        if (all_.ends_with('/')) refuse(in_quotes(all_) + " names a folder, not a file");
        if (all_.starts_with('~'))
            refuse(name() + " starts with '~', which is nobody's folder here",
                   "write ${env:HOME}, or ./~ for what is called so");
        if (all_.find("<UDIM>") != std::string_view::npos)
            refuse(name() + " holds <UDIM>, the tiles of a texture",
                   "a file is one picture here: write a tile's number");
        const bool has_drive =
            all_.size() > 2 && is_letter(all_[0]) && all_[1] == ':' && (all_[2] == '\\' || all_[2] == '/');
        if (has_drive || all_.starts_with("\\\\"))
            refuse(name() + " is one of Windows",
                   "write where this machine has mounted the folder, or give the place with --path-map");
    }

    static bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
    static bool is_digit(char c) { return c >= '0' && c <= '9'; }

    void take_special() {
        switch (rest_.front()) {
            case '#': return take_hashes();
            case '%': return take_percent();
            case '\\': return take_escape();
            case '$': return take_dollar();
            default: return take_at();
        }
    }

    void take_hashes() {
        const std::size_t run = std::min(rest_.find_first_not_of('#'), rest_.size());
        const bool in_folder = rest_.find('/') != std::string_view::npos;
        if (run == 1 && in_folder)
            keep(1);
        else
            take_frame({run, run});
    }

    void take_percent() {
        if (rest_.starts_with("%%")) {
            rest_.remove_prefix(1);
            return keep(1);
        }
        if (rest_.starts_with("%V") || rest_.starts_with("%v"))
            refuse(fmt::format("{} holds {} for a view", name(), rest_.substr(0, 2)),
                   "a file holds one view here: write its name");
        const auto token = parse_percent(rest_);
        if (!token)
            refuse(fmt::format("a '%' in {} starts neither %d nor %04d", name()),
                   "a percent sign is written %%");
        take_frame(*token);
    }

    void take_escape() {
        rest_.remove_prefix(1);
        if (rest_.empty() || std::string_view("#$@%~").find(rest_.front()) == std::string_view::npos)
            refuse(fmt::format("{} holds a '\\'", name()), "folders are parted by '/'");
        keep(1);
    }

    void take_dollar() {
        std::size_t end = 1;
        while (end < rest_.size() && (is_letter(rest_[end]) || (end > 1 && is_digit(rest_[end])))) ++end;
        const std::string word(rest_.substr(1, end - 1));
        if (word.empty()) return keep(1);
        const bool is_frame = word.starts_with('F') && std::all_of(word.begin() + 1, word.end(), is_digit);
        const std::string way = is_frame ? "the frame is written ####"
                                         : fmt::format(
                                               "a variable of the environment is written ${{env:{0}}}, "
                                               "one of the graph ${{{0}}}",
                                               word);
        refuse(fmt::format("{} holds ${}", name(), word), way + ", a '$' itself \\$");
    }

    void take_at() {
        const std::size_t run = std::min(rest_.find_first_not_of('@'), rest_.size());
        if (run > 1) refuse(name() + " holds a run of '@'", "the frame is written ####, an '@' itself \\@");
        keep(run);
    }

    void keep(std::size_t n) {
        pieces_.back().text += rest_.substr(0, n);
        rest_.remove_prefix(n);
    }

    void take_frame(const Token& token) {
        if (token.digits > kMostDigits)
            refuse(fmt::format("{} pads the frame to {} digits; the most is {}", name(), token.digits,
                               kMostDigits));
        pieces_.back().digits = token.digits;
        pieces_.emplace_back();
        rest_.remove_prefix(token.length);
    }

    std::string_view all_, rest_;
    std::vector<ParsedPiece> pieces_{{}};
};

}  // namespace

FileName::FileName(std::string_view text, std::filesystem::path base) : text_(text), base_(std::move(base)) {
    Parsed parsed = parse(text);
    if (!parsed.fault.empty()) fail(ErrorKind::kGraph, std::move(parsed.fault));
    pieces_ = std::move(parsed.pieces);
}

std::optional<std::string> FileName::fault(std::string_view text) {
    std::string fault = parse(text).fault;
    return fault.empty() ? std::nullopt : std::optional(std::move(fault));
}

bool FileName::has_frame() const { return pieces_.size() > 1; }

std::filesystem::path FileName::at(int frame) const { return base_ / written(pieces_, frame); }

std::vector<int> FileName::frames_on_disk() const {
    if (!has_frame()) return {};
    // The first component that holds the frame is listed; every later one then follows from the frame.
    const std::string& head = pieces_.front().text;
    const std::size_t slash = head.rfind('/');
    const std::size_t start = slash == std::string::npos ? 0 : slash + 1;
    const std::string prefix = head.substr(start);
    std::set<int> out;
    for (const std::string& entry : entries_of(base_ / head.substr(0, start))) {
        if (!entry.starts_with(prefix)) continue;
        for (const int frame : readings(std::string_view(entry).substr(prefix.size()))) {
            const std::string path = written(pieces_, frame).substr(start);
            std::error_code error;
            if (path.substr(0, path.find('/')) == entry && std::filesystem::is_regular_file(at(frame), error))
                out.insert(frame);
        }
    }
    return {out.begin(), out.end()};
}

FileName::Parsed FileName::parse(std::string_view text) {
    Parsed out;
    try {
        for (ParsedPiece& piece : Parser(text).parse())
            out.pieces.push_back({std::move(piece.text), piece.digits});
    } catch (const Failure& f) {
        const Error& e = f.error();
        out.fault = e.hint.empty() ? e.what : e.what + "; " + e.hint;
    }
    return out;
}

std::string FileName::written(const std::vector<Piece>& pieces, int frame) {
    std::string out;
    for (const Piece& piece : pieces) {
        out += piece.text;
        if (!piece.digits) continue;
        const std::string digits = std::to_string(std::abs(static_cast<long long>(frame)));
        if (frame < 0) out += '-';
        out.append(*piece.digits - std::min(*piece.digits, digits.size()), '0');
        out += digits;
    }
    return out;
}

}  // namespace keyline

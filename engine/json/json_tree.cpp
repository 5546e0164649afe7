// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/json/json_tree.h"

#include <algorithm>
#include <utility>

namespace keyline {

namespace {

// Deeper brackets are words: no graph has them, and a stack ends.
constexpr int kDeepest = 100;

constexpr std::string_view kBlanks = " \t\r";
constexpr std::string_view kEndsOfWords = " \t\r\n,:{}[]\"";

class Parser {
public:
    explicit Parser(std::string_view text) : text_(text) {
        if (text.starts_with("\xEF\xBB\xBF")) at_ = 3;
    }

    JsonDocument document() {
        JsonDocument out;
        take_comments(out.before, out.lines_before);
        out.root = value();
        // What stands behind it is no part of it; where that is not a comment, it is for others to tell.
        std::size_t end = text_.size();
        while (at_ < end) {
            take_comments(out.after);
            at_ = std::min(at_ + 1, end);
        }
        return out;
    }

private:
    char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
    bool at_end() const { return at_ >= text_.size(); }
    bool is_at(std::string_view token) const { return text_.substr(at_).starts_with(token); }

    // Blanks and comments; `lines` counts ends of lines since what is before them, or since the last comment.
    void take_comments(std::vector<JsonComment>& out, int& lines) {
        while (!at_end()) {
            if (peek() == '\n' || (peek() == '\r' && !is_at("\r\n"))) {
                ++lines;
                ++at_;
            } else if (kBlanks.find(peek()) != std::string_view::npos) {
                ++at_;
            } else if (is_at("//") || is_at("/*")) {
                out.push_back({comment(), lines});
                lines = 0;
            } else {
                break;
            }
        }
    }

    void take_comments(std::vector<JsonComment>& out) {
        int lines = 0;
        take_comments(out, lines);
    }

    Span comment() {
        const std::size_t begin = at_;
        const bool is_line = is_at("//");
        const std::size_t end = is_line ? text_.find_first_of("\r\n", at_) : text_.find("*/", at_ + 2);
        at_ = end == std::string_view::npos ? text_.size() : end + (is_line ? 0 : 2);
        return {begin, at_};
    }

    JsonTree value() {
        const char c = peek();
        if ((c == '{' || c == '[') && depth_ < kDeepest) return container();
        if (c == '"') return {JsonTree::Kind::kString, string(), {}};
        const Span span = word();
        return {span.is_empty() ? JsonTree::Kind::kMissing : JsonTree::Kind::kWord, span, {}};
    }

    Span word() {
        const std::size_t begin = at_;
        while (!at_end() && kEndsOfWords.find(peek()) == std::string_view::npos && !is_at("//") &&
               !is_at("/*"))
            ++at_;
        return {begin, at_};
    }

    // One that is not closed ends where a bracket or a comma says that more follows, or with its line.
    Span string() {
        const std::size_t begin = at_++;
        while (!at_end() && peek() != '"' && peek() != '\n' && peek() != '\r') at_ += peek() == '\\' ? 2 : 1;
        at_ = std::min(at_, text_.size());
        if (peek() == '"') return {begin, ++at_};
        at_ = std::min(text_.find_first_of(",{}[]\r\n", begin), at_);
        return {begin, at_};
    }

    JsonTree container() {
        const char close = peek() == '{' ? '}' : ']';
        JsonTree out{close == '}' ? JsonTree::Kind::kObject : JsonTree::Kind::kArray, {at_, at_}, {}};
        ++at_;
        ++depth_;
        JsonItem next;
        while (true) {
            take_comments(next.before, next.lines_before);
            if (peek() == ',') {
                ++at_;
                continue;
            }
            keep_line(out, next);
            if (at_end() || peek() == '}' || peek() == ']') {
                out.before_end = std::move(next.before);
                break;
            }
            if (!take_item(close == '}', next)) break;  // it is of what is around
            out.items.push_back(std::exchange(next, {}));
        }
        --depth_;
        // A bracket of the other kind is that of what is around it.
        out.is_closed = peek() == close;
        if (out.is_closed) ++at_;
        out.span.end = at_;
        return out;
    }

    // Comments that stand behind the item before, on its line, are that one's, unless the next follows there.
    void keep_line(JsonTree& out, JsonItem& next) const {
        if (out.items.empty()) return;
        JsonItem& last = out.items.back();
        std::size_t on_line = 0;
        while (on_line < next.before.size() && next.before[on_line].lines_before == 0) ++on_line;
        const bool is_all = on_line == next.before.size() && next.lines_before == 0;
        const bool is_followed = is_all && peek() != '}' && peek() != ']' && !at_end();
        if (is_followed) return;
        const auto end = next.before.begin() + static_cast<std::ptrdiff_t>(on_line);
        last.after.insert(last.after.end(), next.before.begin(), end);
        next.before.erase(next.before.begin(), end);
    }

    // False where nothing could be taken.
    bool take_item(bool is_member, JsonItem& out) {
        const std::size_t begin = at_;
        if (!is_member) {
            out.value = value();
            // A key among values: the bracket before it was not closed.
            if (out.value.is(JsonTree::Kind::kString) && is_colon_next()) return at_ = begin, false;
        } else {
            out.key = peek() == '"' ? string() : word();
            take_comments(out.before);
            if (peek() == ':') {
                ++at_;
                take_member_value(out);
            } else {
                out.value.span = {at_, at_};
            }
        }
        if (at_ == begin) ++at_;  // a bracket that opens where a key should stand, or a ':'
        return true;
    }

    void take_member_value(JsonItem& out) {
        const std::size_t after_colon = at_;
        std::vector<JsonComment> comments;
        take_comments(comments);
        const std::size_t begin = at_;
        out.value = value();
        if (out.value.is(JsonTree::Kind::kString) && is_colon_next()) {  // the next key, and no value
            out.value = {JsonTree::Kind::kMissing, {after_colon, after_colon}, {}};
            at_ = after_colon;
            return;
        }
        if (out.value.is(JsonTree::Kind::kMissing)) {
            out.value.span = {after_colon, begin};
            at_ = comments.empty() ? begin : after_colon;
            return;
        }
        out.before.insert(out.before.end(), comments.begin(), comments.end());
    }

    bool is_colon_next() {
        const std::size_t before = at_;
        std::vector<JsonComment> comments;
        take_comments(comments);
        const bool out = peek() == ':';
        at_ = before;
        return out;
    }

    std::string_view text_;
    std::size_t at_ = 0;
    int depth_ = 0;
};

}  // namespace

JsonDocument read_json_tree(std::string_view text) { return Parser(text).document(); }

}  // namespace keyline

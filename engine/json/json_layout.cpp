// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/json/json_layout.h"

#include "engine/json/json_reader.h"
#include "engine/json/json_tree.h"

#include <algorithm>
#include <vector>

namespace keyline {

namespace {

constexpr std::size_t kWidest = 120;
constexpr std::size_t kIndent = 2;

std::size_t characters(std::string_view text) {
    return static_cast<std::size_t>(
        std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

// How far something goes on the line that it begins on.
struct FirstLine {
    std::size_t width = 0;
    bool ends = false;  // the line does, inside of it
};

// Where lines must end: what the author chose, and what comments ask for.
class Lines {
public:
    Lines(std::string_view text, const JsonTree& root) : text_(text), root_(&root) {
        for (const JsonItem& item : root.items)
            if (item.key.of(text) == "\"nodes\"" && item.value.is(JsonTree::Kind::kObject))
                nodes_ = &item.value;
    }

    bool is_line(const JsonComment& c) const { return c.span.of(text_).starts_with("//"); }

    // Whether the items stand on lines between those of the brackets.
    bool is_broken(const JsonTree& tree) const {
        if (tree.items.empty() || !tree.before_end.empty()) return !tree.before_end.empty();
        return is_spread(tree) || begins_by_choice(tree.items.front()) || ends_line(tree.items.back());
    }

    bool begins_line(const JsonTree& tree, std::size_t i) const {
        if (i == 0) return is_broken(tree);
        return begins_by_choice(tree.items[i]) || ends_line(tree.items[i - 1]) || is_spread(tree) ||
               is_table(tree);
    }

    // Objects one below the other.
    bool is_table(const JsonTree& tree) const {
        const auto is_row = [](const JsonItem& i) { return i.value.is(JsonTree::Kind::kObject); };
        return &tree == nodes_ || (tree.is(JsonTree::Kind::kObject) && &tree != root_ &&
                                   std::ranges::all_of(tree.items, is_row) && is_broken(tree));
    }

    static bool has_blank_line_before(const JsonItem& item) {
        const auto is_blank = [](const JsonComment& c) { return c.lines_before > 1; };
        return item.lines_before > 1 || std::ranges::any_of(item.before, is_blank);
    }

private:
    // A graph and its nodes have a line for each member.
    bool is_spread(const JsonTree& tree) const { return &tree == root_ || &tree == nodes_; }

    bool begins_by_choice(const JsonItem& item) const {
        const auto is_own = [&](const JsonComment& c) { return c.lines_before > 0 || is_line(c); };
        return item.lines_before > 0 || std::ranges::any_of(item.before, is_own);
    }

    bool ends_line(const JsonItem& item) const {
        return std::ranges::any_of(item.after, [&](const JsonComment& c) { return is_line(c); });
    }

    std::string_view text_;
    const JsonTree* root_;
    const JsonTree* nodes_ = nullptr;
};

class Layout {
public:
    Layout(std::string_view text, const JsonTree& root) : text_(text), lines_(text, root) {}

    std::string of(const JsonDocument& document) {
        for (const JsonComment& c : document.before) own_line(c, 0);
        if (!document.before.empty()) new_line(0, document.lines_before > 1);
        value(document.root, 0, 0);
        for (const JsonComment& c : document.after) c.lines_before > 0 ? own_line(c, 0) : behind(c);
        return out_ + "\n";
    }

private:
    static bool is_object(const JsonTree& tree) { return tree.is(JsonTree::Kind::kObject); }
    static bool is_plain(const JsonTree& tree) {
        return !is_object(tree) && !tree.is(JsonTree::Kind::kArray);
    }
    static std::size_t bracket_width(const JsonTree& tree) { return is_object(tree) ? 2 : 1; }

    // `column` is where the item begins that the value is of; `trail` what follows it on its last line.
    void value(const JsonTree& tree, std::size_t column, std::size_t trail) {
        if (is_plain(tree)) return put(tree.span.of(text_));
        put(is_object(tree) ? "{" : "[");
        if (lines_.is_broken(tree)) {
            items(tree, column + kIndent, 0);
            for (const JsonComment& c : tree.before_end) own_line(c, column + kIndent);
            new_line(column, false);
        } else if (!tree.items.empty()) {
            const char* blank = is_object(tree) ? " " : "";
            put(blank);
            items(tree, column_, bracket_width(tree) + trail);
            put(blank);
        }
        put(is_object(tree) ? "}" : "]");
    }

    void items(const JsonTree& tree, std::size_t column, std::size_t trail) {
        const std::vector<std::size_t> padding = padding_of(tree);
        for (std::size_t i = 0; i < tree.items.size(); ++i) {
            const JsonItem& item = tree.items[i];
            const bool is_last = i + 1 == tree.items.size();
            const std::size_t after = is_last ? trail : 1;
            begin_item(tree, i, column, after);
            if (!item.key.is_empty()) {
                put(item.key.of(text_));
                put(":" + std::string(padding[i] + 1, ' '));
            }
            value(item.value, column, after);
            if (!is_last) put(",");
            for (const JsonComment& c : item.after) behind(c);
        }
    }

    void begin_item(const JsonTree& tree, std::size_t i, std::size_t column, std::size_t after) {
        const JsonItem& item = tree.items[i];
        const FirstLine line = first_line(item);
        const bool fits = column_ + 1 + line.width + (line.ends ? 0 : after) <= kWidest;
        bool is_new = lines_.begins_line(tree, i) || (i > 0 && !fits);
        bool is_first = i == 0;
        for (const JsonComment& c : item.before) {
            begin(is_new || c.lines_before > 0, c.lines_before > 1, is_first, column);
            comment(c);
            is_new = lines_.is_line(c);
            is_first = false;
        }
        begin(is_new || (!item.before.empty() && item.lines_before > 0), item.lines_before > 1, is_first,
              column);
    }

    void begin(bool is_new_line, bool after_blank, bool is_first, std::size_t column) {
        if (is_new_line)
            new_line(column, after_blank && !is_first);
        else if (!is_first)
            put(" ");
    }

    // How far the values stand from their keys, beyond a blank: those of a table in one column, as long as no
    // blank line parts them.
    std::vector<std::size_t> padding_of(const JsonTree& tree) const {
        std::vector<std::size_t> out(tree.items.size(), 0);
        if (!lines_.is_table(tree)) return out;
        for (std::size_t begin = 0, end = 0; begin < out.size(); begin = end) {
            for (end = begin + 1; end < out.size() && !Lines::has_blank_line_before(tree.items[end]);) ++end;
            pad_block(tree, begin, end, out);
        }
        return out;
    }

    void pad_block(const JsonTree& tree, std::size_t begin, std::size_t end,
                   std::vector<std::size_t>& out) const {
        std::size_t widest = 0;
        for (std::size_t i = begin; i < end; ++i) {
            const JsonTree& row = tree.items[i].value;
            if (!is_object(row) || lines_.is_broken(row)) return;
            widest = std::max(widest, characters(tree.items[i].key.of(text_)));
        }
        for (std::size_t i = begin; i < end; ++i) out[i] = widest - characters(tree.items[i].key.of(text_));
    }

    FirstLine first_line(const JsonItem& item) const {
        FirstLine out;
        for (const JsonComment& c : item.before) {
            const std::string_view comment = c.span.of(text_);
            const std::size_t line = std::min(comment.find('\n'), comment.size());
            out.width += characters(comment.substr(0, line)) + 1;
            if (line < comment.size()) return {out.width, true};
        }
        if (!item.key.is_empty()) out.width += characters(item.key.of(text_)) + 2;
        const FirstLine of_value = first_line(item.value);
        return {out.width + of_value.width, of_value.ends};
    }

    FirstLine first_line(const JsonTree& tree) const {
        if (is_plain(tree)) return {characters(tree.span.of(text_))};
        if (lines_.is_broken(tree)) return {1, true};
        FirstLine out{bracket_width(tree)};
        for (std::size_t i = 0; i < tree.items.size(); ++i) {
            if (i > 0 && lines_.begins_line(tree, i)) return {out.width, true};
            const FirstLine item = first_line(tree.items[i]);
            out.width += item.width + (i > 0 ? 2 : 0);
            if (item.ends) return {out.width, true};
            for (const JsonComment& c : tree.items[i].after) out.width += characters(c.span.of(text_)) + 1;
        }
        out.width += tree.items.empty() ? 1 : bracket_width(tree);
        return out;
    }

    void comment(const JsonComment& c) {
        std::string_view text = c.span.of(text_);
        while (lines_.is_line(c) && (text.ends_with(' ') || text.ends_with('\t'))) text.remove_suffix(1);
        put(text);
    }

    void own_line(const JsonComment& c, std::size_t column) {
        if (!out_.empty())
            new_line(column, c.lines_before > 1 && !out_.ends_with('{') && !out_.ends_with('['));
        comment(c);
    }

    void behind(const JsonComment& c) {
        put(lines_.is_line(c) ? "  " : " ");
        comment(c);
    }

    void put(std::string_view text) {
        out_ += text;
        const std::size_t line = text.rfind('\n');
        column_ =
            line == std::string_view::npos ? column_ + characters(text) : characters(text.substr(line + 1));
    }

    void new_line(std::size_t column, bool after_blank) {
        out_ += after_blank ? "\n\n" : "\n";
        out_.append(column, ' ');
        column_ = column;
    }

    std::string_view text_;
    Lines lines_;
    std::string out_;
    std::size_t column_ = 0;
};

std::string with_line_feeds(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool is_return = text[i] == '\r';
        if (!is_return || !text.substr(i + 1).starts_with('\n')) out += is_return ? '\n' : text[i];
    }
    return out;
}

}  // namespace

std::string json_layout(std::string_view text, const std::string& name) {
    parse_json(text, name);
    const std::string lines = with_line_feeds(text);
    const JsonDocument document = read_json_tree(lines);
    return Layout(lines, document.root).of(document);
}

}  // namespace keyline

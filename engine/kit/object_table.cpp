// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/object_table.h"

#include "engine/base/error.h"
#include "engine/json/json_reader.h"
#include "engine/json/make_value.h"
#include "engine/params/params.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <utility>
#include <vector>

namespace keyline {

namespace {

using Kind = Value::Kind;

[[noreturn]] void refuse(const Place& place, std::string what, std::string hint = {}) {
    throw Failure({ErrorKind::kInput, place, {}, std::move(what), std::move(hint)});
}

struct Cell {
    std::string text;
    Place place;
};

std::optional<double> number_of(std::string_view text) {
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, number);
    return read.ec == std::errc{} && read.ptr == end ? std::optional(number) : std::nullopt;
}

// Cells parted by commas, line by line; a cell may stand in double quotes, which are written twice inside.
class CsvReader {
public:
    CsvReader(std::string_view text, const std::string& file) : text_(text), place_{file, 1, 1} {
        if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
    }

    // The next line that has something in it; empty at the end.
    std::vector<Cell> next() {
        while (!is_at_end()) {
            std::vector<Cell> line = read_line();
            if (line.size() > 1 || !line[0].text.empty()) return line;
        }
        return {};
    }

private:
    bool is_at_end() const { return at_ == text_.size(); }
    char here() const { return is_at_end() ? '\n' : text_[at_]; }
    bool is_at_line_end() const { return here() == '\n' || here() == '\r'; }

    void advance() {
        if ((static_cast<unsigned char>(text_[at_++]) & 0xC0U) != 0x80) ++place_.column;  // code points
    }

    std::vector<Cell> read_line() {
        std::vector<Cell> out{read_cell()};
        while (here() == ',') {
            advance();
            out.push_back(read_cell());
        }
        while (here() == '\r' && !is_at_end()) advance();
        if (!is_at_end()) ++at_;
        ++place_.line;
        place_.column = 1;
        return out;
    }

    Cell read_cell() {
        skip_blanks();
        Cell out{{}, place_};
        if (here() == '"') {
            out.text = read_quoted();
            skip_blanks();
            expect_end_of_cell();
        } else {
            while (here() != ',' && !is_at_line_end()) take(out.text);
            out.text.erase(out.text.find_last_not_of(" \t") + 1);
        }
        return out;
    }

    std::string read_quoted() {
        const Place begin = place_;
        std::string out;
        for (advance(); here() != '"' || text_.substr(at_, 2) == "\"\"";) {
            if (is_at_end() || is_at_line_end()) refuse(begin, "the cell has no closing '\"'");
            if (here() == '"') advance();
            take(out);
        }
        advance();
        return out;
    }

    void expect_end_of_cell() const {
        if (here() != ',' && !is_at_line_end())
            refuse(place_, "expected ',' or the end of the line after the cell");
    }

    void take(std::string& out) {
        out += here();
        advance();
    }
    void skip_blanks() {
        while (here() == ' ' || here() == '\t') advance();
    }

    std::string_view text_;
    std::size_t at_ = 0;
    Place place_;
};

// "name,color" and the like: words where colours or numbers would be.
bool is_heading(const std::vector<Cell>& line) {
    return std::ranges::none_of(line.begin() + 1, line.end(), [](const Cell& cell) {
        return cell.text.empty() || cell.text[0] == '#' || number_of(cell.text);
    });
}

Value cell_value(const Cell& cell) {
    const auto number = number_of(cell.text);
    return number ? number_value(*number, cell.place) : text_value(cell.text, cell.place);
}

Member member_of(const std::vector<Cell>& line) {
    if (line.size() == 2) return {line[0].text, line[0].place, cell_value(line[1])};
    if (line.size() != 4)
        refuse(line[0].place,
               fmt::format("the line has {} cell{}; it must be NAME,#rrggbb or NAME,R,G,B or NAME,NUMBER",
                           line.size(), line.size() == 1 ? "" : "s"),
               line[0].text.find(';') == std::string::npos ? "" : "cells are parted by ','");
    Value color;
    color.kind = Kind::kArray;
    color.place = line[1].place;
    for (std::size_t i = 1; i < line.size(); ++i) color.items.push_back(cell_value(line[i]));
    return {line[0].text, line[0].place, std::move(color)};
}

// As if it had been written as JSON.
Value object_of_csv(std::string_view text, const std::string& file) {
    Value out;
    out.kind = Kind::kObject;
    out.place = {file, 1, 1};
    CsvReader reader(text, file);
    bool is_first = true;
    for (std::vector<Cell> line = reader.next(); !line.empty(); line = reader.next()) {
        if (std::exchange(is_first, false) && line.size() > 1 && is_heading(line)) continue;
        Member member = member_of(line);
        if (const auto earlier = std::ranges::find(out.members, member.key, &Member::key);
            earlier != out.members.end())
            refuse(member.key_place, fmt::format("{} stands in line {} already", in_quotes(member.key),
                                                 earlier->key_place.line));
        out.members.push_back(std::move(member));
    }
    return out;
}

Value object_of(std::string_view text, const std::string& file) {
    if (file.ends_with(".csv")) return object_of_csv(text, file);
    if (!file.ends_with(".json"))
        fail(ErrorKind::kInput, fmt::format("{} is no table", in_quotes(file)),
             "a table is a .json or a .csv");
    try {
        return parse_json(text, file);
    } catch (const Failure& f) {
        rethrow_with(f, [](Error& e) { e.kind = ErrorKind::kInput; });
    }
}

template <class T>
Map<T> entries_of(const Value& object, const TypeInfo& type) {
    Diagnostics faults;
    ParamReader reader(faults, {}, {});
    Map<T> out;
    for (const Member& m : object.members) {
        validate(type, m.value, m.key, reader);
        if (!faults.ok()) refuse(faults.errors()[0].place, faults.errors()[0].what, faults.errors()[0].hint);
        out.entries.emplace_back(m.key, Codec<T>::from_value(m.value, {}, {}));
    }
    return out;
}

}  // namespace

ObjectTable parse_object_table(std::string_view text, const std::string& file) {
    const Value object = object_of(text, file);
    if (!object.is(Kind::kObject) || object.members.empty())
        refuse(object.place, "a table is names with a colour or a number each",
               "as { \"hair*\": \"#302018\" }");
    if (object.members[0].value.is(Kind::kNumber))
        return {{}, entries_of<double>(object, TypeInfo::number({}))};
    return {entries_of<Color>(object, TypeInfo::color({})), {}};
}

}  // namespace keyline

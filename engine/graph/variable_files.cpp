// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/variable_files.h"

#include "engine/graph/apply_options.h"
#include "engine/graph/graph_error.h"
#include "engine/graph/read_text.h"
#include "engine/json/json_reader.h"

#include <fmt/format.h>

namespace keyline {

namespace {

// Nothing where it is no file of variables: that was told, at `place` where it can't be read.
std::optional<Value> read_file(const std::filesystem::path& file, const Place& place,
                               Diagnostics& diagnostics) {
    try {
        Value value = parse_json(read_text(file, "the file of variables"), file.string());
        if (value.is(Value::Kind::kObject) && value.find("nodes") && value.find("keyline"))
            fail(ErrorKind::kGraph, in_quotes(file.string()) + " is a graph",
                 "a file of variables is an object of names and values");
        return value;
    } catch (const Failure& f) {
        Error e = f.error();
        if (e.place.file.empty()) e.place = place;
        diagnostics.error(std::move(e));
        return std::nullopt;
    }
}

// The names in "include", which may hold variables, of those files too that stand before them.
class Includes {
public:
    Includes(const std::filesystem::path& folder, Diagnostics& diagnostics)
        : folder_(folder), diagnostics_(diagnostics) {}

    void read(const Value& include, VariableSources& sources, const std::vector<Value>& later) {
        if (!include.is(Value::Kind::kArray)) return read_one(include, sources, later);
        for (const Value& name : include.items) read_one(name, sources, later);
    }

private:
    void read_one(const Value& name, VariableSources& sources, const std::vector<Value>& later) {
        Diagnostics of_variables;  // they are told when all are known
        VariableSources known = sources;
        known.files.insert(known.files.end(), later.begin(), later.end());
        const std::size_t before = diagnostics_.errors().size();
        const Value file = Variables(known, of_variables).substitute(name, std::nullopt, diagnostics_);
        if (diagnostics_.errors().size() > before) return;
        if (!file.is(Value::Kind::kString) || file.text.empty())
            return graph_error(
                diagnostics_, name.place,
                fmt::format("'include' is {}; it must be the name of a file of variables, or a "
                            "list of them",
                            name.shown()),
                {}, {}, Code::kWrongValue);
        if (auto value = read_file(folder_ / file.text, name.place, diagnostics_))
            sources.files.push_back(std::move(*value));
    }

    const std::filesystem::path& folder_;
    Diagnostics& diagnostics_;
};

}  // namespace

VariableSources variable_sources(const Value& root, const LoadOptions& options,
                                 const std::filesystem::path& folder, Diagnostics& diagnostics) {
    VariableSources out{root.find("variables"), {}, variable_overrides(options.var, diagnostics)};
    std::vector<Value> of_options;
    for (const std::string& file : options.vars)
        if (auto value = read_file(options.root / file, {"--vars " + file, 0, 0}, diagnostics))
            of_options.push_back(std::move(*value));
    if (const Value* include = root.find("include"))
        Includes(folder, diagnostics).read(*include, out, of_options);
    out.files.insert(out.files.end(), of_options.begin(), of_options.end());
    return out;
}

}  // namespace keyline

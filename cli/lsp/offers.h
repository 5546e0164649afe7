// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/lsp/answers.h"

#include <filesystem>
#include <string>
#include <vector>

// What can be offered, whatever of it fits where the cursor is.

namespace keyline::lsp {

// By the protocol's numbers.
enum class OfferKind {
    kText = 1,
    kFunction = 3,
    kField = 5,
    kVariable = 6,
    kClass = 7,
    kProperty = 10,
    kValue = 12,
    kFile = 17,
    kReference = 18,
    kFolder = 19,
    kWord = 20
};

struct Offer {
    std::string label;
    OfferKind kind;
    std::string detail, help;
    std::string written = {};  // as it is put into the text; empty: the label in quotes
    bool fits = true;          // what does not stands behind what does
};

// "a number, from 0 to 500 pixels; default 1"
std::string detail_of(const FieldInfo& field);

std::vector<Offer> top_level_keys();
std::vector<Offer> keys_of_node(const NodeType* type);  // null: of any
std::vector<Offer> keys_of(const std::vector<FieldInfo>& fields);
std::vector<Offer> mistakes();  // that may be meant
std::vector<Offer> keys_of_animation();

std::vector<Offer> types(const Document& document, const std::string& typed);
std::vector<Offer> words(const TypeInfo& type);
std::vector<Offer> truths();
std::vector<Offer> names_in_expressions();

// Of nodes, but `own`; behind a colon, of the node's layers and channels, those first that the input takes.
std::vector<Offer> links(const Known& known, const std::string& typed, const std::string& own,
                         const Takes& takes);

// What lies in the folder that was typed, frames of a sequence as one.
std::vector<Offer> files(const std::filesystem::path& folder, const std::string& typed);

// What a config or the files of the graph hold; `owner` is the display that views are of, or the Cryptomatte
// that objects are of, by the end of its name; empty: the first display, any Cryptomatte.
std::vector<Offer> named(Naming names, const Known& known, const std::string& owner);

}  // namespace keyline::lsp

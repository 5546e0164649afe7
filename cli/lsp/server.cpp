// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/lsp/server.h"

#include "engine/io/versions.h"
#include "engine/json/json_reader.h"

#include <exception>
#include <fmt/format.h>
#include <utility>

namespace keyline::lsp {

namespace {

// By the protocol's numbers.
constexpr int kNotJson = -32700, kUnknownMethod = -32601, kWrongParameters = -32602, kInternal = -32603;
constexpr int kIncremental = 2;

const Value& part(const Value& object, std::string_view key) {
    static const Value kNone;
    const Value* value = object.find(key);
    return value ? *value : kNone;
}

Position position_of(const Value& position) {
    return {static_cast<int>(part(position, "line").number),
            static_cast<int>(part(position, "character").number)};
}

Span span_of_range(const Text& text, const Value& range) {
    return {text.byte_of(position_of(part(range, "start"))), text.byte_of(position_of(part(range, "end")))};
}

std::string capabilities() {
    JsonWriter json;
    json.begin_object().key("capabilities").begin_object();
    json.key("textDocumentSync")
        .begin_object()
        .field("openClose", true)
        .field("change", kIncremental)
        .end_object();
    json.key("completionProvider").begin_object().key("triggerCharacters");
    json.list(std::vector<std::string>{"\"", ":", "/", "{", ".", "="}).end_object();
    for (const char* name : {"hoverProvider", "definitionProvider", "referencesProvider",
                             "documentSymbolProvider", "documentFormattingProvider", "colorProvider"})
        json.field(name, true);
    json.key("renameProvider").begin_object().field("prepareProvider", true).end_object();
    json.key("codeActionProvider").begin_object().key("codeActionKinds");
    json.list(std::vector<std::string>{"quickfix"}).end_object().end_object();
    json.key("serverInfo")
        .begin_object()
        .field("name", "keyline")
        .field("version", keyline_version())
        .end_object();
    return json.end_object().text();
}

}  // namespace

int Server::run() {
    while (!is_over_) {
        if (!connection_.has_more()) tell_diagnostics();
        const std::optional<std::string> message = connection_.read();
        if (!message) break;
        try {
            handle(parse_json(*message, "message"));
        } catch (const Failure& f) {
            refuse({}, kNotJson, f.what());
        }
    }
    return is_shut_down_ ? 0 : 1;
}

void Server::handle(const Value& message) {
    const std::string method = part(message, "method").text;
    const Value* id = message.find("id");
    if (!id) return hear(method, part(message, "params"));
    if (method.empty()) return;  // an answer, and nothing was asked
    try {
        const std::string result = answer(method, part(message, "params"));
        result.empty() ? refuse(*id, kUnknownMethod, "there is no " + method) : reply(*id, result);
    } catch (const Failure& f) {
        refuse(*id, kWrongParameters, f.error().what + (f.error().hint.empty() ? "" : "; " + f.error().hint));
    } catch (const std::exception& e) {
        refuse(*id, kInternal, e.what());
    }
}

// "" for a method that is not known.
std::string Server::answer(const std::string& method, const Value& params) {
    using Ask = std::string (*)(const Known&, std::size_t);
    using AskAll = std::string (*)(const Known&);
    static const std::map<std::string, Ask> kOfPlaces{{"textDocument/completion", completions},
                                                      {"textDocument/hover", hover},
                                                      {"textDocument/definition", definition},
                                                      {"textDocument/references", references},
                                                      {"textDocument/prepareRename", rename_range}};
    static const std::map<std::string, AskAll> kOfTexts{{"textDocument/documentSymbol", symbols},
                                                        {"textDocument/formatting", formatted},
                                                        {"textDocument/documentColor", colors}};
    if (method == "initialize") return capabilities();
    if (method == "shutdown") return is_shut_down_ = true, "null";
    const auto of_place = kOfPlaces.find(method);
    const auto of_text = kOfTexts.find(method);
    const bool is_rename = method == "textDocument/rename", is_action = method == "textDocument/codeAction";
    const bool is_color = method == "textDocument/colorPresentation";
    if (of_place == kOfPlaces.end() && of_text == kOfTexts.end() && !is_rename && !is_action && !is_color)
        return "";
    Open* open = find(params);
    if (!open) return "null";
    const Known known = this->known(*open);
    const Text& text = open->document->text();
    const std::size_t byte = text.byte_of(position_of(part(params, "position")));
    if (of_place != kOfPlaces.end()) return of_place->second(known, byte);
    if (of_text != kOfTexts.end()) return of_text->second(known);
    if (is_rename) return renamed(known, byte, part(params, "newName").text);
    const Span range = span_of_range(text, part(params, "range"));
    return is_action ? actions(known, range) : color_presentations(known, part(params, "color"), range);
}

void Server::hear(const std::string& method, const Value& params) {
    const Value& document = part(params, "textDocument");
    if (method == "exit") is_over_ = true;
    if (method == "textDocument/didOpen") open(part(document, "uri").text, Text(part(document, "text").text));
    if (method == "textDocument/didChange") change(params);
    if (method == "textDocument/didClose") documents_.erase(part(document, "uri").text);
    if (method == "textDocument/didSave" || method == "workspace/didChangeWatchedFiles")
        for (auto& [uri, open] : documents_) open.is_analysed = open.is_told = false;
}

void Server::open(const std::string& uri, Text text) {
    auto document = std::make_unique<const Document>(uri, std::move(text));
    Open& at = documents_[uri];  // found before the old document goes, which `uri` may lie in
    at = {};
    at.document = std::move(document);
}

void Server::change(const Value& params) {
    const Open* before = find(params);
    if (!before) return;
    Text text = before->document->text();
    for (const Value& edit : part(params, "contentChanges").items) {
        const Value& range = part(edit, "range");
        if (range.is(Value::Kind::kObject))
            text.replace(position_of(part(range, "start")), position_of(part(range, "end")),
                         part(edit, "text").text);
        else
            text = Text(part(edit, "text").text);
    }
    open(before->document->uri(), std::move(text));
}

Server::Open* Server::find(const Value& params) {
    const auto it = documents_.find(part(part(params, "textDocument"), "uri").text);
    return it == documents_.end() ? nullptr : &it->second;
}

Known Server::known(Open& open) {
    if (!open.is_analysed) open.analysis = analyse(*open.document, session_);
    open.is_analysed = true;
    return {*open.document, open.analysis, *session_};
}

void Server::tell_diagnostics() {
    for (auto& [uri, open] : documents_) {
        if (std::exchange(open.is_told, true)) continue;
        connection_.write(fmt::format(
            R"({{"jsonrpc":"2.0","method":"textDocument/publishDiagnostics","params":{{"uri":{},"diagnostics":{}}}}})",
            JsonWriter().value(uri).text(), diagnostics(known(open))));
    }
}

void Server::reply(const Value& id, const std::string& result) const {
    connection_.write(
        fmt::format(R"({{"jsonrpc":"2.0","id":{},"result":{}}})", JsonWriter().value(id).text(), result));
}

void Server::refuse(const Value& id, int code, const std::string& why) const {
    connection_.write(fmt::format(R"({{"jsonrpc":"2.0","id":{},"error":{{"code":{},"message":{}}}}})",
                                  JsonWriter().value(id).text(), code, JsonWriter().value(why).text()));
}

}  // namespace keyline::lsp

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/lsp/analysis.h"
#include "cli/lsp/answers.h"
#include "cli/lsp/connection.h"

#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace keyline::lsp {

// Answers an editor's messages until it says exit or closes.  One thread: what is asked is answered in the
// order of the questions, from the text as it is then.
class Server {
public:
    explicit Server(Connection connection) : connection_(std::move(connection)) {}

    int run();  // the exit status: 0 where the editor shut down before it left

private:
    struct Open {
        std::unique_ptr<const Document> document;
        Analysis analysis;
        bool is_analysed = false, is_told = false;
    };

    void handle(const Value& message);
    std::string answer(const std::string& method, const Value& params);
    void hear(const std::string& method, const Value& params);

    void open(const std::string& uri, Text text);
    void change(const Value& params);
    Open* find(const Value& params);
    Known known(Open& open);
    void tell_diagnostics();

    void reply(const Value& id, const std::string& result) const;
    void refuse(const Value& id, int code, const std::string& why) const;

    Connection connection_;
    std::shared_ptr<Session> session_ = std::make_shared<Session>();
    std::map<std::string, Open> documents_;  // by URI
    bool is_shut_down_ = false, is_over_ = false;
};

}  // namespace keyline::lsp

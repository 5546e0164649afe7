// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
// Starts `keyline lsp` for graph files: JSON that has a "keyline" in its first lines.  Other JSON is left alone.
"use strict";

const vscode = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

let client;

function isGraph(document) {
  const lines = Math.min(document.lineCount, 20);
  for (let i = 0; i < lines; ++i) if (/"keyline"\s*:/.test(document.lineAt(i).text)) return true;
  return false;
}

// A server knows nothing of what it is not told to open, and answers nothing about it.
const middleware = { didOpen: async (document, next) => (isGraph(document) ? next(document) : undefined) };

exports.activate = () => {
  const program = vscode.workspace.getConfiguration("keyline").get("program");
  const documentSelector = [{ language: "json" }, { language: "jsonc" }];
  client = new LanguageClient("keyline", "Keyline", { command: program, args: ["lsp"] }, { documentSelector, middleware });
  return client.start();
};

exports.deactivate = () => client?.stop();

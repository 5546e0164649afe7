// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
// Starts `keyline lsp` for graph files: JSON that has a "keyline" in its first lines.  Other JSON is left alone.
"use strict";

const { execFile } = require("node:child_process");
const { promisify } = require("node:util");
const vscode = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

let client, started;

function isGraph(document) {
  const lines = Math.min(document.lineCount, 20);
  for (let i = 0; i < lines; ++i) if (/"keyline"\s*:/.test(document.lineAt(i).text)) return true;
  return false;
}

// A server knows nothing of what it is not told to open, and answers nothing about it.
const middleware = { didOpen: async (document, next) => (isGraph(document) ? next(document) : undefined) };

const programOf = () => vscode.workspace.getConfiguration("keyline").get("program");

async function tellThatItCannotStart(program, fault) {
  const why = fault.code === "ENOENT" ? "there is no such program in the PATH" : fault.message;
  const settings = "Open Settings";
  const chosen = await vscode.window.showErrorMessage(
    `Keyline: '${program}' can't be started: ${why}. Say where it is with the setting 'keyline.program'.`, settings);
  if (chosen === settings) vscode.commands.executeCommand("workbench.action.openSettings", "keyline.program");
}

// The client's own message does not say what to do, so whether the program runs is asked before.
async function start() {
  const program = programOf();
  try {
    await promisify(execFile)(program, ["--version"]);
  } catch (fault) {
    tellThatItCannotStart(program, fault);
    return;
  }
  const documentSelector = [{ language: "json" }, { language: "jsonc" }];
  client = new LanguageClient("keyline", "Keyline", { command: program, args: ["lsp"] }, { documentSelector, middleware });
  await client.start();
}

// Graphs have comments, which VS Code's own JSON refuses.  The server starts with the first of them; who has none is not
// bothered.
function welcome(document) {
  if (!["json", "jsonc"].includes(document.languageId) || !isGraph(document)) return;
  if (document.languageId === "json") vscode.languages.setTextDocumentLanguage(document, "jsonc");
  if (!started) started = start();
}

async function restart() {
  await started;
  await client?.stop();
  client = started = undefined;
  vscode.workspace.textDocuments.forEach(welcome);
}

exports.activate = (context) => {
  context.subscriptions.push(
    vscode.workspace.onDidOpenTextDocument(welcome),
    vscode.workspace.onDidChangeTextDocument((change) => welcome(change.document)),
    vscode.workspace.onDidChangeConfiguration((change) => change.affectsConfiguration("keyline.program") && restart()));
  vscode.workspace.textDocuments.forEach(welcome);
  return started;
};

exports.deactivate = () => client?.stop();

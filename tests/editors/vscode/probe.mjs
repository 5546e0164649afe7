// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
// probe.mjs PROGRAM GRAPH: what VS Code's own protocol library hears from `keyline lsp` about a graph: a line for each fault,
// and for each word offered inside "hero.Com" and "robot.".  Every answer has to be of the protocol's form.
import { spawn } from "node:child_process";
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";
import rpc from "vscode-languageserver-protocol/node.js";

const [program, graph] = process.argv.slice(2);
const text = readFileSync(graph, "utf8");
const uri = pathToFileURL(graph).href;
const server = spawn(program, ["lsp"], { stdio: ["pipe", "pipe", "inherit"] });
const client = rpc.createProtocolConnection(
  new rpc.StreamMessageReader(server.stdout), new rpc.StreamMessageWriter(server.stdin));

function positionBehind(typed) {
  const lines = text.slice(0, text.indexOf(typed) + typed.length).split("\n");
  return { line: lines.length - 1, character: lines.at(-1).length };
}

function offer(list) {
  for (const item of Array.isArray(list) ? list : list.items) {
    if (item.textEdit && !rpc.TextEdit.is(item.textEdit)) throw new Error("no edit: " + JSON.stringify(item));
    console.log("offered: " + item.label);
  }
}

const told = new Promise((resolve) => client.onNotification(rpc.PublishDiagnosticsNotification.type, resolve));
client.listen();
const { capabilities } = await client.sendRequest(rpc.InitializeRequest.type,
  { processId: process.pid, rootUri: null, capabilities: {} });
if (!capabilities.completionProvider) throw new Error("the server completes nothing");
await client.sendNotification(rpc.InitializedNotification.type, {});
await client.sendNotification(rpc.DidOpenTextDocumentNotification.type,
  { textDocument: { uri, languageId: "json", version: 1, text } });
for (const d of (await told).diagnostics) {
  if (!rpc.Diagnostic.is(d)) throw new Error("no diagnostic: " + JSON.stringify(d));
  console.log(`told: ${d.range.start.line + 1}: ${d.message}`);
}
for (const typed of ["r:hero.Com", "\"robot."]) {
  offer(await client.sendRequest(rpc.CompletionRequest.type, { textDocument: { uri }, position: positionBehind(typed) }));
}
await client.sendRequest(rpc.ShutdownRequest.type);
await client.sendNotification(rpc.ExitNotification.type);
const status = await new Promise((resolve) => server.on("exit", resolve));
process.exit(status);

// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0

// Judges graphs by the schema, with a validator that knows nothing of Keyline, and with the one that is in VS Code.
//
//     node judge.mjs SCHEMA CORPUS GRAPH...
//
// CORPUS has a line for each graph, { "graph": ..., "takes": whether the loader takes it }; each GRAPH is sound.

import { readFileSync } from 'node:fs';
import Ajv from 'ajv/dist/2020.js';
import { getLanguageService } from 'vscode-json-languageservice';
import { TextDocument } from 'vscode-languageserver-textdocument';

const [schemaFile, corpusFile, ...graphFiles] = process.argv.slice(2);
const schema = JSON.parse(readFileSync(schemaFile, 'utf8'));
const corpus = readFileSync(corpusFile, 'utf8').trim().split('\n').map((line) => JSON.parse(line));
const withoutType = '{ "keyline": 1, "nodes": { "a": { "in": "b" } } }';
let failures = 0;

function expect(holds, what) {
  if (holds) return;
  failures += 1;
  if (failures <= 20) console.error(what);
}

const service = getLanguageService({});
service.configure({ allowComments: true, schemas: [] });

async function problemsInVsCode(text) {
  const document = TextDocument.create('file:///graph.json', 'jsonc', 1, text);
  const parsed = service.parseJSONDocument(document);
  const settings = { comments: 'ignore', trailingCommas: 'error' };
  const problems = await service.doValidation(document, parsed, settings, schema);
  return problems.map((p) => p.message);
}

const validate = new Ajv({ allErrors: true, strictTypes: false, strictTuples: false, strictRequired: false }).compile(schema);
for (const { graph, takes } of corpus)
  expect(validate(graph) === takes, `ajv: the loader ${takes ? 'takes' : 'refuses'} ${JSON.stringify(graph)}`);
expect(!validate(JSON.parse(withoutType)) && validate.errors.length === 1,
  `ajv: a node without a type is one fault, not ${validate.errors?.length}`);

// It reports less than it finds, and is slow: every tenth.
for (const { graph, takes } of corpus.filter((_, i) => i % 10 === 0)) {
  const problems = await problemsInVsCode(JSON.stringify(graph));
  expect((problems.length === 0) === takes,
    `VS Code: the loader ${takes ? 'takes' : 'refuses'} ${JSON.stringify(graph)}: ${problems.join('; ')}`);
}
const told = await problemsInVsCode(withoutType);
expect(told.length === 1, `VS Code: a node without a type is one fault, not ${told.join('; ')}`);

// What an editor offers in an empty "shape", and what it says of it.
const shape = '{ "keyline": 1, "nodes": { "a": { "type": "dilate", "shape": "" } } }';
const opened = TextDocument.create('file:///shape.json', 'jsonc', 1, shape);
const offering = getLanguageService({});
offering.configure({ schemas: [{ uri: 'keyline', fileMatch: ['*.json'], schema }] });
const position = { line: 0, character: shape.indexOf('""') + 1 };
const offered = await offering.doComplete(opened, position, offering.parseJSONDocument(opened));
const disk = offered.items.find((item) => item.label === '"disk"');
expect(disk?.documentation, `VS Code: it does not say what "disk" means: ${JSON.stringify(offered.items)}`);

for (const file of graphFiles) {
  const problems = await problemsInVsCode(readFileSync(file, 'utf8'));
  expect(problems.length === 0, `VS Code: ${file}: ${problems.join('; ')}`);
}

console.log(`${corpus.length} graphs judged, ${corpus.filter((c) => c.takes).length} of them sound, and ` +
  `${graphFiles.length} files; ${failures} differ from the loader`);
process.exit(failures === 0 ? 0 : 1);

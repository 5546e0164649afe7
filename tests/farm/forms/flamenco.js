// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
// flamenco.js TYPE JOB [run]: compiles a job with its type, a script, as Flamenco's manager does, and may run its tasks.
const { readFileSync } = require("fs"), { spawnSync } = require("child_process"), vm = require("vm");
const [typeFile, jobFile, run] = process.argv.slice(2);

class Task {
    constructor(name, type) { Object.assign(this, { name, type, commands: [], dependencies: [] }); }
    addCommand(command) { this.commands.push(command); }
    addDependency(task) { this.dependencies.push(task); }
}
const author = {
    Task: (name, type) => new Task(name, type),
    Command: (name, parameters) => ({ name, parameters }),
};
// Parts of so many frames each: ranges where they follow one another.
function frameChunker(text, size) {
    const frames = text.split(",").flatMap(part => {
        const [first, last] = part.split("-").map(Number);
        return Array.from({ length: (last ?? first) - first + 1 }, (_, i) => first + i);
    });
    const parts = [];
    for (let i = 0; i < frames.length; i += size) {
        const some = frames.slice(i, i + size), first = some[0], last = some[some.length - 1];
        parts.push(last - first === some.length - 1 && last > first ? first + "-" + last : some.join(","));
    }
    return parts;
}

const context = vm.createContext({ author, frameChunker });
vm.runInContext(readFileSync(typeFile, "utf8") + "\nthis.type = JOB_TYPE; this.compile = compileJob;", context);
const job = JSON.parse(readFileSync(jobFile, "utf8"));

const isOfType = { string: v => typeof v === "string", int32: Number.isInteger, bool: v => typeof v === "boolean" };
const fail = text => { console.error(text); process.exit(1); };
for (const key of ["name", "type", "priority", "submitter_platform", "settings", "metadata"])
    if (!(key in job)) fail("no " + key);
for (const key of Object.keys(job.settings))
    if (!context.type.settings.some(s => s.key === key)) fail("no such setting: " + key);
for (const { key, type, required, default: otherwise } of context.type.settings) {
    const value = job.settings[key] ?? otherwise;
    if (value === undefined ? required : !isOfType[type](value)) fail(key + " is no " + type);
    job.settings[key] = value;
}

const tasks = [];
context.compile({ ...job, addTask: task => tasks.push(task) });
const verify = tasks[tasks.length - 1];
if (tasks.map(t => t.name).join() !== "render-1-3,render-4-6,render-7,verify") fail(tasks.map(t => t.name).join());
if (verify.dependencies.length !== 3) fail("does not wait for all");
for (const { commands } of run ? tasks : [])
    for (const { name, parameters: { exe, args } } of commands)
        if (name !== "exec" || spawnSync(exe, args, { stdio: "inherit" }).status !== 0) fail(exe + " " + args);

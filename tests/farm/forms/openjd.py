#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
"""openjd.py BUNDLE [run]: holds a job bundle to the rules of Open Job Description 2023-09 that it relies on, each named by
its paragraph in "Template Schemas"; then breaks copies of it, which must be refused by the rule that was meant.  With
`run`, its tasks are run as a session would run them."""
import copy
import json
import pathlib
import re
import subprocess
import sys
import tempfile


class Refused(Exception):
    pass


def rule(paragraph, holds, what):
    if not holds:
        raise Refused(f"{paragraph} {what}")


def keys(paragraph, where, needed, possible=()):
    rule(paragraph, isinstance(where, dict), "an object")
    rule(paragraph, set(needed) <= set(where) <= set(needed) | set(possible), f"keys of {sorted(where)}")


def text(paragraph, value, most):
    rule(paragraph, isinstance(value, str) and 1 <= len(value) <= most, "a text of that length")
    rule(paragraph, not re.search(r"[\x00-\x1f\x7f-\x9f]", value), "no control characters")


def identifier(paragraph, value):
    rule(paragraph, isinstance(value, str) and re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]{0,63}", value), "an identifier")


def check(job):
    keys("1.1", job, ["specificationVersion", "name", "steps"], ["parameterDefinitions", "description", "jobEnvironments"])
    rule("1.1", job["specificationVersion"] == "jobtemplate-2023-09", "the version")
    text("1.1.1", job["name"], 128)
    rule("1.1", 1 <= len(job["steps"]), "a step at least")
    known = {"Session.PathMappingRulesFile", "Session.HasPathMappingRules", "Session.WorkingDirectory"}
    for parameter in job.get("parameterDefinitions", []):
        keys("2.2", parameter, ["name", "type"], ["objectType", "dataFlow", "default", "description"])
        identifier("7.1", parameter["name"])
        rule("2.2", parameter["type"] == "PATH", "the type")
        rule("2.2", parameter.get("objectType", "FILE") in ("FILE", "DIRECTORY"), "the object")
        rule("2.2", parameter.get("dataFlow", "IN") in ("NONE", "IN", "OUT", "INOUT"), "the flow")
        known |= {"Param." + parameter["name"], "RawParam." + parameter["name"]}
    names = [step.get("name") for step in job["steps"]]
    rule("1.1", len(set(names)) == len(names), "steps with names of their own")
    for i, step in enumerate(job["steps"]):
        check_step(step, names[:i], known)


def check_step(step, before, known):
    keys("3", step, ["name", "script"], ["dependencies", "hostRequirements", "parameterSpace", "description"])
    text("3.1", step["name"], 64)
    for dependency in step.get("dependencies", []):
        keys("3.2", dependency, ["dependsOn"])
        rule("3.2", dependency["dependsOn"] in before, "a step that there is, and no circle")
    for amount in step.get("hostRequirements", {}).get("amounts", []):
        keys("3.3.1", amount, ["name"], ["min", "max"])
        rule("3.3.1.1", re.fullmatch(r"amount(\.[A-Za-z_]\w*)+", str(amount["name"])), "the name of an amount")
        rule("3.3.1", "min" in amount or "max" in amount, "one of the limits")
        rule("3.3.1", all(type(amount.get(k, 1)) in (int, float) and amount.get(k, 1) >= 0 for k in ("min", "max")), "numbers")
    known = set(known)
    if "parameterSpace" in step:
        keys("3.4", step["parameterSpace"], ["taskParameterDefinitions"], ["combination"])
        parameters = step["parameterSpace"]["taskParameterDefinitions"]
        rule("3.4", 1 <= len(parameters) <= 16, "from 1 to 16 parameters")
        for parameter in parameters:
            keys("3.4.1.3", parameter, ["name", "type", "range"])
            identifier("7.1", parameter["name"])
            rule("3.4.1", parameter["type"] == "STRING", "the type")
            rule("3.4.1.3", isinstance(parameter["range"], list) and 1 <= len(parameter["range"]) <= 1024, "1 to 1024 values")
            for value in parameter["range"]:
                rule("3.4.2", isinstance(value, str) and len(value) <= 1024, "a text of at most 1024 characters")
            known |= {"Task.Param." + parameter["name"], "Task.RawParam." + parameter["name"]}
    keys("3.5", step["script"], ["actions"], ["embeddedFiles"])
    keys("3.5.1", step["script"]["actions"], ["onRun"])
    check_action(step["script"]["actions"]["onRun"], known)


def check_action(action, known):
    keys("5", action, ["command"], ["args", "timeout", "cancelation"])
    rule("5.1", isinstance(action["command"], str) and action["command"], "a command")
    rule("5", isinstance(action.get("args", []), list), "a list of arguments")
    for word in [action["command"], *action.get("args", [])]:
        rule("5.2", isinstance(word, str), "a text")
        for name in re.findall(r"\{\{(.*?)\}\}", word):
            rule("7.3.1", name.strip() in known, f"a value that there is: {name}")
        rule("7.3", "{{" not in re.sub(r"\{\{.*?\}\}", "", word), "whole expressions")
    if "cancelation" in action:
        how = action["cancelation"]
        rule("5.3", how.get("mode") in ("TERMINATE", "NOTIFY_THEN_TERMINATE"), "the mode")
        keys("5.3.2", how, ["mode"], ["notifyPeriodInSeconds"])
        period = how.get("notifyPeriodInSeconds", 1)
        rule("5.3.2", type(period) is int and 1 <= period <= 600, "from 1 to 600 seconds")


# What is done to a copy, and the rule that must see it.
def broken():
    def at(*path):
        def change(value):
            def do(job):
                for key in path[:-1]:
                    job = job[key]
                if value is None:
                    del job[path[-1]]
                else:
                    job[path[-1]] = value
            return do
        return change

    action = ("steps", 0, "script", "actions", "onRun")
    space = ("steps", 0, "parameterSpace", "taskParameterDefinitions")
    amounts = ("steps", 0, "hostRequirements", "amounts")
    return [
        ("1.1", at("specificationVersion")("jobtemplate-2022-09")), ("1.1", at("steps")([])), ("1.1", at("name")(None)),
        ("1.1", at("priority")(50)), ("1.1", at("steps", 1, "name")("Render")), ("1.1.1", at("name")("n" * 129)),
        ("1.1.1", at("name")("look\n")), ("2.2", at("parameterDefinitions", 0, "type")("FILE")),
        ("2.2", at("parameterDefinitions", 0, "dataFlow")("READ")), ("7.1", at("parameterDefinitions", 0, "name")("the graph")),
        ("3", at("steps", 0, "script")(None)), ("3.1", at("steps", 0, "name")("")),
        ("3.2", at("steps", 1, "dependencies", 0, "dependsOn")("Rendre")), ("3.3.1", at(*amounts, 0, "min")("one")),
        ("3.3.1", at(*amounts, 0, "min")(None)), ("3.3.1.1", at(*amounts, 0, "name")("worker.vcpu")),
        ("3.4", at(*space)([])), ("3.4.1", at(*space, 0, "type")("FRAMES")), ("3.4.1.3", at(*space, 0, "range")([])),
        ("3.4.1.3", at(*space, 0, "range")(["1"] * 1025)), ("3.4.2", at(*space, 0, "range")(["1," * 600])),
        ("3.5.1", at("steps", 0, "script", "actions")({"onrun": {}})), ("5", at(*action, "command")(None)),
        ("5", at(*action, "args")("render")), ("5.1", at(*action, "command")("")), ("5.3", at(*action, "cancelation")({"mode": "KILL"})),
        ("5.3.2", at(*action, "cancelation", "notifyPeriodInSeconds")(601)), ("7.3.1", at(*action, "args", 1)("{{Param.Graf}}")),
        ("7.3", at(*action, "args", 1)("{{Param.Graph")),
    ]


def run(job, parameters):
    with tempfile.TemporaryDirectory() as session:
        rules = pathlib.Path(session) / "rules.json"
        rules.write_text("{}")
        values = {"Session.PathMappingRulesFile": str(rules)}
        values |= {"Param." + p["name"]: p["value"] for p in parameters}
        for step in job["steps"]:
            action = step["script"]["actions"]["onRun"]
            space = step.get("parameterSpace", {}).get("taskParameterDefinitions", [])
            for task in space[0]["range"] if space else [None]:
                here = values | ({"Task.Param." + space[0]["name"]: task} if space else {})
                words = [re.sub(r"\{\{(.*?)\}\}", lambda m: here[m[1].strip()], w) for w in [action["command"], *action["args"]]]
                subprocess.run(words, check=True)


bundle = pathlib.Path(sys.argv[1])
template = json.loads((bundle / "template.json").read_text())
check(template)
for paragraph, change in broken():
    copied = copy.deepcopy(template)
    change(copied)
    try:
        check(copied)
    except Refused as refused:
        if str(refused).split()[0] != paragraph:
            sys.exit(f"refused by another rule than {paragraph}: {refused}")
    else:
        sys.exit(f"{paragraph} refuses nothing")
print(f"{len(broken())} broken copies refused")
if sys.argv[2:] == ["run"]:
    run(template, json.loads((bundle / "parameter_values.json").read_text())["parameterValues"])

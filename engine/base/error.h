// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/code.h"

#include <cstddef>
#include <cstdint>
#include <exception>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// What went wrong, where, and what to do.  Everything that can fail throws Failure; where several faults
// can be told in one run (a graph file), they are collected in Diagnostics instead.

namespace KEYLINE_API keyline {

// Who must act decides the exit status of the program (GRAPH: "Exit status").
enum class ErrorKind {
    kGraph,      // the graph or the command line is wrong: 2
    kInput,      // an input is missing, unreadable or damaged: 3
    kOutput,     // an output can't be written: 4
    kFailed,     // a frame failed for another reason: 1
    kInternal,   // a promise of Keyline's own code was broken: 1, and said to be so
    kCancelled,  // stopped on request; not an error to report
};

// Why a failure may be gone the next time: then the same command is worth another try, here or on another
// machine.
enum class Passing : uint8_t {
    kNever,       // it stays until somebody acts
    kSpace,       // the disk is full
    kQuota,       // the quota is used up
    kStale,       // a file server was restarted, or another machine replaced the file
    kDevice,      // a disk or a file server failed
    kTimeout,     // one did not answer
    kUnfinished,  // an input is still being written, or was cut off
    kMemory,      // there was too little
};

// A place in a graph file, or the command-line option that a value came from.
struct Place {
    std::string file;  // as typed by the user; or an option as typed, `--set smooth.sigma=-3`
    int line = 0;      // from 1; 0 where there is none
    int column = 0;    // from 1, in code points

    std::string text() const;  // "FILE:LINE:COLUMN", or just "FILE" without a line
    friend bool operator==(const Place&, const Place&) = default;
};

struct Error {
    ErrorKind kind = ErrorKind::kFailed;
    Place place;       // empty where the fault lies in no graph file
    std::string node;  // "node 'edges' (hysteresis)", "node 'a' (read), frame 7"; empty where there is none
    std::string what;  // values always; ends without a full stop
    std::string hint;  // what to do, or "did you mean 'sigma'?"; may be empty
    Passing passing = Passing::kNever;
    Code code = Code::kNone;

    // "PLACE: error: NODE: WHAT; HINT", leaving out what is empty.
    std::string text() const;

    // The same with "warning".  Scripts look for "error:" in what a program says: it is not in there, even
    // where a file's name holds it.
    std::string warning_text() const;
};

class Failure : public std::exception {
public:
    explicit Failure(Error error) : error_(std::move(error)), text_(error_.text()) {}
    const Error& error() const { return error_; }
    const char* what() const noexcept override { return text_.c_str(); }

private:
    Error error_;
    std::string text_;
};

// Throws Failure{kind, what, hint, passing}.  Layers that know more (the node, the frame) catch and complete
// it.
[[noreturn]] void fail(ErrorKind kind, std::string what, std::string hint = {},
                       Passing passing = Passing::kNever);

// The same with what kind of mistake it is.
[[noreturn]] void fail(Code code, ErrorKind kind, std::string what, std::string hint = {});

// Throws the failure on with what the edit does to its error; what the catcher knows is put in so.
template <class Edit>
[[noreturn]] void rethrow_with(const Failure& failure, const Edit& edit) {
    Error e = failure.error();
    edit(e);
    throw Failure(std::move(e));
}

// Faults and warnings in the order found.
class Diagnostics {
public:
    void error(Error e) { errors_.push_back(std::move(e)); }
    void warning(Error w) { warnings_.push_back(std::move(w)); }

    bool ok() const { return errors_.empty(); }
    const std::vector<Error>& errors() const { return errors_; }
    const std::vector<Error>& warnings() const { return warnings_; }

    // In the order of the places: those without one first, then options, then the lines of the graph.
    void sort_by_place();

private:
    std::vector<Error> errors_, warnings_;
};

// The exit status of a program that an error ended: that of its kind, or kTryAgain where it may pass.
inline constexpr int kTryAgain = 75;  // EX_TEMPFAIL of sysexits.h
int exit_status(const Error& error);

// The error of several that decides the status: one of the graph, else one that stays, else the first.
// There must be one.
const Error& decisive(const std::vector<Error>& errors);

// In a word, for other programs: why it may pass ("space", "memory", …), else whose fault it is ("graph",
// "input", "output", "failed", "internal").
std::string_view reason_of(const Error& error);
std::string_view kind_name(ErrorKind kind);

// The kind of mistake in a word, for `keyline explain` and other programs: its code, else reason_of().
std::string_view code_of(const Error& error);

// For messages: in quotes, cut to 60 characters, control characters escaped.
std::string in_quotes(std::string_view text);

// "did you mean 'sigma'?" when a candidate is near, else "".
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

// Names that a message lists at most; more help nobody.
inline constexpr std::size_t kMostListed = 12;

// "'a', 'b' and 'c'"
std::string listed(const std::vector<std::string>& words);

}  // namespace keyline

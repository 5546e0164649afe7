// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/aligned.h"
#include "engine/image.h"
#include "engine/io/image_sink.h"
#include "engine/io/image_source.h"
#include "engine/param_types.h"
#include "engine/stream.h"

#include <functional>
#include <memory>
#include <span>
#include <vector>

// What a node is written against, and what the engine sees of it.
//
// A node is a struct of values with no base class.  What it defines says what it is:
//
//     compute(…)                        a point operation
//     compute(…) and halo()             a stencil; with demand(out, slot) instead, one that moves the image
//     State, Partial, map, fold, …      a whole-frame node
//     read(Builder&) -> Stream          a source
//     write(Builder&)                   a sink
//     expand(Builder&) -> Stream        a compound of other operations
//
// compute() takes (const View& in, const MutView& out, Scratch&) and is called for each channel by itself, or
// (const Inputs& in, Outputs out, Scratch&) and is called once for all.  node_adaptor.h turns such a struct
// into an Operation.

namespace keyline {

struct Info {
    const char* name;  // as graphs write it
    const char* help;  // one sentence
};

// A worker's scratch memory.  What compute() takes from it lives until compute() returns.
class Scratch {
public:
    // n values of T, uninitialised, aligned for any vector.
    template <class T>
    std::span<T> take(std::size_t n) {
        static_assert(std::is_trivially_copyable_v<T>);
        return {static_cast<T*>(allocate(n * sizeof(T))), n};
    }
    std::span<float> floats(std::size_t n) { return take<float>(n); }

    // Gives all back.  What had to be taken piecemeal is one piece from then on, so that needs that grow
    // little by little leave nothing behind.
    void reset();
    std::size_t bytes() const;  // that are kept

private:
    struct Block {
        AlignedArray<std::byte> memory;
        std::size_t size = 0;
    };
    void* allocate(std::size_t bytes);

    std::vector<Block> blocks_;
    std::size_t block_ = 0, used_ = 0;
};

// The pixels of a node's inputs for one call of compute().
//
// A point operation's views cover exactly the region to compute, 0 outside the input's data window.  A
// stencil's cover that region grown by its halo, a moving node's what its demand() says, both clipped to the
// input's data window.
class Inputs {
public:
    struct Range {
        std::size_t first = 0, count = 0;
    };
    Inputs(std::span<const View> views, std::span<const Range> slots) : views_(views), slots_(slots) {}

    // The channels of an input, in the order of its Takes; empty where an optional one is not connected.
    std::span<const View> operator[](const Input& input) const { return slot(input.slot); }
    std::span<const View> operator[](const std::optional<Input>& input) const {
        return input ? slot(input->slot) : std::span<const View>{};
    }

private:
    std::span<const View> slot(int s) const {
        const Range& range = slots_[static_cast<std::size_t>(s)];
        return views_.subspan(range.first, range.count);
    }
    std::span<const View> views_;
    std::span<const Range> slots_;
};

// What compute() fills.  The rows of an output that nobody reads lie on each other (their stride is 0): a
// node may read back the row that it has just written, and no other.
using Outputs = std::span<const MutView>;

// A whole-frame node's memory: of one block (what map() makes of it), or of the frame (what fold() makes of
// those).  Only the node knows what is inside.
class Memory {
public:
    virtual ~Memory() = default;
};

class Reduction;

// What the engine runs: immutable, shared by all threads.  Made by node_adaptor.h.
class Operation {
public:
    virtual ~Operation() = default;

    virtual Halo halo() const { return {}; }

    // Whether a pixel is computed from the same pixel of the inputs; their views then cover exactly what is
    // computed, else demand() clipped to their data windows.
    virtual bool point() const { return halo() == Halo{}; }

    // The region of an input that `out` is computed from; clipped to the input's data window by the caller.
    virtual Rect demand(const Rect& out, int /*slot*/) const { return grow(out, halo()); }

    virtual void compute(const Inputs& in, Outputs out, Scratch& scratch) const = 0;

    // Not null for a whole-frame node, whose compute() is never called.
    virtual const Reduction* reduction() const { return nullptr; }

    // A rough count of arithmetic operations for a pixel, for the planner.
    virtual double cost() const { return 4; }
};

// Map, fold, apply.  The frame is cut into tiles; map() sees each of them (in parallel), fold() takes what it
// made in row-major order, one at a time.  The folded state must not depend on how the frame was cut: integer
// sums, minima, maxima and unions do not.  Several rounds over the input are possible; map() may use the
// state of the rounds before.
class Reduction {
public:
    virtual ~Reduction() = default;
    virtual int rounds() const = 0;
    virtual std::unique_ptr<Memory> start(const Rect& window) const = 0;
    virtual std::unique_ptr<Memory> map(const Memory& state, const Inputs& in, const Rect& block,
                                        Scratch& scratch) const = 0;
    virtual void fold(Memory& state, Memory& partial) const = 0;
    virtual void finish(Memory& state) const = 0;  // ends a round
    virtual void apply(const Memory& state, Outputs out, Scratch& scratch) const = 0;
    virtual std::size_t state_bytes(const Rect& window) const = 0;  // an upper bound for the usual frame
};

// One input of an operation: the values it reads and the data window they are seen through (outside it they
// are 0).  A port that is not connected has no values.
struct Link {
    Rect window;
    std::vector<ValueRef> values;
};

// A finished picture leaving the graph.
struct SinkRequest {
    Stream stream;  // channels in the order to be written
    SinkSpec spec;  // spec.channels: one a channel of the stream
    std::filesystem::path file;
    std::function<void(const SinkSpec&)> check;  // throws what is wrong with the spec; may be empty
    std::function<std::unique_ptr<ImageSink>(const SinkSpec&)> create;
};

class ColorConfig;

// What a node may ask while it is prepared for one frame.
class Context {
public:
    virtual ~Context() = default;
    virtual int frame() const = 0;

    // The stream of an input, after its selector, for this frame or another.  Throws Failure.
    virtual Stream input(const Input& input, int frame) = 0;
    Stream input(const Input& in) { return input(in, frame()); }

    // The colour management of the graph; loaded when first asked for.
    virtual const ColorConfig& colors() = 0;

    virtual void warn(std::string what) = 0;

    // Throws the Failure of a parameter whose value is wrong; its place is added.
    [[noreturn]] virtual void bad_parameter(const char* name, std::string what, std::string hint = {}) = 0;
};

// What a source, a sink or a compound builds its part of the frame's operations with.
class Builder : public Context {
public:
    // A new operation; `links` has one entry an input slot.  Returns its outputs.
    virtual std::vector<ValueRef> add(std::shared_ptr<const Operation> operation, std::vector<Link> links,
                                      const Rect& window, int outputs) = 0;

    // All channels of an open image.
    virtual Stream add_source(std::shared_ptr<const ImageSource> source) = 0;

    virtual void add_sink(SinkRequest request) = 0;

    // The same samples, but 0 outside `window`; still of their file's type.
    virtual ValueRef clip(ValueRef value, const Rect& window) = 0;

    // The type that a value has in its file; nothing where it is computed.
    virtual std::optional<SampleType> stored_type(ValueRef value) const = 0;

    // Whether a node that says it changes nothing is left out.  No only where a test wants to see it compute.
    virtual bool leaves_out_identities() const { return true; }
};

// The stream's channels that a port takes, in its order.  Throws Failure (kGraph) that says what is missing
// and which layers have it.
std::vector<ValueRef> take_channels(const Stream& stream, const Takes& takes);

}  // namespace keyline

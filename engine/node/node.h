// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/aligned.h"
#include "engine/base/api.h"
#include "engine/base/image.h"
#include "engine/base/index.h"
#include "engine/io/image_sink.h"
#include "engine/io/image_source.h"
#include "engine/node/datum.h"
#include "engine/node/stream.h"
#include "engine/params/param_types.h"

#include <functional>
#include <memory>
#include <span>
#include <typeindex>
#include <vector>

// What a node is written against, and what the engine sees of it.
//
// A node is a struct of values with no base class.  What it defines says what it is:
//
//     compute(…)                        a point operation
//     compute(…) and halo()             a stencil; with demand(out, slot) instead, one that moves the image
//     State, Partial, map, fold, …      a gather: from the pixels of the whole frame to a datum
//     derive(…)                         from data to a datum
//     read(Builder&) -> Stream          a source
//     write(Builder&)                   a sink
//     expand(Builder&) -> Stream        a compound of other operations
//
// describe(Builder&, Nature&), where there is one, says what is known of the channels that it makes
// (stream.h), and warns of what can't be meant.
//
// compute() takes (const View& in, const MutView& out, Scratch&) and is called for each channel by itself, or
// (const Inputs& in, Outputs out, Scratch&) and is called once for all.  node_adaptor.h turns such a struct
// into an Operation, a Gather or a Derivation.

namespace KEYLINE_API keyline {

struct Info {
    const char* name;  // as graphs write it
    const char* help;  // one sentence
    int version = 1;   // counts changes of what the node makes of the same inputs and parameters
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

// A node's inputs for one call of compute(), map() or derive(): pixels of the one kind of input, a datum of
// the other.
//
// A point operation's views cover exactly the region to compute, 0 outside the input's data window.  A
// stencil's cover that region grown by its halo, a moving node's what its demand() says, both clipped to
// where the input's picture ends; between its data window and there they are 0.  A gather's cover its block.
class Inputs {
public:
    struct Range {
        std::size_t first = 0, count = 0;
    };
    // `data` has a datum for each slot that takes one, and null for the others.
    Inputs(std::span<const View> views, std::span<const Range> slots, std::span<const Datum* const> data)
        : views_(views), slots_(slots), data_(data) {}

    // The channels of an input, in the order of its Takes; empty where an optional one is not connected.
    std::span<const View> operator[](const Input& input) const { return slot(input.slot); }
    std::span<const View> operator[](const std::optional<Input>& input) const {
        return input ? slot(input->slot) : std::span<const View>{};
    }
    std::span<const View> slot(int s) const {
        const Range& range = slots_[index(s)];
        return views_.subspan(range.first, range.count);
    }

    // The datum of an input that takes one; null where an optional one is not connected.
    template <DataKind T>
    const T& datum(const Input& input) const {
        return datum<T>(input.slot);
    }
    template <DataKind T>
    const T* datum(const std::optional<Input>& input) const {
        return input ? &datum<T>(input->slot) : nullptr;
    }
    template <DataKind T>
    const T& datum(int slot) const {
        return datum_as<T>(*data_[index(slot)]);
    }
    // Of whatever kind it is.
    const Datum& any_datum(int slot) const { return *data_[index(slot)]; }

private:
    std::span<const View> views_;
    std::span<const Range> slots_;
    std::span<const Datum* const> data_;
};

// What compute() fills.  The rows of an output that nobody reads lie on each other (their stride is 0): a
// node may read back the row that it has just written, and no other.
using Outputs = std::span<const MutView>;

// Pixels from pixels and data, what the engine runs tile by tile: immutable, shared by all threads.  Made by
// node_adaptor.h.
class Operation {
public:
    virtual ~Operation() = default;

    virtual Halo halo() const { return {}; }

    // Whether a pixel is computed from the same pixel of the inputs; their views then cover exactly what is
    // computed, else demand() clipped to where they end.
    virtual bool point() const { return halo() == Halo{}; }

    // The region of an input that `out` is computed from; clipped by the caller to where the input ends.
    virtual Rect demand(const Rect& out, int /*slot*/) const { return grow(out, halo()); }

    virtual void compute(const Inputs& in, Outputs out, Scratch& scratch) const = 0;

    // A rough count of arithmetic operations for a pixel, for the planner.
    virtual double cost() const { return 4; }

    // What computing met that is worth a warning, once the frame is done.
    virtual std::vector<std::string> findings() const { return {}; }
};

// A datum from the pixels of the whole frame, and from data.  The frame is cut into tiles; map() sees each of
// them (in parallel), fold() takes what it made in row-major order, one at a time.  The folded state must not
// depend on how the frame was cut: integer sums, minima, maxima and unions do not.  Several rounds over the
// input are possible; map() may use the state of the rounds before.
class Gather {
public:
    // What folding adds to, and what map() makes of one block.  Only the node knows what is inside.
    class State {
    public:
        virtual ~State() = default;
    };
    class Partial {
    public:
        virtual ~Partial() = default;
    };

    virtual ~Gather() = default;
    virtual const char* gives() const = 0;  // the kind of its datum
    virtual int rounds() const = 0;
    virtual std::unique_ptr<State> start(const Rect& window) const = 0;
    virtual std::unique_ptr<Partial> map(const State& state, const Inputs& in, const Rect& block,
                                         Scratch& scratch) const = 0;
    virtual void fold(State& state, Partial& partial) const = 0;
    virtual void end_round(State& state) const = 0;                       // each but the last
    virtual std::shared_ptr<const Datum> finish(State& state) const = 0;  // ends the last

    // Upper bounds for the usual frame, for the planner; the state's beside what becomes the datum.
    virtual std::size_t state_bytes(const Rect& window) const = 0;
    virtual std::size_t partial_bytes(const Rect& block) const = 0;
    virtual std::size_t datum_bytes(const Rect& window) const = 0;
};

// A datum from data, once a frame, between two sweeps.  Without inputs it is a source of data: read once a
// frame, just before the first sweep that needs it.
class Derivation {
public:
    virtual ~Derivation() = default;
    virtual const char* gives() const = 0;  // the kind of its datum
    virtual std::shared_ptr<const Datum> derive(const Inputs& in) const = 0;
    virtual std::size_t datum_bytes() const = 0;  // as Gather's

    // The file that a source reads; empty: none.
    virtual std::filesystem::path file() const { return {}; }
};

// One input of an operation: the values it reads, the data window they are seen through (outside it they are
// 0), and the rectangle in which they are seen at all (outside it the picture ends); or the datum.  A port
// that is not connected has neither.
struct Link {
    Link() = default;
    Link(const Stream& stream, std::vector<ValueRef> v)
        : window(stream.window), extent(stream.extent()), values(std::move(v)), datum(stream.datum) {}
    Link(const Rect& w, const Rect& e, std::vector<ValueRef> v)
        : window(w), extent(e), values(std::move(v)) {}

    Rect window, extent;
    std::vector<ValueRef> values;
    ValueRef datum = {};
};

// Where the result of an operation on pixels that moves nothing may be other than 0: the data windows of what
// it reads, grown by its reach as far as the pictures go (a stencil's as far as its first input goes, which
// it follows).  Where it makes something of nothing, such as 1 − 0, or of data, that is everywhere in them.
Rect result_window(const Operation& operation, std::span<const Link> links, std::size_t outputs);

// A datum leaving the graph.
class DataSink {
public:
    virtual ~DataSink() = default;

    // Writes the datum where it appears whole or not at all.  Throws Failure (kOutput).
    virtual void write(const std::shared_ptr<const Datum>& datum) = 0;
};

// A finished picture leaving the graph, or a datum.
struct SinkRequest {
    Stream stream;  // channels in the order to be written, or the datum
    SinkSpec spec;  // spec.channels: one a channel of the stream
    std::filesystem::path file;
    std::function<void(const SinkSpec&)> check;  // throws what is wrong with the spec; may be empty
    std::function<std::unique_ptr<ImageSink>(const SinkSpec&)> create;
    std::function<std::unique_ptr<DataSink>()> create_for_data;  // instead, where the stream is data
};

class ColorConfig;

// What a node may ask while it is prepared for one frame.
class Context {
public:
    virtual ~Context() = default;
    virtual int frame() const = 0;

    // The stream of an input, after its selector, for this frame or another.  Throws Failure.
    virtual Stream input(const Input& input) = 0;
    virtual Stream input(const Input& input, int frame) = 0;

    // The colour management of the graph; loaded when first asked for.
    virtual const ColorConfig& colors() = 0;
    // The same with variables of its context.
    virtual std::shared_ptr<const ColorConfig> colors(const Map<std::string>& variables) = 0;

    // An image file.  One that does not change is read once for all nodes and frames.  Throws Failure as
    // open_image() does.
    virtual std::shared_ptr<const ImageSource> open(const std::filesystem::path& file,
                                                    const OpenOptions& options) = 0;

    // Which file has a name now.  For one that the node reads by itself: what it makes depends on it.
    virtual Digest file(const std::filesystem::path& file) = 0;

    // What follows from `key` alone, such as what a text says: made once and kept for other nodes and frames
    // while there is room.  `bytes` is about what it takes to keep.
    template <class T, class Make>
    std::shared_ptr<const T> remember(const Digest& key, std::size_t bytes, const Make& make) {
        return std::static_pointer_cast<const T>(
            remembered(key, typeid(T), bytes, [&] { return std::make_shared<const T>(make()); }));
    }

    virtual void warn(std::string what) = 0;

    // The same of a mistake that the graph may say is meant, as the message then tells.  Not told of a graph
    // that says so.
    virtual void warn(Code mistake, std::string what, std::string hint) = 0;

    // Throws the Failure of a parameter whose value is wrong; its place is added.
    [[noreturn]] virtual void bad_parameter(const char* name, std::string what, std::string hint = {}) = 0;

private:
    virtual std::shared_ptr<const void> remembered(
        const Digest& key, std::type_index type, std::size_t bytes,
        const std::function<std::shared_ptr<const void>()>& make) = 0;
};

// What a source, a sink or a compound builds its part of the frame's operations with.
class Builder : public Context {
public:
    // A new operation; `links` has one entry an input slot.  Returns its outputs.
    virtual std::vector<ValueRef> add(std::shared_ptr<const Operation> operation, std::vector<Link> links,
                                      const Rect& window, int outputs) = 0;

    // A new datum.  The window is what a gather sees of its inputs.
    virtual ValueRef add(std::shared_ptr<const Gather> gather, std::vector<Link> links,
                         const Rect& window) = 0;
    virtual ValueRef add(std::shared_ptr<const Derivation> derivation, std::vector<Link> links) = 0;

    // A datum that comes from outside.
    Stream add_source(std::shared_ptr<const Derivation> source);

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

}  // namespace keyline

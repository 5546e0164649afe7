// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/plan/demand.h"
#include "engine/plan/resolve.h"

#include <compare>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace keyline {
class Bands;  // of run/: samples, which a plan never looks at
}

namespace KEYLINE_API keyline {

struct Plan;

// What frames of a run leave for later ones.  It is planned like all else: the frames to come are known, so
// that nothing is held that none of them wants, and nothing beyond the memory.

// One output of an operation, of whichever frame: equal for the same values.
struct ValueKey {
    Digest op;
    int output = 0;
    friend auto operator<=>(const ValueKey&, const ValueKey&) = default;
};

// What an earlier frame left: samples, decoded or computed, or a datum.
struct Carried {
    // Operations that its values were computed by.  Who uses it warns of what they found, which depends on
    // what was demanded of them.
    struct Behind {
        Digest digest;
        Rect region;
        std::shared_ptr<const Operation> operation;
    };

    std::string title;           // "a.0007.exr", "node 'soft' (gaussian), frame 7"
    std::vector<ValueKey> keys;  // of each plane; one of a datum
    std::vector<Rect> regions;   // and what there is of it
    std::vector<Behind> behind;
    // Open as long as what was decoded from them is held: they know what they met.
    std::vector<std::shared_ptr<const ImageSource>> sources;
    std::size_t bytes = 0;
    int until = 0;  // the frame that uses it last
    bool is_datum = false;

    // Of samples.
    std::vector<SampleType> types;
    Rect region;
    int band_origin = 0, band_height = 0;

    int made_as = -1;  // the store, or the operation of the datum, of the frame that makes it
    std::shared_ptr<Bands> bands;
    std::shared_ptr<const Datum> datum;
};

// What is known of a coming frame: enough to tell what it will want.  Its files stay open for nobody.
class ComingFrame {
public:
    ComingFrame(const ResolvedFrame& resolved, const Demand& demand);

    int frame() const { return frame_; }

    // Whether both frames have an operation that makes values of pixels from a file, or data.
    bool shares_with(const ComingFrame& other) const;

    // Whoever asks says how much of a value there is; nothing: it isn't there.
    using IsThere = std::function<bool(const ValueKey& key, const Rect& region, bool is_exact)>;

    // The values that it would use of those that are there.
    std::vector<ValueKey> wanted(const IsThere& is_there) const;

private:
    struct Part {  // an operation
        Digest digest;
        bool is_source = false, is_resident = false, is_data = false;
        bool is_dear = false;  // a file is decoded for it, or a stencil run
        std::vector<Rect> regions;
        std::vector<ValueRef> reads;
    };
    int frame_;
    std::vector<Part> parts_;
    std::vector<ValueRef> roots_;
};

// The coming frame that wants a value last: by its turn in the run, which need not go up in frames.
struct LastUse {
    std::size_t turn = 0;
    int frame = 0;
    friend auto operator<=>(const LastUse&, const LastUse&) = default;
};

// What one frame takes from earlier ones and leaves for later ones.
struct Carrying {
    struct Found {
        std::size_t held = 0, plane = 0;
    };
    std::vector<Carried> held;           // all that stays in memory while the frame is at work
    std::map<ValueRef, Found> found;     // values of the frame that are there already; of a datum, output 0
    std::map<ValueRef, LastUse> wanted;  // values to leave
    std::vector<bool> needed;            // by operation: run in this frame

    bool is_found(ValueRef v) const { return found.contains(v); }
    std::size_t held_bytes() const;
};

// Nothing is taken and nothing left where both `held` and `coming` are empty.
Carrying plan_carrying(const ResolvedFrame& frame, const Demand& demand, std::span<const Carried> held,
                       std::span<const ComingFrame> coming);

// What the frame will leave, beside what of plan.carrying.held stays.  Its memory is for the run to fill in.
std::vector<Carried> to_hand_on(const Plan& plan);

}  // namespace keyline

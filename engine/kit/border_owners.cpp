// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/border_owners.h"

#include "engine/base/index.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace keyline {

namespace {

constexpr int kMedian = 3;    // neighbours on either side that a step is told from
constexpr int kShortest = 5;  // crossings of a run; shorter ones are noise

// How far the object at the right is in front of the other, in pixels of the nearer one, across its surface;
// below 0 where it is behind.
double step_at(const BorderMap& map, const Border& border, int crossing, double pixel_angle) {
    const Crossing::Side &right = map.side(crossing, border.right), &left = map.side(crossing, border.left);
    if (right.near == left.near) return 0;
    const bool in_front = right.near > left.near;
    const Crossing::Side &front = in_front ? right : left, &back = in_front ? left : right;
    const double most = std::numeric_limits<float>::max();
    const double ratio = back.near > 0 ? double{front.near} / double{back.near} : most;
    const double step = std::min((ratio - 1) / pixel_angle * double{front.facing}, most);
    return in_front ? step : -step;
}

class Line {
public:
    Line(int count, bool closed) : count_(count), closed_(closed) {}

    int count() const { return count_; }
    // A neighbour's index; -1 beyond the ends.
    int at(int i) const {
        if (closed_) return (i % count_ + count_) % count_;
        return i >= 0 && i < count_ ? i : -1;
    }
    // Where the runs of equal values begin; of a closed line without a change nowhere.
    std::vector<int> changes(const std::vector<bool>& values) const {
        std::vector<int> out;
        for (int i = 0; i < count_; ++i) {
            const int before = at(i - 1);
            if (before < 0 || values[index(before)] != values[index(i)]) out.push_back(i);
        }
        return out;
    }
    int length(const std::vector<int>& starts, std::size_t run) const {
        if (run + 1 < starts.size()) return starts[run + 1] - starts[run];
        return closed_ ? starts[0] + count_ - starts[run] : count_ - starts[run];
    }

private:
    int count_;
    bool closed_;
};

std::vector<double> smoothed(const std::vector<double>& steps, const Line& line) {
    std::vector<double> out, near;
    for (int i = 0; i < line.count(); ++i) {
        near.clear();
        for (int k = -kMedian; k <= kMedian; ++k)
            if (const int j = line.at(i + k); j >= 0) near.push_back(steps[index(j)]);
        const auto middle = near.begin() + static_cast<std::ptrdiff_t>(near.size() / 2);
        std::ranges::nth_element(near, middle);
        out.push_back(*middle);
    }
    return out;
}

void set(std::vector<bool>& values, const Line& line, int first, int count, bool value) {
    for (int k = 0; k < count; ++k) values[index(line.at(first + k))] = value;
}

// Runs of small steps that hold a smaller one.
std::vector<bool> find_meetings(const std::vector<double>& steps, const Line& line,
                                const std::array<double, 2>& limits) {
    std::vector<bool> meets;
    for (const double s : steps) meets.push_back(std::fabs(s) < limits[1]);
    const auto holds = [&](int first, int count) {
        for (int k = 0; k < count; ++k)
            if (std::fabs(steps[index(line.at(first + k))]) < limits[0]) return true;
        return false;
    };
    const std::vector<int> starts = line.changes(meets);
    if (starts.empty() && !holds(0, line.count())) meets.assign(meets.size(), false);
    for (std::size_t r = 0; r < starts.size(); ++r)
        if (const int n = line.length(starts, r); meets[index(starts[r])] && !holds(starts[r], n))
            set(meets, line, starts[r], n, false);
    return meets;
}

// First the short meetings go, then the short steps between meetings.
void drop_short(std::vector<bool>& meets, const Line& line) {
    for (const bool value : {true, false}) {
        const std::vector<int> starts = line.changes(meets);
        if (starts.size() < 2) return;
        for (std::size_t r = 0; r < starts.size(); ++r)
            if (const int n = line.length(starts, r); n < kShortest && meets[index(starts[r])] == value)
                set(meets, line, starts[r], n, !value);
    }
}

// Decides by majority: above 0 for the object at the right.
int vote(const std::vector<double>& steps, const Line& line, const OwnedRun& run) {
    int sum = 0;
    for (int k = 0; k < run.count; ++k) {
        const double s = steps[index(line.at(run.first + k))];
        sum += s > 0 ? 1 : s < 0 ? -1 : 0;
    }
    return sum;
}

// Where no step decides, the one that faces the camera more does, or the larger id.
uint32_t owner_by_facing(const BorderMap& map, const Border& border, const Line& line, const OwnedRun& run) {
    constexpr float kSame = 0.05F;
    int sum = 0;
    for (int k = 0; k < run.count; ++k) {
        const int c = border.crossings[index(line.at(run.first + k))];
        const float more = map.side(c, border.right).facing - map.side(c, border.left).facing;
        sum += more > kSame ? 1 : more < -kSame ? -1 : 0;
    }
    return sum != 0 ? (sum > 0 ? border.right : border.left) : std::max(border.right, border.left);
}

// A line has one owner along its way: where objects meet it is that of the longest step beside it.
void decide(const BorderMap& map, const Border& border, const std::vector<double>& steps, const Line& line,
            std::vector<OwnedRun>& runs) {
    const auto by_steps = [&](OwnedRun& run) {
        const int votes = vote(steps, line, run);
        run.owner = votes > 0   ? border.right
                    : votes < 0 ? border.left
                                : owner_by_facing(map, border, line, run);
    };
    for (OwnedRun& run : runs)
        if (!run.meets) by_steps(run);
    const Line order(static_cast<int>(runs.size()), border.closed);
    for (int r = 0; r < order.count(); ++r) {
        OwnedRun& run = runs[index(r)];
        if (!run.meets) continue;
        std::pair<int, uint32_t> longest{0, 0};
        for (const int beside : {order.at(r - 1), order.at(r + 1)})
            if (beside >= 0 && !runs[index(beside)].meets)
                longest = std::max(longest, {runs[index(beside)].count, runs[index(beside)].owner});
        run.owner = longest.first > 0 ? longest.second : owner_by_facing(map, border, line, run);
    }
}

}  // namespace

std::vector<OwnedRun> runs_of(const BorderMap& map, const Border& border, const StepLimits& limits) {
    const Line line(static_cast<int>(border.crossings.size()), border.closed);
    if (border.right == 0 || border.left == 0)
        return {{0, line.count(), false, std::max(border.right, border.left)}};
    std::vector<double> steps;
    bool known = false;
    for (const int c : border.crossings) {
        steps.push_back(step_at(map, border, c, limits.pixel_angle));
        known |= map.side(c, border.right).near > 0 || map.side(c, border.left).near > 0;
    }
    if (!known) return {{0, line.count(), false, std::max(border.right, border.left)}};
    steps = smoothed(steps, line);
    std::vector<bool> meets = find_meetings(steps, line, limits.step);
    drop_short(meets, line);
    std::vector<int> starts = line.changes(meets);
    if (starts.empty()) starts = {0};
    std::vector<OwnedRun> runs;
    for (std::size_t r = 0; r < starts.size(); ++r)
        runs.push_back({starts[r], line.length(starts, r), meets[index(starts[r])], 0});
    decide(map, border, steps, line, runs);
    return runs;
}

}  // namespace keyline

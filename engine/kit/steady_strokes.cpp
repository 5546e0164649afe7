// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/steady_strokes.h"

#include "engine/kit/piece_index.h"
#include "engine/kit/stroke_way.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>

namespace keyline {

namespace {

constexpr double kAcross = 1;    // pixels between two frames' places of one line
constexpr double kNoLine = 1.5;  // pixels to the nearest line where there is none
constexpr double kSameWay = 0.87;
constexpr double kGone = 0.2, kWhole = 0.9;  // shares of frames that have a line: it is not drawn, and whole
constexpr std::size_t kShortest = 5;         // vertices that are taken from the frames on both sides
constexpr std::ptrdiff_t kEven = 3;  // vertices on either side over which what frames say is evened out

struct Way {
    double x = 0, y = 0;
};

Way direction(const std::vector<StrokeVertex>& v, bool closed, std::size_t i) {
    const StrokeWay way = way_at(v, closed, i);
    return way.length > 0 ? Way{way.x / way.length, way.y / way.length} : Way{};
}

// What is looked for: a line of an owner, across the way at a place.
struct Wanted {
    double x = 0, y = 0;
    Way way;
    const Stroke* of = nullptr;  // whose it is; anybody's where there is none
    StrokeKind kind = StrokeKind::kUser;

    // Of two things that touch, one frame says that the one owns their line, and the next the other.
    bool may_be(const Stroke& s) const {
        return !of || s.near == of->near || (s.near == of->far && s.far == of->near);
    }
};

struct Found {
    double off = 0;  // to the right
    double width = 0, opacity = 0;
};

// Strokes by place.
class LinesAt {
public:
    explicit LinesAt(const Strokes& strokes) : pieces_(strokes.strokes) {
        pieces_.add_all([](uint32_t, uint32_t, uint32_t) { return true; });
    }
    // Only what of them is seen.
    explicit LinesAt(const CarriedStrokes& carried) : pieces_(carried.strokes.strokes) {
        std::vector<std::size_t> first{0};
        for (const Stroke& s : carried.strokes.strokes) first.push_back(first.back() + s.vertices.size());
        pieces_.add_all([&](uint32_t s, uint32_t i, uint32_t k) {
            return carried.seen[first[s] + i] != 0 && carried.seen[first[s] + k] != 0;
        });
    }

    // The nearest that runs the same way; one of another kind only where there is none of its own.
    std::optional<Found> find(const Wanted& wanted, double reach) const {
        std::optional<Found> best;
        double least = 2 * reach;
        pieces_.near(wanted.x, wanted.y, reach + kBeyond, [&](const PieceIndex::Piece& piece) {
            const Stroke& stroke = pieces_.of(piece);
            if (!wanted.may_be(stroke)) return;
            const auto found = across(pieces_.from(piece), pieces_.to(piece), wanted);
            if (!found || std::fabs(found->off) > reach) return;
            const double cost = std::fabs(found->off) + (stroke.kind == wanted.kind ? 0 : reach);
            if (cost >= least) return;
            least = cost;
            best = found;
        });
        return best;
    }

private:
    static constexpr double kBeyond = 0.5;  // pixels that a line may end before the place

    static std::optional<Found> across(const StrokeVertex& a, const StrokeVertex& b, const Wanted& w) {
        const double ax = a.x - w.x, ay = a.y - w.y, bx = b.x - w.x, by = b.y - w.y;
        const double from = ax * w.way.x + ay * w.way.y, to = bx * w.way.x + by * w.way.y;
        const double dx = bx - ax, dy = by - ay, length = std::sqrt(dx * dx + dy * dy);
        if (!(length > 0) || std::fabs(to - from) < kSameWay * length) return {};
        const double share = std::clamp(-from / (to - from), 0.0, 1.0);
        if (std::fabs(from + share * (to - from)) > kBeyond) return {};
        const auto between = [&](double p, double q) { return p + share * (q - p); };
        return Found{between(w.way.x * ay - w.way.y * ax, w.way.x * by - w.way.y * bx),
                     between(a.width, b.width), between(a.opacity, b.opacity)};
    }

    PieceIndex pieces_;
};

struct Neighbour {
    FrameBeside frame;
    double weight = 0;
    LinesAt lines;
};

// What all frames say of one vertex.
struct Verdict {
    double off = 0, width = 0, opacity = 0;
    double presence = 0;
};

template <class Member>
void even_out(std::vector<Verdict>& verdicts, bool closed, bool pointed, Member member) {
    std::vector<double> before;
    for (const Verdict& v : verdicts) before.push_back(v.*member);
    for (std::size_t i = 0; i < verdicts.size(); ++i)
        verdicts[i].*member = mean_along(before, closed, i, kEven, pointed);
}

double drawn_share(double presence) { return std::clamp((presence - kGone) / (kWhole - kGone), 0.0, 1.0); }

class Steadier {
public:
    Steadier(const Strokes& here, const std::vector<FrameBeside>& beside) : here_(here), lines_(here) {
        int reach = 1;
        for (const FrameBeside& b : beside) reach = std::max(reach, std::abs(b.since));
        own_weight_ = weight(0, reach);
        for (const FrameBeside& b : beside)
            if (!b.there->strokes.strokes.empty())
                beside_.push_back({b, weight(std::abs(b.since), reach), LinesAt(*b.there)});
    }

    Strokes steadied() {
        Strokes out{here_.display, here_.window, here_.names, {}};
        std::size_t first = 0;
        for (const Stroke& s : here_.strokes) {
            add_drawn(settled(s, first), out.strokes);
            first += s.vertices.size();
        }
        add_missing(out);
        arrange(out);
        return out;
    }

private:
    static double weight(int distance, int reach) {
        constexpr std::array<std::array<double, 3>, 2> kWeights{{{2, 1, 0}, {4, 3, 1}}};
        return kWeights[reach > 1 ? 1 : 0][static_cast<std::size_t>(std::min(distance, 2))];
    }

    Verdict verdict_at(const Stroke& s, std::size_t i, std::size_t among_all) const {
        const StrokeVertex& v = s.vertices[i];
        const Wanted wanted{v.x, v.y, direction(s.vertices, s.closed, i), &s, s.kind};
        Verdict out{0, own_weight_ * v.width, own_weight_ * v.opacity, 0};
        double having = own_weight_, all = own_weight_;
        for (const Neighbour& b : beside_) {
            if (!b.frame.from_here->seen[among_all]) continue;
            all += b.weight;
            const auto found = b.lines.find(wanted, kAcross);
            if (!found) continue;
            having += b.weight;
            out.off += b.weight * found->off;
            out.width += b.weight * found->width;
            out.opacity += b.weight * found->opacity;
        }
        return {out.off / having, out.width / having, out.opacity / having, having / all};
    }

    // A stroke where all frames have it; of a width of 0 where it is gone.
    Stroke settled(const Stroke& s, std::size_t first) const {
        std::vector<Verdict> verdicts;
        for (std::size_t i = 0; i < s.vertices.size(); ++i) verdicts.push_back(verdict_at(s, i, first + i));
        even_out(verdicts, s.closed, true, &Verdict::off);
        even_out(verdicts, s.closed, false, &Verdict::presence);
        Stroke out = s;
        for (std::size_t i = 0; i < s.vertices.size(); ++i) {
            const Way way = direction(s.vertices, s.closed, i);
            const Verdict& verdict = verdicts[i];
            StrokeVertex& v = out.vertices[i];
            v.x -= verdict.off * way.y;
            v.y += verdict.off * way.x;
            v.width = verdict.width * drawn_share(verdict.presence);
            v.opacity = verdict.opacity;
        }
        return out;
    }

    // What has a width, in as many parts as it is in.
    static void add_drawn(Stroke s, std::vector<Stroke>& out) {
        const auto is_gone = [](const StrokeVertex& v) { return !(v.width > 0); };
        const auto gone = std::ranges::find_if(s.vertices, is_gone);
        if (gone == s.vertices.end()) return out.push_back(std::move(s));
        if (s.closed) {
            std::rotate(s.vertices.begin(), gone, s.vertices.end());
            s.closed = false;
            s.ends = {};
        }
        for (auto begin = s.vertices.begin(); begin != s.vertices.end();) {
            begin = std::find_if_not(begin, s.vertices.end(), is_gone);
            const auto end = std::find_if(begin, s.vertices.end(), is_gone);
            if (end - begin < 2) {
                begin = end;
                continue;
            }
            Stroke& part = out.emplace_back(s);
            part.vertices.assign(begin, end);
            if (begin != s.vertices.begin()) part.ends[0] = StrokeEnd::kEnd;
            if (end != s.vertices.end()) part.ends[1] = StrokeEnd::kEnd;
            begin = end;
        }
    }

    const Neighbour* beside(int since) const {
        const auto it = std::ranges::find_if(beside_, [&](const auto& b) { return b.frame.since == since; });
        return it != beside_.end() ? &*it : nullptr;
    }

    // What the frame before and the next have: half way between them.
    void add_missing(Strokes& out) const {
        const Neighbour *before = beside(-1), *next = beside(1);
        if (!before || !next) return;
        std::size_t first = 0;
        for (const Stroke& s : before->frame.there->strokes.strokes) {
            add_missing(s, before->frame.there->seen, first, *next, out.strokes);
            first += s.vertices.size();
        }
        for (const auto& [id, name] : before->frame.there->strokes.names) out.names.emplace(id, name);
    }

    void add_missing(const Stroke& s, const std::vector<uint8_t>& seen, std::size_t first,
                     const Neighbour& next, std::vector<Stroke>& out) const {
        Stroke run = s;
        run.closed = false;
        run.ends = {};
        run.vertices.clear();
        const auto end_run = [&] {
            if (run.vertices.size() >= kShortest) add_drawn(run, out);
            run.vertices.clear();
        };
        for (std::size_t i = 0; i < s.vertices.size(); ++i) {
            const auto missing = seen[first + i] ? missing_at(s, i, next) : std::optional<StrokeVertex>();
            missing ? run.vertices.push_back(*missing) : end_run();
        }
        end_run();
    }

    std::optional<StrokeVertex> missing_at(const Stroke& s, std::size_t i, const Neighbour& next) const {
        StrokeVertex v = s.vertices[i];
        const Way way = direction(s.vertices, s.closed, i);
        Wanted wanted{v.x, v.y, way, nullptr, s.kind};
        if (lines_.find(wanted, kNoLine)) return {};
        wanted.of = &s;
        const auto found = next.lines.find(wanted, kAcross);
        if (!found) return {};
        v.x -= found->off / 2 * way.y;
        v.y += found->off / 2 * way.x;
        double having = 0, all = own_weight_;
        for (const Neighbour& b : beside_) {
            all += b.weight;
            if (std::abs(b.frame.since) == 1 || b.lines.find(wanted, kAcross)) having += b.weight;
        }
        v.width = (v.width + found->width) / 2 * drawn_share(having / all);
        v.opacity = (v.opacity + found->opacity) / 2;
        return v;
    }

    const Strokes& here_;
    LinesAt lines_;
    double own_weight_ = 1;
    std::vector<Neighbour> beside_;
};

}  // namespace

Strokes steadied(const Strokes& here, const std::vector<FrameBeside>& beside) {
    return Steadier(here, beside).steadied();
}

}  // namespace keyline

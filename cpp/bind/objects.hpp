// The objects that kernels take: arrays that belong together. They keep their arrays alive, and are
// checked by the kernel that reads them, which knows what they have to fit.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "bindings.hpp"
#include "core/excluded_rows.hpp"
#include "core/reject.hpp"
#include "core/types.hpp"
#include "execution/visit_works.hpp"
#include "precedence/incompatible_visits.hpp"
#include "precedence/visit_closures.hpp"
#include "problem/problem.hpp"

namespace rightofway::bind {

using Ints = ArrayIn<std::int32_t>;
using Ticks = ArrayIn<Tick>;

// Of a stay or a drive, however late: the sum of two stays below `never`.
constexpr Tick longest_duration = Tick{1} << 60;

struct BoundRoads {
    Ints indptr;
    Ints heads;
    Ints length_class;
    std::int32_t n_classes;

    Roads roads() const { return {{view(indptr), view(heads)}, view(length_class)}; }
};

struct BoundRobots {
    Ints paces;
    Ints pace_of;
    Ints home;
    Ints first_stage;
    Ints stage_vertex;
    Ticks stage_work;
    Ticks stage_turn;
    std::optional<Ints> size_of;
    std::optional<Ticks> weight;
};

struct BoundTurning {
    Ticks offset;
    Ints kind;
    Ints class_of;
    Ints ticks;
    std::int32_t n_kinds;

    TurnArrays arrays() const {
        return {view(offset), view(kind), view(class_of), view(ticks), n_kinds};
    }
};

struct BoundWork {
    Ticks earliest;
    Ticks latest;
    Ticks ready;
    Ints first_turn_of;
    Ints first_turn;
    Ints before;
    Ints after;
    std::int32_t n_places;
    std::optional<Ticks> cost;
    std::optional<Ticks> late_cost;
    std::optional<Ticks> due;

    WorkArrays arrays() const {
        return {view(earliest),           view(latest),       view(ready), view(first_turn_of),
                view(first_turn),         view(before),       view(after), view_or_empty(cost),
                view_or_empty(late_cost), view_or_empty(due), n_places};
    }
};

struct BoundClosures {
    Ints row;
    Ticks start;
    Ticks end;
};

struct BoundDrawing {
    ArrayIn<double> x;
    ArrayIn<double> y;
    ArrayIn<std::uint32_t> limbs;
    bool is_grid;
};

// Shared: what visits book refers to the lists of the problem.
struct BoundExcludedRows {
    std::shared_ptr<const RowFinder> finder;

    ExcludedRows rows() const { return {finder.get()}; }
};

struct BoundRoutes {
    Ints first_visit;
    Ints vertex;
    Ticks dwell;
    Ticks drive;

    void check() const {
        require_length("dwell", dwell.size(), vertex.size());
        require_length("drive", drive.size(), vertex.size());
        require_ranges("dwell", view(dwell), -longest_duration, longest_duration);
        require_ranges("drive", view(drive), 0, longest_duration);
    }

    // The least ticks from each enter to the next one; on the last visit of all, its dwell.
    std::vector<Tick> leasts() const {
        std::vector<Tick> ticks(view(dwell).begin(), view(dwell).end());
        for (std::size_t x = 0; x + 1 < ticks.size(); ++x) {
            ticks[x] += view(drive)[x + 1];
        }
        return ticks;
    }

    // How long before its enter each visit books its vertex.
    std::vector<Tick> approaches(const BookingRules& rules) const {
        return rules.books_ahead ? std::vector<Tick>(view(drive).begin(), view(drive).end())
                                 : std::vector<Tick>(drive.size(), 0);
    }
};

struct BoundVisitRows {
    BoundExcludedRows lists;
    Ints vertex;
    Ints edge;

    static BookedRows rows(const BoundVisitRows* given) {
        return given == nullptr
                   ? BookedRows{}
                   : BookedRows{view(given->vertex), view(given->edge), given->lists.rows()};
    }
};

struct BoundVisitClosures {
    Ints first;
    Ticks start;
    Ticks end;

    static VisitClosureArrays closures(const BoundVisitClosures* given, const BoundRoutes& routes) {
        return given == nullptr ? VisitClosureArrays{}
                                : VisitClosureArrays{view(given->first), view(given->start),
                                                     view(given->end), view(routes.drive)};
    }
};

struct BoundVisitWorks {
    Ints first_work;
    Ticks ticks;
    Ticks earliest;
    Ticks planned;
    Ints first_before;
    Ints before;
    Ints ends_with_work;

    static VisitWorkArrays works(const BoundVisitWorks* given) {
        return given == nullptr ? VisitWorkArrays{}
                                : VisitWorkArrays{view(given->first_work),    view(given->ticks),
                                                  view(given->earliest),      view(given->planned),
                                                  view(given->first_before),  view(given->before),
                                                  view(given->ends_with_work)};
    }
};

}  // namespace rightofway::bind

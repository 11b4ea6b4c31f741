// The timetable: earliest times that keep routes and rights of way, updated incrementally.
//
// Times are longest paths in the precedence graph. Every visit is a node. A route is an arc from
// each visit to the next visit; "a goes before b" is an arc from the visit after a (its enter is
// a's leave) to b. Enters are the least solution of enter[q] >= enter[p] + length(p, q). Where
// robots have sizes, a and b are visits to any vertices: the drive into b starts after a's leave.
//
// A new arc raises visits (raise_search.hpp); times change only when the arc is accepted. When an
// arc is taken back, the visits held by the arc fall to the times that their other arcs allow, in
// the order of their old times: no arc leads back in time, so the tails of all arcs into a visit
// fall before the visit does.
//
// timetable.cpp holds these two changes; timetable_order.cpp an order that is known as a whole,
// timetable_closures.cpp what closures add.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/poll.hpp"
#include "core/types.hpp"
#include "precedence/raise_search.hpp"
#include "precedence/rights_of_way.hpp"
#include "precedence/routes.hpp"

namespace rightofway {

class Timetable : private RaiseSearch<Timetable, VisitId> {
  public:
    // The routes are borrowed and must outlive this object. Initially no robot waits.
    // Throws std::invalid_argument if closures leave the route of a robot no times.
    explicit Timetable(const Routes& routes);

    Tick enter(VisitId visit) const { return enter_[index(visit)]; }
    Tick leave(VisitId visit) const {
        return routes_.is_last(visit) ? never : enter_[index(visit + 1)];
    }
    std::span<const Tick> enters() const { return enter_; }
    std::vector<RightOfWay> rights_of_way() const { return rights_.list(); }

    // Gives visit a the right of way over visit b of another robot at the same vertex (unchecked).
    // Returns false and changes nothing if a is a last visit, b is a first visit, or the right of
    // way would cause a deadlock or a swap (see cycle()), or leave visits in closures. A repeated
    // right of way changes nothing.
    bool precede(VisitId a, VisitId b);

    // Orders the visits of every vertex by `when` (one number per visit; ties by visit), in one
    // sweep: each visit gets the right of way over the next visit, if of another robot. Where
    // robots have sizes, it orders all incompatible visits by the numbers of their leaves. Numbers
    // rise along routes, and no visit waits for a leave with a larger number. Returns false and
    // changes nothing if numbers break these conditions or the order is impossible. Precondition:
    // no rights of way. An exception of `interrupt`, which is polled, changes nothing either.
    bool keep_order(std::span<const Tick> when, const StopCondition& interrupt = {});

    // The cycle that the last refused right of way would close: visits in order, b first. Empty
    // if the refusal had another reason.
    std::span<const VisitId> cycle() const { return cycle_; }

    // Takes back the right of way of a over b; false if a has none.
    bool take_back(VisitId a, VisitId b);

    // Calls use(a, b) for each right of way of a robot over others, or of others over the robot.
    template <class Use>
    void for_each_right_of(RobotId robot, Use&& use) const {
        for (VisitId x = routes_.first_of(robot); x <= routes_.last_of(robot); ++x) {
            rights_.for_each_second(x, [&use, x](VisitId second) { use(x, second); });
            rights_.for_each_first(x, [&use, x](VisitId first) { use(first, x); });
        }
    }

    // The rights of way on a longest path to a visit, latest first: backwards along arcs without
    // slack, until no wait is left.
    std::vector<RightOfWay> critical_rights(VisitId visit) const;

    // The number of changes (rights of way given or taken back) that are not undone.
    std::size_t n_changes() const { return journal_.size(); }
    // Undoes changes, latest first, until `n_changes` are left.
    void rollback(std::size_t n_changes);

    // The visits with an enter changed by the last change or rollback, each once.
    std::span<const VisitId> changed() const { return raised_; }

  private:
    friend RaiseSearch<Timetable, VisitId>;

    struct OldEnter {
        VisitId visit;
        Tick enter;
    };
    struct Change {
        std::int32_t right;
        bool is_given;           // false: taken back
        std::size_t trail_mark;  // length of the trail before
    };

    bool closes_swap(VisitId a, VisitId b) const;
    bool order_all(std::span<const Tick> when, Poll& poll);
    bool give_in_order(std::span<const Tick> when, Poll& poll);
    bool give_incompatible_in_order(std::span<const Tick> when, Poll& poll);
    bool sweep(std::span<const Tick> when, Poll& poll);
    Tick& raise(VisitId visit) { return raise_[index(visit)]; }
    VisitId& cause(VisitId visit) { return cause_[index(visit)]; }
    template <class Use>
    void for_each_arc(VisitId visit, Use&& use) const {
        if (!routes_.is_last(visit)) {
            use(visit + 1, routes_.least(visit));
        }
        if (!routes_.is_first(visit)) {
            rights_.for_each_second(
                visit - 1, [&](VisitId second) { use(second, routes_.gap_before(second)); });
        }
    }
    VisitId held_by(VisitId visit, std::span<const VisitId> passed) const;
    bool clear_closures();
    bool rise_above_closures(std::vector<VisitId>& open, Poll& poll);
    void rise(VisitId visit, Tick tick, std::vector<VisitId>& open);
    Tick clear_of_closures(VisitId visit) const;
    bool recompute();
    bool recompute(Poll& poll);
    void find_changes(const std::vector<Tick>& before);
    void lower(VisitId b);
    void gather_instant();
    void lower_instant();
    void queue_lowering(VisitId visit);
    Tick held_to(VisitId visit) const;
    void accept();
    void restore_enters(std::size_t trail_length);

    const Routes& routes_;
    std::vector<Tick> enter_;
    RightsOfWay rights_;
    std::vector<Change> journal_;
    std::vector<OldEnter> trail_;  // every overwritten enter

    // Buffers of a change, reused to avoid allocation.
    std::vector<Tick> raise_;        // per visit, 0 if untouched; below 0 where a visit falls
    std::vector<VisitId> cause_;     // per raised visit: the visit that raised it
    std::vector<VisitId> to_lower_;  // a heap
    std::vector<VisitId> instant_;   // visits that fall from one instant
    std::vector<std::uint8_t> is_in_instant_;
    std::vector<OldEnter> risen_;  // visits that closures raised, with their enters before
};

}  // namespace rightofway

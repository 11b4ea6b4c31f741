// The earliest times that keep the routes and the rights of way: longest paths, kept up to date.
//
// Every visit is a node whose value is its enter. A robot's own progress is an arc from each visit
// to its next; "a goes before b" is an arc from the visit after a (its enter is a's leave) to b.
// Enter is the least solution of enter[q] >= enter[p] + length(p, q).
//
// A new arc raises visits (raise_search.hpp); times change only when the arc is accepted.
//
// When an arc is taken back, the visits that it held fall to the times that their other arcs allow,
// in the order of their old times: no arc leads back in time, so the tails of the arcs into a visit
// have fallen before it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/types.hpp"
#include "precedence/raise_search.hpp"
#include "precedence/rights_of_way.hpp"
#include "precedence/routes.hpp"
#include "problem/problem.hpp"

namespace rightofway {

class Timetable : private RaiseSearch<Timetable, VisitId> {
  public:
    // The routes are borrowed and must outlive this. At first every robot runs freely from tick 0.
    explicit Timetable(const Routes& routes);

    Tick enter(VisitId visit) const { return enter_[visit]; }
    Tick leave(VisitId visit) const { return routes_.is_last(visit) ? never : enter_[visit + 1]; }
    std::span<const Tick> enters() const { return enter_; }
    std::vector<RightOfWay> rights_of_way() const { return rights_.list(); }

    // Lets visit a go before visit b of another robot at the same vertex (not checked here).
    // False, with nothing changed, if a never leaves, b was there from the start, or the fleet
    // would be deadlocked or swap; cycle() then explains. Giving a right of way again does nothing.
    bool precede(VisitId a, VisitId b);

    // Lets all visits to a vertex take place in the order of these numbers, one for each visit,
    // equal ones by visit: each has the right of way over the next one, if that is of another
    // robot. All at once, in one sweep over the visits: along a route numbers rise, and nobody has
    // to enter before another one leaves whose number is greater. False, with nothing changed, if
    // numbers are not like that or the order is impossible. Nobody has any right of way yet.
    bool keep_order(std::span<const Tick> when);

    // The cycle that the last refused right of way would have closed: visits in order, b first.
    // Empty if it was refused for another reason.
    std::span<const VisitId> cycle() const { return cycle_; }

    // Takes back the right of way of a over b, whenever it was given; false if there is none.
    bool take_back(VisitId a, VisitId b);

    // Calls use(a, b) for each right of way that a robot has, or that others have over it.
    template <class Use>
    void for_each_right_of(RobotId robot, Use&& use) const {
        for (VisitId x = routes_.first_of(robot); x <= routes_.last_of(robot); ++x) {
            rights_.for_each_second(x, [&use, x](VisitId second) { use(x, second); });
            rights_.for_each_first(x, [&use, x](VisitId first) { use(first, x); });
        }
    }

    // The rights of way on a longest path to a visit: backwards along arcs without slack, until a
    // robot ran freely. The latest comes first.
    std::vector<RightOfWay> critical_rights(VisitId visit) const;

    // The number of changes: rights of way given or taken back, and not undone since.
    std::size_t n_changes() const { return journal_.size(); }
    // Undoes changes, the latest first, until so many are left.
    void rollback(std::size_t n_changes);

    // The visits whose enter the last change or rollback changed, each once.
    std::span<const VisitId> changed() const { return raised_; }

  private:
    friend RaiseSearch<Timetable, VisitId>;

    struct OldEnter {
        VisitId visit;
        Tick enter;
    };
    struct Change {
        std::int32_t right;
        bool is_given;           // or taken back
        std::size_t trail_mark;  // length of the trail before
    };

    bool closes_swap(VisitId a, VisitId b) const;
    bool give_in_order(std::span<const Tick> when);
    bool sweep(std::span<const Tick> when);
    Tick& raise(VisitId visit) { return raise_[visit]; }
    VisitId& cause(VisitId visit) { return cause_[visit]; }
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
    void lower(VisitId b);
    void gather_instant();
    void lower_instant();
    void let_fall(VisitId visit);
    Tick held_to(VisitId visit) const;
    void accept();
    void restore_enters(std::size_t trail_length);

    const Routes& routes_;
    std::vector<Tick> enter_;
    RightsOfWay rights_;
    std::vector<Change> journal_;
    std::vector<OldEnter> trail_;  // every enter that was ever overwritten

    // What a change works on; reused, so that no step allocates.
    std::vector<Tick> raise_;       // per visit, 0 if untouched; below 0 where a visit falls
    std::vector<VisitId> cause_;    // per raised visit: whose raise raised it
    std::vector<VisitId> falling_;  // a heap
    std::vector<VisitId> instant_;  // those that fall from one instant
    std::vector<std::uint8_t> is_in_instant_;
};

// Gives tracks the earliest times along their routes that keep the order of visits at every vertex,
// by one sweep over their visits. The tracks keep the rules; no visit becomes later.
void retime(const Problem& problem, Tracks& tracks);

}  // namespace rightofway

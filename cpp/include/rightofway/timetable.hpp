// The earliest times that keep the routes and the rights of way: longest paths, kept up to date.
//
// Every visit is a node whose value is its enter. A robot's own progress is an arc from each visit
// to its next; "a goes before b" is an arc from the visit after a (its enter is a's leave) to b.
// Enter is the least solution of enter[q] >= enter[p] + length(p, q).
//
// A new arc into b raises b by some delta. Because the old times satisfy every old arc, a raise
// only shrinks along a path, by the slack of each arc. So visits are settled by the largest raise
// first, each of them once: Dijkstra's algorithm on raises instead of distances. And the new arc
// u -> b closes a cycle of positive length, a deadlock, exactly if the raise of b reaches u. All
// this happens on the side; times change only when the arc is accepted.
//
// Reference: S. Cotton and O. Maler, Fast and flexible difference constraint propagation for
// DPLL(T), SAT 2006.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rightofway/routes.hpp"
#include "rightofway/types.hpp"

namespace rightofway {

struct RightOfWay {
    VisitId first;   // this visit leaves the vertex ...
    VisitId second;  // ... before this one enters it
};

class Timetable {
  public:
    // The routes are borrowed and must outlive this. At first every robot runs freely from tick 0.
    explicit Timetable(const Routes& routes);

    Tick enter(VisitId visit) const { return enter_[visit]; }
    Tick leave(VisitId visit) const {
        return routes_.is_last(visit) ? infinity : enter_[visit + 1];
    }
    std::span<const Tick> enters() const { return enter_; }
    std::span<const RightOfWay> rights_of_way() const { return rights_; }

    // Lets visit a go before visit b of another robot at the same vertex (the caller checks that).
    // False, with nothing changed, if a never leaves, b was there from the start, or the fleet
    // would be deadlocked or swap; cycle() then explains. Giving a right of way again does nothing.
    bool precede(VisitId a, VisitId b);

    // The cycle that the last refused right of way would have closed: visits in order, b first.
    // Empty if it was refused for another reason.
    std::span<const VisitId> cycle() const { return cycle_; }

    // Takes rights of way back, the latest first, until so many are left.
    void rollback(std::size_t n_rights);

    // Takes back all rights of way of one robot, wherever they stand, and gives everybody the
    // earliest times that keep the others. What is left can not be rolled back any more.
    void withdraw(RobotId robot);

    // The visits whose enter the last precede or rollback changed, each once.
    std::span<const VisitId> changed() const { return changed_; }

  private:
    struct Raise {
        Tick delta;
        VisitId visit;
    };
    struct OldEnter {
        VisitId visit;
        Tick enter;
    };

    bool has_right(VisitId a, VisitId b) const;
    bool closes_swap(VisitId a, VisitId b) const;
    bool spread(VisitId b, Tick delta, VisitId source);
    bool settle(VisitId source);
    void raise_successors(VisitId visit);
    void raise_along(VisitId from, VisitId to, Tick length);
    void raise_by(VisitId visit, Tick delta, VisitId cause);
    void explain(VisitId source);
    void accept(VisitId a, VisitId b);
    void record(VisitId a, VisitId b);
    void run_freely();
    void run_again(std::span<const VisitId> in_old_order);
    void forget_raises();
    void restore_enters(std::size_t trail_length);
    static bool is_later(const Raise& left, const Raise& right);

    static constexpr std::int32_t none = -1;

    const Routes& routes_;
    std::vector<Tick> enter_;

    // Rights of way in order of insertion; those of one visit are a list, latest first.
    std::vector<RightOfWay> rights_;
    std::vector<std::int32_t> next_right_;    // of the same first visit, per right of way
    std::vector<std::int32_t> latest_right_;  // per visit
    std::vector<OldEnter> trail_;             // every enter that was ever overwritten
    std::vector<std::size_t> trail_mark_;     // length of the trail before each right of way

    // What a precede works on; reused, so that no step allocates.
    std::vector<Tick> raise_;      // per visit, 0 if untouched
    std::vector<VisitId> cause_;   // per raised visit: whose raise raised it
    std::vector<Raise> open_;      // a heap
    std::vector<Raise> deferred_;  // visits entered after latest_
    Tick latest_ = infinity;
    std::vector<VisitId> changed_;
    std::vector<VisitId> cycle_;
};

}  // namespace rightofway

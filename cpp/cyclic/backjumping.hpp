// Resolves conflicts of cyclic routes by a lap rule for two robots, with conflict-directed
// backjumping where the rule causes a deadlock.
//
// P. Prosser, Hybrid algorithms for the constraint satisfaction problem, Computational
// Intelligence 9, 1993.
//
// One decision resolves one conflict, for a whole segment: the longest run of vertices that two
// robots visit in reverse or in the same order, or for robots with sizes a largest set of linked
// pairs of visits. If neither robot can wait, the decisions with
// rights of way on the closed cycles are the *culprits*. All decisions from the latest unturned
// culprit on are undone, and this culprit is turned: the other robot gets the rights of way. If the
// turned decision fails, too, its culprits are added to the set.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/types.hpp"
#include "cyclic/conflict_sweep.hpp"
#include "cyclic/cyclic_routes.hpp"
#include "cyclic/rolling_timetable.hpp"
#include "precedence/conflict.hpp"

namespace rightofway {

enum class CyclicRule : std::int32_t { first_come = 0, fixed_order = 1, least_loss = 2 };
constexpr std::int32_t n_cyclic_rules = 3;

// The rights of way on a segment, and the alternative in favour of the other robot.
struct SegmentOrder {
    std::vector<CyclicRight> rights;
    std::vector<CyclicRight> others;
};

class Backjumping {
  public:
    enum class Outcome { resolved, backjumping, window_too_short, deadlock };

    // All arguments are borrowed and must outlive this object. `loss`: cost per tick of waiting,
    // one entry per robot.
    Backjumping(const CyclicRoutes& routes, RollingTimetable& timetable, ConflictSweep& conflicts,
                CyclicRule rule, std::span<const std::int64_t> loss);

    void set_rule(CyclicRule rule) { rule_ = rule; }

    // Decides which robot goes first on the segment of a conflict. Outcomes: backjumping (earlier
    // decisions have to change), window_too_short (the end of the segment is outside the window),
    // deadlock (waiting_cycle() lists robots, each waiting for the next).
    Outcome resolve(const Conflict& conflict);
    // Undoes all decisions from the latest culprit on; turns this culprit if possible.
    Outcome backjump();
    bool is_backjumping() const { return is_backjumping_; }
    std::span<const RobotId> waiting_cycle() const { return waiting_cycle_; }
    // A visit of the last conflict, at its vertex.
    CyclicVisit conflict_visit() const { return conflict_visit_; }

    std::vector<SegmentOrder> orders() const;
    // Calls use(rights) with the rights of way of each decision, then with the alternative.
    template <class Use>
    void for_each_order(Use&& use) const {
        for (const Decision& decision : decisions_) {
            use(decision.order.rights);
            use(decision.order.others);
        }
    }

    // Drops rights of way that end before the cut; allows a new turn of the other decisions.
    void drop_past();
    // Allows a new turn of all decisions.
    void allow_all_turns();
    // Replaces all decisions; give_rights() applies them once the window has their visits.
    void restore(const std::vector<SegmentOrder>& orders);
    void give_rights();

  private:
    struct Decision {
        DecisionId id;
        RollingTimetable::Mark mark;
        bool is_older;  // than the window: rights of way are removed singly
        bool is_turned;
        std::vector<DecisionId> culprits;  // rising
        SegmentOrder order;
    };
    // A segment: linked pairs of visits of two robots. One robot goes first in all of them
    // (docs/decisions/0003-robots-with-a-size.md).
    using LinkedVisits = std::vector<IncompatiblePair>;
    // The two ways to decide a segment, and the first visit of each robot that may start later.
    struct Choice {
        CyclicVisit i_first;
        CyclicVisit j_first;
        std::vector<CyclicRight> if_i_waits;
        std::vector<CyclicRight> if_j_waits;

        const std::vector<CyclicRight>& rights_if(bool i_waits) const {
            return i_waits ? if_i_waits : if_j_waits;
        }
    };

    // No value: the segment of a conflict has to be longer, or is endless (`outcome`).
    std::optional<Choice> choice(CyclicVisit i, CyclicVisit j, Outcome& outcome);
    LinkedVisits run_through(CyclicVisit i, CyclicVisit j) const;
    LinkedVisits linked_to(CyclicVisit i, CyclicVisit j) const;
    bool i_waits(const Choice& choice) const;
    std::int64_t loss_if(const Choice& choice, bool i_waits) const;
    Tick enter_in_window(CyclicVisit visit) const;
    bool decide(SegmentOrder&& order, bool is_turned);
    void add_culprits(std::span<const DecisionId> ids, DecisionId below);
    void add_culprits_of_refusal(DecisionId below);
    Decision undo_from(DecisionId id);
    void report_changes();

    const CyclicRoutes& routes_;
    RollingTimetable& timetable_;
    ConflictSweep& conflicts_;
    CyclicRule rule_;
    std::span<const std::int64_t> loss_;
    std::vector<Decision> decisions_;
    DecisionId next_id_ = 0;
    std::vector<RobotId> waiting_cycle_;
    std::vector<DecisionId> culprits_;  // of the current conflict; rising
    bool is_backjumping_ = false;
    CyclicVisit conflict_visit_{};
};

}  // namespace rightofway

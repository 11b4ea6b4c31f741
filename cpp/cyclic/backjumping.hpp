// Resolves conflicts of cyclic routes by a rule that considers the two robots only, with
// conflict-directed backjumping where that closes a cycle.
//
// P. Prosser, Hybrid algorithms for the constraint satisfaction problem, Computational
// Intelligence 9, 1993.
//
// Each conflict is one decision, for a whole segment: the longest run of vertices that one robot
// visits in reverse order of the other, or in the same order. Where neither robot can wait, the
// decisions whose rights of way close the cycles are the *culprits*. The latest culprit that has
// not been turned is turned, which gives the rights of way to the other robot, and all later
// decisions are undone. If the turned decision fails as well, its culprits are added to the others.
#pragma once

#include <cstdint>
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

// The rights of way on a segment, and those that the other robot could have instead.
struct SegmentOrder {
    std::vector<CyclicRight> rights;
    std::vector<CyclicRight> others;
};

class Backjumping {
  public:
    enum class Outcome { resolved, backjumping, window_too_short, deadlock };

    // All are borrowed and must outlive this. `loss` is the cost of a tick of waiting for each
    // robot.
    Backjumping(const CyclicRoutes& routes, RollingTimetable& timetable, ConflictSweep& conflicts,
                CyclicRule rule, std::span<const std::int64_t> loss);

    void set_rule(CyclicRule rule) { rule_ = rule; }

    // Decides which robot goes first on the segment of a conflict. Backjumping: earlier decisions
    // have to change. Window too short: it does not show whether the segment ends. Deadlock:
    // waiting_cycle() has the robots that would each wait for the next.
    Outcome resolve(const Conflict& conflict);
    // Undoes all from the latest culprit on, and turns that one if it can be turned.
    Outcome backjump();
    bool is_backjumping() const { return is_backjumping_; }
    std::span<const RobotId> waiting_cycle() const { return waiting_cycle_; }
    // A visit of the last conflict, at its vertex.
    CyclicVisit conflict_visit() const { return conflict_visit_; }

    std::vector<SegmentOrder> orders() const;
    // Calls use(rights) for the rights of way of each decision, and for those of the other robot.
    template <class Use>
    void for_each_order(Use&& use) const {
        for (const Decision& decision : decisions_) {
            use(decision.order.rights);
            use(decision.order.others);
        }
    }

    // Drops rights of way that end before the cut; the decisions left can be turned once more.
    void drop_past();
    // Lets all decisions be turned once more.
    void allow_all_turns();
    // Replaces all decisions; give_rights() applies them, in a window that shows their visits.
    void restore(const std::vector<SegmentOrder>& orders);
    void give_rights();

  private:
    struct Decision {
        DecisionId id;
        RollingTimetable::Mark mark;
        bool is_older;  // than the window: its rights of way are removed one by one
        bool is_turned;
        std::vector<DecisionId> culprits;  // rising
        SegmentOrder order;
    };
    struct Segment {
        enum class Kind { vertex, head_on, following } kind;
        CyclicVisit i_first;
        CyclicVisit i_last;
        CyclicVisit j_first;
        CyclicVisit j_last;
    };

    Segment segment_of(CyclicVisit i, CyclicVisit j) const;
    bool i_waits(const Segment& segment) const;
    std::int64_t loss_if(const Segment& segment, bool i_waits) const;
    Tick enter_in_window(CyclicVisit visit) const;
    static std::vector<CyclicRight> rights_if(const Segment& segment, bool i_waits);
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
    std::vector<DecisionId> culprits_;  // of the conflict that is being resolved; rising
    bool is_backjumping_ = false;
    CyclicVisit conflict_visit_{};
};

}  // namespace rightofway

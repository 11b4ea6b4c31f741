// Settles what meets on endless routes, by a rule that sees the two robots only, and goes back
// where that ends in a circle.
//
// Each meeting is one decision, for a whole segment. Where neither robot can wait, the rights of
// way that close the circles are the culprits; the latest decision among them that has not been
// turned is turned, and what was decided after it is forgotten. A turned decision that fails as
// well passes its culprits on.
//
// Reference: P. Prosser, Hybrid algorithms for the constraint satisfaction problem, Computational
// Intelligence 9, 1993.
#pragma once

#include <array>
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

// A decision: these rights of way, where those others were possible.
struct BackjumpingOrder {
    std::vector<CyclicRight> rights;
    std::vector<CyclicRight> others;
};

class Backjumping {
  public:
    enum class Outcome { settled, going_back, too_short, deadlock };

    // All are borrowed and must outlive this. `loss` is what a tick of waiting costs each robot.
    Backjumping(const CyclicRoutes& routes, RollingTimetable& timetable, ConflictSweep& meetings,
                CyclicRule rule, std::span<const std::int64_t> loss);

    // Decides by another rule from now on.
    void follow(CyclicRule rule) { rule_ = rule; }

    // Keeps two robots apart. Going back: that takes other decisions than so far. Too short: the
    // view does not show whether the segment ends. In a deadlock, circle() has who would wait for
    // whom.
    Outcome settle(const Conflict& conflict);
    // Goes back to the latest decision that may help, and turns it if it can be.
    Outcome go_back();
    bool is_going_back() const { return is_going_back_; }
    std::span<const RobotId> circle() const { return circle_; }
    std::array<CyclicVisit, 2> met() const { return met_; }

    std::size_t n_orders() const { return steps_.size(); }
    const BackjumpingOrder& order(std::size_t index) const { return steps_[index].order; }

    // Drops what does not reach beyond the cut any more; what is left can be turned once more.
    void drop_past();
    // Lets all decisions be turned once more.
    void look_again();
    // Puts these decisions in place of all others; they hold when they are given, in a view that
    // shows them.
    void put(const std::vector<BackjumpingOrder>& orders);
    void give();

  private:
    using Owner = RollingTimetable::Owner;

    struct Step {
        Owner serial;
        RollingTimetable::Mark mark;
        bool is_carried;
        bool is_turned;
        std::vector<Owner> culprits;  // in order
        BackjumpingOrder order;
    };
    struct Segment {
        bool is_head_on = false;
        bool is_following = false;
        CyclicVisit i_first;
        CyclicVisit i_last;
        CyclicVisit j_first;
        CyclicVisit j_last;
    };

    Segment segment_of(CyclicVisit i, CyclicVisit j) const;
    std::int32_t run(CyclicVisit i, CyclicVisit j, std::int32_t i_step, std::int32_t j_step) const;
    bool reaches_the_end(const Segment& segment) const;
    bool i_waits(const Segment& segment) const;
    std::int64_t loss_if(const Segment& segment, bool i_waits) const;
    Tick seen_enter(CyclicVisit visit) const;
    static std::vector<CyclicRight> rights_if(const Segment& segment, bool i_waits);
    bool take(BackjumpingOrder&& order, bool is_turned);
    void blame(Owner below);
    void sort_culprits();
    Step forget_from(Owner serial);
    void carry_on();
    void run_again();
    void tell();

    const CyclicRoutes& routes_;
    RollingTimetable& timetable_;
    ConflictSweep& meetings_;
    CyclicRule rule_;
    std::span<const std::int64_t> loss_;
    std::vector<Step> steps_;
    Owner next_serial_ = 0;
    std::vector<RobotId> circle_;
    std::vector<Owner> blamed_;
    std::vector<Owner> culprits_;  // in order; of the meeting that is being settled
    bool is_going_back_ = false;
    std::vector<CyclicRight> held_;
    std::array<CyclicVisit, 2> met_{};
};

}  // namespace rightofway

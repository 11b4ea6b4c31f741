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

#include "rightofway/conflict.hpp"
#include "rightofway/endless_meetings.hpp"
#include "rightofway/endless_routes.hpp"
#include "rightofway/endless_timetable.hpp"
#include "rightofway/types.hpp"

namespace rightofway {

enum class EndlessRule : std::int32_t { first_come = 0, fixed_order = 1, least_loss = 2 };
constexpr std::int32_t n_endless_rules = 3;

// A decision: these rights of way, where those others were possible.
struct EndlessOrder {
    std::vector<EndlessRight> rights;
    std::vector<EndlessRight> others;
};

class EndlessGiving {
  public:
    enum class Outcome { settled, going_back, too_short, deadlock };

    // All are borrowed and must outlive this. `loss` is what a tick of waiting costs each robot.
    EndlessGiving(const EndlessRoutes& routes, EndlessTimetable& timetable,
                  EndlessMeetings& meetings, EndlessRule rule, std::span<const std::int64_t> loss);

    // Decides by another rule from now on.
    void follow(EndlessRule rule) { rule_ = rule; }

    // Keeps two robots apart. Going back: that takes other decisions than so far. Too short: the
    // view does not show whether the segment ends. In a deadlock, circle() has who would wait for
    // whom.
    Outcome settle(const Conflict& conflict);
    // Goes back to the latest decision that may help, and turns it if it can be.
    Outcome go_back();
    bool is_going_back() const { return is_going_back_; }
    std::span<const RobotId> circle() const { return circle_; }
    std::array<EndlessVisit, 2> met() const { return met_; }

    std::size_t n_orders() const { return steps_.size(); }
    const EndlessOrder& order(std::size_t index) const { return steps_[index].order; }

    // Drops what does not reach beyond the cut any more; what is left can be turned once more.
    void drop_past();
    // Lets all decisions be turned once more.
    void look_again();
    // Puts these decisions in place of all others; they hold when they are given, in a view that
    // shows them.
    void put(const std::vector<EndlessOrder>& orders);
    void give();

  private:
    using Owner = EndlessTimetable::Owner;

    struct Step {
        Owner serial;
        EndlessTimetable::Mark mark;
        bool is_carried;
        bool is_turned;
        std::vector<Owner> culprits;  // in order
        EndlessOrder order;
    };
    struct Segment {
        bool is_head_on = false;
        bool is_following = false;
        EndlessVisit i_first;
        EndlessVisit i_last;
        EndlessVisit j_first;
        EndlessVisit j_last;
    };

    Segment segment_of(EndlessVisit i, EndlessVisit j) const;
    std::int32_t run(EndlessVisit i, EndlessVisit j, std::int32_t i_step,
                     std::int32_t j_step) const;
    bool reaches_the_end(const Segment& segment) const;
    bool i_waits(const Segment& segment) const;
    std::int64_t loss_if(const Segment& segment, bool i_waits) const;
    Tick seen_enter(EndlessVisit visit) const;
    static std::vector<EndlessRight> rights_if(const Segment& segment, bool i_waits);
    bool take(EndlessOrder&& order, bool is_turned);
    void blame(Owner below);
    void sort_culprits();
    Step forget_from(Owner serial);
    void carry_on();
    void run_again();
    void tell();

    const EndlessRoutes& routes_;
    EndlessTimetable& timetable_;
    EndlessMeetings& meetings_;
    EndlessRule rule_;
    std::span<const std::int64_t> loss_;
    std::vector<Step> steps_;
    Owner next_serial_ = 0;
    std::vector<RobotId> circle_;
    std::vector<Owner> blamed_;
    std::vector<Owner> culprits_;  // in order; of the meeting that is being settled
    bool is_going_back_ = false;
    std::vector<EndlessRight> held_;
    std::array<EndlessVisit, 2> met_{};
};

}  // namespace rightofway

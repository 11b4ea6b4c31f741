#include "lacam/pibt.hpp"

#include <algorithm>

#include "lacam/swaps.hpp"

namespace rightofway {

// The fleet during a choice, as `Swaps` reads it.
struct Pibt::Choosing {
    Pibt& pibt;
    const FleetState& now;

    const Graph& graph() const { return pibt.problem_.graph(); }
    VertexId at(RobotId robot) const { return now.at(robot); }
    RobotId here(VertexId vertex) const { return now.here(vertex); }
    RobotId keeps_off(RobotId robot, VertexId vertex) const {
        RobotId found = now.here(vertex);
        if (found == nobody) {
            pibt.moves_.any_ahead(now, robot, vertex, [&](RobotId other) {
                found = other;
                return true;
            });
        }
        return found;
    }
    VertexId target(RobotId robot) const { return now.target(robot); }
    std::int32_t way(RobotId robot, VertexId vertex) const {
        return pibt.candidates_.way(now, robot, vertex);
    }
    bool is_free(RobotId robot) const { return !now.is_busy(robot); }
    bool is_idle(RobotId robot) const { return pibt.is_idle(now, robot); }
};

Pibt::Pibt(const Problem& problem, StepTables& tables, const SpaceUtilization& paths,
           std::uint64_t seed)
    : problem_(problem),
      moves_(problem),
      candidates_(problem, tables, paths, moves_, seed),
      arrivals_(problem, moves_) {}

void Pibt::fix(RobotId robot, VertexId vertex) { fixed_.push_back({robot, vertex}); }

bool Pibt::choose(const FleetState& now, std::span<const RobotId> order) {
    decisions_.clear();
    n_choices_ += static_cast<std::int64_t>(fixed_.size());
    const bool is_chosen =
        take_fixed(now) && choose_all(now, order) && arrivals_.settle(now, decisions_);
    moves_.clear(now);
    fixed_.clear();
    return is_chosen;
}

bool Pibt::take_fixed(const FleetState& now) {
    return std::all_of(fixed_.begin(), fixed_.end(), [&](const Fixed& fixed) {
        if (!moves_.is_open(now, fixed.robot, fixed.vertex)) {
            return false;
        }
        moves_.take(now, fixed.robot, fixed.vertex);
        return true;
    });
}

bool Pibt::choose_all(const FleetState& now, std::span<const RobotId> order) {
    const auto choose_next = [&](RobotId r) { return moves_.has_chosen(r) || choose_one(now, r); };
    return std::all_of(order.begin(), order.end(), choose_next) &&
           std::all_of(fixed_.begin(), fixed_.end(), [&](const Fixed& fixed) {
               // Maybe a robot that has arrived.
               return !moves_.any_ahead(now, fixed.robot, fixed.vertex, [&](RobotId other) {
                   return !now.is_busy(other) && !choose_next(other);
               });
           });
}

// PIBT(i). A robot that is pushed chooses before the robot that pushes it. The chain of pushes is
// as long as the queue in a corridor, so it is a stack of frames and not of calls.
bool Pibt::choose_one(const FleetState& now, RobotId robot) {
    Choice latest = begin(now, robot);
    while (!frames_.empty()) {
        latest = try_candidates(now, latest);
    }
    return latest == Choice::valid;
}

// Lines 1 to 4: the candidates of a robot, in a new frame (`open`). A robot that has to wait needs
// none.
Pibt::Choice Pibt::begin(const FleetState& now, RobotId robot) {
    ++n_choices_;
    const VertexId here = now.at(robot);
    if (has_to_wait(now, robot)) {
        candidates_.skip(here);
        const bool may_stay = moves_.is_open(now, robot, here);
        moves_.take(now, robot, here);
        return may_stay ? Choice::valid : Choice::invalid;
    }
    const std::size_t first = places_.size();
    candidates_.push(now, robot, places_);  // 1, 2
    const Choosing fleet{*this, now};
    const RobotId partner = Swaps(fleet).partner(robot, places_[first].vertex);  // 3
    if (partner != nobody) {
        std::reverse(places_.begin() + static_cast<std::ptrdiff_t>(first), places_.end());  // 4
    }
    frames_.push_back({robot, partner, first, places_.size(), first});
    return Choice::open;
}

// Lines 5 to 9 of the robot on top of the stack, until it has chosen, or has to push another robot
// (`open`): PIBT(k) runs, and this function goes on with what k has chosen, `pushed`.
Pibt::Choice Pibt::try_candidates(const FleetState& now, Choice pushed) {
    Frame& frame = frames_.back();
    const auto stays = [&](RobotId k) { return moves_.next(k) == now.at(k); };
    while (frame.ahead.place != ChosenMoves::nowhere || take_candidate(now, frame)) {  // 5 to 7
        bool is_held =
            pushed == Choice::invalid || (pushed == Choice::valid && stays(frame.pushed));  // 9
        while (!is_held) {
            const RobotId k = moves_.next_ahead(now, frame.robot, frame.ahead);  // 8
            if (k == nobody) {
                return end(now, Choice::valid);
            }
            if (is_idle(now, k)) {
                frame.pushed = k;
                pushed = begin(now, k);  // 9
                if (pushed == Choice::open) {
                    return Choice::open;
                }
                is_held = pushed == Choice::invalid;
            }
            is_held = is_held || stays(k);
        }
        pushed = Choice::open;
        frame.ahead = {};
        ++frame.k;
    }
    return end(now, Choice::invalid);
}

// Lines 5 to 7: takes the next candidate that is open and closes no forbidden rotation; false if
// none is left.
bool Pibt::take_candidate(const FleetState& now, Frame& frame) {
    for (; frame.k < frame.end; ++frame.k) {
        const VertexId place = places_[frame.k].vertex;
        if (!moves_.is_open(now, frame.robot, place)) {
            continue;  // 6
        }
        moves_.take(now, frame.robot, place);  // 7
        if (!problem_.may_rotate() && place != now.at(frame.robot) &&
            moves_.closes_rotation(now, frame.robot)) {
            moves_.release(now, frame.robot);
            continue;
        }
        frame.ahead = {place};
        return true;
    }
    return false;
}

// Lines 10 to 13, and the return to the robot below on the stack.
Pibt::Choice Pibt::end(const FleetState& now, Choice choice) {
    const Frame frame = frames_.back();
    if (choice == Choice::valid && frame.partner != nobody && frame.k == frame.first) {
        pull(now, frame);  // 10
    }
    places_.resize(frame.first);
    frames_.pop_back();
    if (choice == Choice::invalid) {
        moves_.take(now, frame.robot, now.at(frame.robot));  // 12
    }
    return choice;  // 11, 13
}

// Line 10: lets the partner follow a robot that leaves, if no other robot is in its way.
void Pibt::pull(const FleetState& now, const Frame& frame) {
    const RobotId partner = frame.partner;
    const VertexId place = now.at(frame.robot);
    const auto stays = [&](RobotId other) { return !moves_.moves(now, other); };
    if (!moves_.moves(now, frame.robot) || !is_idle(now, partner) ||
        moves_.claim(place) != nobody || moves_.edge_to(now, partner, place) < 0 ||
        !problem_.may_drive(partner, now.at(partner), place) ||
        !moves_.is_open(now, partner, place) || moves_.any_ahead(now, partner, place, stays)) {
        return;
    }
    moves_.take(now, partner, place);
    if (moves_.closes_rotation(now, partner)) {
        moves_.withdraw_latest(now);
    }
}

// Whether the robot stays; a shortcut without a ranking of candidates, for most waiting robots.
// True if staying is forbidden and no neighbour is open, or if staying is allowed, no neighbour
// that may rank before it is open, and there is no swap. A swap is excluded if moving robots have
// booked all those neighbours, because moving robots go first.
bool Pibt::has_to_wait(const FleetState& now, RobotId robot) {
    const Candidates::Outlook& ahead = candidates_.outlook(now, robot);
    const auto heads = problem_.graph().heads(ahead.here);
    const std::int32_t* steps = candidates_.steps_beside(robot);
    bool are_booked = true;
    for (std::size_t k = 0; k < heads.size(); ++k) {
        if (steps[k] <= ahead.steps) {
            if (moves_.is_open(now, robot, heads[k])) {
                return false;
            }
            are_booked = are_booked && moves_.is_booked(now, robot, heads[k]);
        }
    }
    if (moves_.is_open(now, robot, ahead.here)) {
        const Choosing fleet{*this, now};
        return are_booked ||
               Swaps(fleet).partner(robot, candidates_.best(now, robot).vertex) == nobody;
    }
    return std::none_of(heads.begin(), heads.end(),
                        [&](VertexId head) { return moves_.is_open(now, robot, head); });
}

}  // namespace rightofway

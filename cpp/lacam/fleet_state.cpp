#include "lacam/fleet_state.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "core/random.hpp"

namespace rightofway {
namespace {

// `base` and its inverse `back` modulo 2^64 (both odd): powers of `base` shift keys ahead by ticks,
// powers of `back` shift keys back. So the sum over busy robots stays valid as the clock advances.
constexpr std::uint64_t base = 0x9e3779b97f4a7c15U;

constexpr std::uint64_t inverse_of(std::uint64_t odd) {
    std::uint64_t inverse = odd;  // the last 3 bits are right; each round doubles their number
    for (int round = 0; round < 5; ++round) {
        inverse *= 2 - odd * inverse;
    }
    return inverse;
}

constexpr std::uint64_t back = inverse_of(base);
static_assert(base * back == 1);

constexpr std::uint64_t power(std::uint64_t factor, Tick exponent) {
    std::uint64_t result = 1;
    for (auto left = static_cast<std::uint64_t>(exponent); left != 0; left >>= 1) {
        if ((left & 1) != 0) {
            result *= factor;
        }
        factor *= factor;
    }
    return result;
}

std::uint64_t mix(std::uint64_t x) { return Random(x).next(); }

}  // namespace

FleetState::FleetState(const Problem& problem)
    : problem_(&problem),
      robots_(static_cast<std::size_t>(problem.n_robots())),
      resources_(static_cast<std::size_t>(problem.edges_exclude() ? problem.n_resources()
                                                                  : problem.n_vertices()),
                 {nobody, nobody, -problem.rules().headway}) {
    for (RobotId r = 0; r < problem.n_robots(); ++r) {
        has_turns_ = has_turns_ || problem.turns(r).take_time();
        robots_[index(r)] = {problem.home(r), problem.home(r), problem.first_stage(r), busy, 0, 0};
        resources_[index(problem.home(r))].here = r;
        begin_stage(r);
    }
}

std::uint64_t FleetState::key(RobotId robot) const {
    const Robot& r = robots_[index(robot)];
    const auto pack = [](std::int32_t high, std::int32_t low) {
        return static_cast<std::uint64_t>(high) << 32 | static_cast<std::uint32_t>(low);
    };
    const std::uint64_t heading = has_turns_ ? mix(static_cast<std::uint64_t>(r.edge + 1)) : 0;
    return mix(pack(robot, r.stage) ^ mix(pack(r.at, r.to)) ^ heading);
}

void FleetState::set_busy(RobotId robot, Tick until) {
    Robot& r = robots_[index(robot)];
    r.place = busy;
    r.ready = until;
    r.key = key(robot);
    sum_busy_ += r.key * base_to_now_ * power(base, until - now_);
    if (until == latest_event_.tick) {
        Robot& first = robots_[index(latest_event_.first)];
        r.finishes_with = std::exchange(first.finishes_with, robot);
        return;
    }
    r.finishes_with = nobody;
    latest_event_ = {until, robot};
    events_.push_back(latest_event_);
    std::push_heap(events_.begin(), events_.end(), std::greater<>());
}

void FleetState::set_free(RobotId robot) {
    Robot& r = robots_[index(robot)];
    if (problem_->is_last(robot, r.stage) && r.at == target(robot)) {
        r.place = arrived;
        ++n_arrived_;
    } else {
        r.place = static_cast<std::int32_t>(undecided_.size());
        undecided_.push_back(robot);
    }
    r.key = key(robot);
    sum_free_ += r.key;
}

void FleetState::take_off_list(RobotId robot) {
    const std::int32_t place = robots_[index(robot)].place;
    if (place == arrived) {
        --n_arrived_;
    } else {
        robots_[index(undecided_.back())].place = place;
        undecided_[index(place)] = undecided_.back();
        undecided_.pop_back();
    }
}

// The edge of a robot on the move.
FleetState::Resource& FleetState::edge_of(const Robot& robot) {
    return resources_[index(problem_->n_vertices() + problem_->graph().edge(robot.at, robot.to))];
}

// Begins the work of the stage if its vertex is here; skips stages of 0 ticks. The last stage has
// no work here, because no move follows.
void FleetState::begin_stage(RobotId robot) {
    Robot& r = robots_[index(robot)];
    while (!problem_->is_last(robot, r.stage) && r.at == target(robot)) {
        const Tick dwell = problem_->stage_dwell(r.stage);
        if (dwell > 0) {
            set_busy(robot, now_ + dwell);
            return;
        }
        ++r.stage;
        r.since = now_;
    }
    set_free(robot);
}

void FleetState::resume(std::span<const Standing> robots) {
    for (const Robot& robot : robots_) {
        resources_[index(robot.at)].here = nobody;
    }
    undecided_.clear();
    n_arrived_ = 0;
    sum_free_ = 0;
    for (RobotId r = 0; r < problem_->n_robots(); ++r) {
        const auto [at, stage, waited] = robots[index(r)];
        robots_[index(r)] = {at, at, stage, busy, now_, now_ - waited};
        resources_[index(at)].here = r;
        set_free(r);
    }
}

void FleetState::decide(const Decision& decision) {
    const RobotId robot = decision.robot;
    Robot& r = robots_[index(robot)];
    sum_free_ -= r.key;
    if (r.place == arrived) {
        r.since = now_;
    }
    take_off_list(robot);
    r.to = decision.vertex;
    resources_[index(decision.vertex)].comes = robot;
    if (problem_->edges_exclude()) {
        edge_of(r).here = robot;
    }
    set_busy(robot, decision.arrival);
}

bool FleetState::advance() {
    if (events_.empty()) {
        return false;
    }
    const Tick ticks = events_.front().tick - now_;
    now_ += ticks;
    base_to_now_ *= power(base, ticks);
    back_to_now_ *= power(back, ticks);
    finished_.clear();
    while (!events_.empty() && events_.front().tick == now_) {
        std::pop_heap(events_.begin(), events_.end(), std::greater<>());
        for (RobotId robot = events_.back().first; robot != nobody;
             robot = robots_[index(robot)].finishes_with) {
            finished_.push_back(robot);
        }
        events_.pop_back();
    }
    for (const RobotId robot : finished_) {  // all leave before the first enter
        const Robot& r = robots_[index(robot)];
        sum_busy_ -= r.key * base_to_now_;
        if (r.at != r.to) {
            resources_[index(r.at)].here = nobody;
            resources_[index(r.at)].left = now_;
            if (problem_->edges_exclude()) {
                edge_of(r) = {nobody, nobody, now_};
            }
        }
    }
    for (const RobotId robot : finished_) {
        Robot& r = robots_[index(robot)];
        if (r.at != r.to) {
            r.edge = has_turns_ ? problem_->graph().edge(r.at, r.to) : -1;
            r.at = r.to;
            resources_[index(r.at)].here = robot;
            resources_[index(r.at)].comes = nobody;
        } else {  // the work is complete
            ++r.stage;
            r.since = now_;
        }
        begin_stage(robot);
    }
    return true;
}

std::uint64_t FleetState::fingerprint() const {
    return mix(mix(sum_busy_ * back_to_now_) ^ sum_free_);
}

}  // namespace rightofway

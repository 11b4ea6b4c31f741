#include "execution/execution_timetable.hpp"

#include <algorithm>

namespace rightofway {
namespace {

// None is negative, and each at most `never` and a little more.
Tick sum(Tick left, Tick right) { return right >= never - left ? never : left + right; }

// One robot's standstills, of which those up to now are behind it.
class Standstills {
  public:
    Standstills(const DelaySample& setbacks, RobotId robot, std::int32_t& next,
                std::uint8_t& is_broken)
        : all_(setbacks.standstills.data()),
          end_(setbacks.first_standstill[robot + 1]),
          next_(next),
          is_broken_(is_broken) {}

    // When something is done that would be done by then: each standstill before it comes on top.
    Tick busy_until(Tick end) {
        for (; next_ < end_ && all_[next_].tick < end; ++next_) {
            end = sum(end, take());
        }
        return end;
    }

    // Until when a robot waits that waits at least until then: it may stand still meanwhile.
    Tick waits_until(Tick end) {
        for (; next_ < end_ && all_[next_].tick < end; ++next_) {
            end = std::max(end, sum(all_[next_].tick, take()));
        }
        return end;
    }

  private:
    Tick take() {
        is_broken_ |= static_cast<std::uint8_t>(all_[next_].ticks == never);
        return all_[next_].ticks;
    }

    const Stoppage* all_;
    std::int32_t end_;
    std::int32_t& next_;
    std::uint8_t& is_broken_;
};

void reset(const ActionDependencyGraph& plan, const DelaySample& setbacks, ActualTimes& times,
           std::vector<std::int32_t>& next_standstill) {
    const auto n_visits = static_cast<std::size_t>(plan.n_visits());
    const auto n_robots = static_cast<std::size_t>(plan.n_robots());
    times.enter.assign(n_visits, never);
    times.start.assign(n_visits, never);
    times.completion.assign(n_robots, never);
    times.is_broken.assign(n_robots, 0);
    next_standstill.assign(setbacks.first_standstill.begin(), setbacks.first_standstill.end() - 1);
    for (RobotId r = 0; r < plan.n_robots(); ++r) {
        times.enter[plan.first_of(r)] = times.start[plan.first_of(r)] = 0;
    }
}

void complete(const ActionDependencyGraph& plan, const DelaySample& setbacks, ActualTimes& times,
              std::vector<std::int32_t>& next_standstill) {
    for (RobotId r = 0; r < plan.n_robots(); ++r) {
        const VisitId last = plan.last_of(r);
        Standstills standstills(setbacks, r, next_standstill[r], times.is_broken[r]);
        if (times.enter[last] < never) {
            times.completion[r] =
                standstills.busy_until(sum(times.enter[last], setbacks.dwell[last]));
        }
    }
}

}  // namespace

ExecutionTimetable::ExecutionTimetable(const ActionDependencyGraph& plan)
    : plan_(plan), is_impossible_(static_cast<std::size_t>(plan.n_visits()), 0) {
    order_events();
    for (RobotId r = 0; r < plan_.n_robots(); ++r) {
        if (!can_take_place(plan_.last_of(r))) {
            deadlocked_.push_back(r);
        }
    }
}

// Strongly connected components come out after all that they wait for.
// Tarjan, "Depth-first search and linear graph algorithms", SIAM Journal on Computing 1, 1972.
void ExecutionTimetable::order_events() {
    struct Open {
        VisitId visit;
        int next;  // of what it waits for: 0 its own robot's visit before, 1 another's leave
    };
    const auto n_visits = static_cast<std::size_t>(plan_.n_visits());
    std::vector<std::int32_t> number(n_visits, -1);
    std::vector<std::int32_t> low(n_visits, 0);
    std::vector<std::uint8_t> is_open(n_visits, 0);
    std::vector<VisitId> component;
    std::vector<Open> path;
    std::int32_t count = 0;
    const auto waits_for = [this](VisitId x, int which) {
        if (which == 0) {
            return plan_.is_first(x) ? no_visit : x - 1;
        }
        const VisitId other = plan_.before(x);
        return other == no_visit || plan_.is_last(other) ? no_visit : other + 1;
    };
    const auto begin = [&](VisitId x) {
        number[x] = low[x] = count++;
        is_open[x] = 1;
        component.push_back(x);
        path.push_back({x, 0});
    };
    for (VisitId root = 0; root < plan_.n_visits(); ++root) {
        if (number[root] < 0) {
            begin(root);
        }
        while (!path.empty()) {
            const VisitId x = path.back().visit;
            if (path.back().next < 2) {
                const VisitId other = waits_for(x, path.back().next++);
                if (other != no_visit && number[other] < 0) {
                    begin(other);
                } else if (other != no_visit && is_open[other] != 0) {
                    low[x] = std::min(low[x], number[other]);
                }
                continue;
            }
            path.pop_back();
            if (!path.empty()) {
                low[path.back().visit] = std::min(low[path.back().visit], low[x]);
            }
            if (low[x] == number[x]) {
                const auto from = std::find(component.rbegin(), component.rend(), x).base() - 1;
                std::for_each(from, component.end(), [&](VisitId y) { is_open[y] = 0; });
                emit({from, component.end()});
                component.erase(from, component.end());
            }
        }
    }
}

void ExecutionTimetable::emit(std::span<const VisitId> group) {
    if (!is_possible(group)) {
        std::for_each(group.begin(), group.end(), [this](VisitId x) { is_impossible_[x] = 1; });
    } else if (!plan_.is_first(group.front())) {
        events_.insert(events_.end(), group.begin(), group.end());
        first_of_group_.push_back(static_cast<std::int32_t>(events_.size()));
    }
}

// Can visits take place that wait for each other, after all that they wait for besides? Several
// only where each may begin at the very instant at which the one before it ends.
bool ExecutionTimetable::is_possible(std::span<const VisitId> group) const {
    const bool is_joint = group.size() > 1;
    const auto is_inside = [&](VisitId x) {
        return std::find(group.begin(), group.end(), x) != group.end();
    };
    return std::all_of(group.begin(), group.end(), [&](VisitId x) {
        if (plan_.is_first(x)) {
            return true;
        }
        const VisitId other = plan_.before(x);
        const bool waits_for_a_last = other != no_visit && plan_.is_last(other);
        const bool waits_for_itself = other != no_visit && other + 1 == x;
        const bool waits_in_vain =
            !can_take_place(x - 1) ||
            (other != no_visit && !waits_for_a_last && !can_take_place(other + 1));
        const bool has_length =
            is_joint && (plan_.headway() > 0 || plan_.books_ahead() || is_inside(x - 1));
        return !waits_for_a_last && !waits_for_itself && !waits_in_vain && !has_length;
    });
}

void ExecutionTimetable::by_right_of_way(const DelaySample& setbacks, ActualTimes& times) {
    reset(plan_, setbacks, times, next_standstill_);
    times.cause.assign(times.enter.size(), no_visit);
    times.to_blame.assign(times.enter.size(), no_visit);
    for (std::size_t group = 0; group + 1 < first_of_group_.size(); ++group) {
        const std::int32_t first = first_of_group_[group];
        const std::int32_t end = first_of_group_[group + 1];
        if (end - first == 1) {
            take_place(events_[first], setbacks, times);
        } else {
            take_place_jointly({events_.begin() + first, events_.begin() + end}, setbacks, times);
        }
    }
    complete(plan_, setbacks, times, next_standstill_);
}

void ExecutionTimetable::take_place(VisitId x, const DelaySample& setbacks, ActualTimes& times) {
    const Tick from = times.enter[x - 1];
    if (from >= never) {
        return;
    }
    const RobotId robot = plan_.robot(x);
    Standstills standstills(setbacks, robot, next_standstill_[robot], times.is_broken[robot]);
    const Tick drive_before = plan_.books_ahead() ? 0 : setbacks.drive[x];
    const Tick drive_after = setbacks.drive[x] - drive_before;
    const Tick ready = standstills.busy_until(sum(from, setbacks.dwell[x - 1] + drive_before));
    const VisitId other = plan_.before(x);
    const Tick free = other == no_visit ? 0 : sum(times.enter[other + 1], plan_.headway());
    const Tick start = standstills.waits_until(std::max({ready, free, plan_.since(x)}));
    times.start[x] = start;
    times.enter[x] = drive_after == 0 ? start : standstills.busy_until(sum(start, drive_after));
    times.cause[x] = free > ready && start == free ? other + 1 : x - 1;
    times.to_blame[x] = x - 1;
}

// All begin when the last of them is ready.
void ExecutionTimetable::take_place_jointly(std::span<const VisitId> group,
                                            const DelaySample& setbacks, ActualTimes& times) {
    Tick instant = 0;
    VisitId latest = group.front();
    const auto put_off = [&](VisitId x, Tick until) {
        if (until > instant) {
            instant = until;
            latest = x;
        }
    };
    const auto standstills_of = [&](VisitId x) {
        const RobotId robot = plan_.robot(x);
        return Standstills(setbacks, robot, next_standstill_[robot], times.is_broken[robot]);
    };
    for (const VisitId x : group) {
        const Tick from = times.enter[x - 1];
        const Tick done = sum(from, setbacks.dwell[x - 1] + setbacks.drive[x]);
        put_off(x, from >= never ? never : standstills_of(x).busy_until(done));
        put_off(x, plan_.since(x));
    }
    for (Tick before = -1; before < instant;) {
        before = instant;
        for (const VisitId x : group) {
            put_off(x,
                    times.enter[x - 1] >= never ? never : standstills_of(x).waits_until(instant));
        }
    }
    for (const VisitId x : group) {
        times.enter[x] = times.start[x] = instant;
        times.cause[x] = times.to_blame[x] = latest - 1;
    }
}

void by_clock(const ActionDependencyGraph& plan, const DelaySample& setbacks, ActualTimes& times) {
    std::vector<std::int32_t> next;
    reset(plan, setbacks, times, next);
    for (RobotId r = 0; r < plan.n_robots(); ++r) {
        Standstills standstills(setbacks, r, next[r], times.is_broken[r]);
        for (VisitId x = plan.first_of(r) + 1; x <= plan.last_of(r); ++x) {
            const Tick from = times.enter[x - 1];
            if (from >= never) {
                break;
            }
            const Tick done = standstills.busy_until(sum(from, setbacks.dwell[x - 1]));
            const Tick depart =
                standstills.waits_until(std::max(done, plan.planned(x) - plan.drive(x)));
            const Tick arrive = standstills.busy_until(sum(depart, setbacks.drive[x]));
            times.enter[x] = standstills.waits_until(std::max(arrive, plan.planned(x)));
            times.start[x] = plan.books_ahead() ? depart : times.enter[x];
        }
    }
    complete(plan, setbacks, times, next);
}

}  // namespace rightofway

#include "execution/execution_timetable.hpp"

#include <algorithm>

#include "core/poll.hpp"

namespace rightofway {
namespace {

// The sum of two durations >= 0, at most `never`.
Tick sum(Tick left, Tick right) { return right >= never - left ? never : left + right; }

// The remaining stoppages of one robot.
class Stoppages {
  public:
    Stoppages(const DelaySample& sample, RobotId robot, std::int32_t& next, std::uint8_t& is_broken)
        : all_(sample.stoppages.data()),
          end_(sample.first_stoppage[index(robot + 1)]),
          next_(next),
          is_broken_(is_broken) {}

    // The end of an action that would end at `end` without stoppages: adds each earlier stoppage.
    Tick busy_until(Tick end) {
        for (; next_ < end_ && all_[next_].tick < end; ++next_) {
            end = sum(end, take());
        }
        return end;
    }

    // The end of a wait that lasts at least until `end`: stoppages run during the wait.
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

void reset(const ActionDependencyGraph& plan, const DelaySample& sample, ActualTimes& times,
           std::vector<std::int32_t>& next_stoppage) {
    const auto n_visits = static_cast<std::size_t>(plan.n_visits());
    const auto n_robots = static_cast<std::size_t>(plan.n_robots());
    times.enter.assign(n_visits, never);
    times.start.assign(n_visits, never);
    times.completion.assign(n_robots, never);
    times.is_broken.assign(n_robots, 0);
    times.is_caught.assign(n_robots, 0);
    next_stoppage.assign(sample.first_stoppage.begin(), sample.first_stoppage.end() - 1);
    for (RobotId r = 0; r < plan.n_robots(); ++r) {
        times.enter[index(plan.first_of(r))] = times.start[index(plan.first_of(r))] = 0;
    }
}

void complete(const ActionDependencyGraph& plan, const DelaySample& sample, ActualTimes& times,
              std::vector<std::int32_t>& next_stoppage) {
    for (RobotId r = 0; r < plan.n_robots(); ++r) {
        const VisitId last = plan.last_of(r);
        Stoppages stoppages(sample, r, next_stoppage[index(r)], times.is_broken[index(r)]);
        if (times.enter[index(last)] < never) {
            times.completion[index(r)] =
                stoppages.busy_until(sum(times.enter[index(last)], sample.dwell[index(last)]));
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

// Emits strongly connected components in order: each after the components that it waits for.
// R. Tarjan, "Depth-first search and linear graph algorithms", SIAM Journal on Computing 1, 1972.
void ExecutionTimetable::order_events() {
    struct Open {
        VisitId visit;
        int next;  // wait to follow: 0: own robot, from 1 on: other robots
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
            return plan_.is_first(x) ? none : x - 1;
        }
        const VisitId other = plan_.before(x)[static_cast<std::size_t>(which) - 1];
        return plan_.is_last(other) ? none : other + 1;
    };
    const auto begin = [&](VisitId x) {
        number[index(x)] = low[index(x)] = count++;
        is_open[index(x)] = 1;
        component.push_back(x);
        path.push_back({x, 0});
    };
    for (VisitId root = 0; root < plan_.n_visits(); ++root) {
        if (number[index(root)] < 0) {
            begin(root);
        }
        while (!path.empty()) {
            const VisitId x = path.back().visit;
            if (path.back().next <= static_cast<int>(plan_.before(x).size())) {
                const VisitId other = waits_for(x, path.back().next++);
                if (other != none && number[index(other)] < 0) {
                    begin(other);
                } else if (other != none && is_open[index(other)] != 0) {
                    low[index(x)] = std::min(low[index(x)], number[index(other)]);
                }
                continue;
            }
            path.pop_back();
            if (!path.empty()) {
                low[index(path.back().visit)] =
                    std::min(low[index(path.back().visit)], low[index(x)]);
            }
            if (low[index(x)] == number[index(x)]) {
                const auto from = std::find(component.rbegin(), component.rend(), x).base() - 1;
                std::for_each(from, component.end(), [&](VisitId y) { is_open[index(y)] = 0; });
                emit({from, component.end()});
                component.erase(from, component.end());
            }
        }
    }
}

void ExecutionTimetable::emit(std::span<const VisitId> group) {
    if (!is_possible(group)) {
        std::for_each(group.begin(), group.end(),
                      [this](VisitId x) { is_impossible_[index(x)] = 1; });
    } else if (!plan_.is_first(group.front())) {
        events_.insert(events_.end(), group.begin(), group.end());
        first_of_group_.push_back(static_cast<std::int32_t>(events_.size()));
    }
}

// True if a component can take place once all other visits that it waits for have taken place.
// Several visits can take place jointly only if each can begin as the previous visit ends.
bool ExecutionTimetable::is_possible(std::span<const VisitId> group) const {
    const bool is_joint = group.size() > 1;
    const auto is_inside = [&](VisitId x) {
        return std::find(group.begin(), group.end(), x) != group.end();
    };
    return std::all_of(group.begin(), group.end(), [&](VisitId x) {
        if (plan_.is_first(x)) {
            return true;
        }
        const bool has_length =
            is_joint && (plan_.headway() > 0 || plan_.books_ahead() || is_inside(x - 1));
        if (has_length || !can_take_place(x - 1)) {
            return false;
        }
        const auto before = plan_.before(x);
        return std::all_of(before.begin(), before.end(), [&](VisitId other) {
            return !plan_.is_last(other) && other + 1 != x && can_take_place(other + 1);
        });
    });
}

void ExecutionTimetable::by_right_of_way(const DelaySample& sample, ActualTimes& times,
                                         const StopCondition& interrupt) {
    Poll poll(interrupt);
    reset(plan_, sample, times, next_stoppage_);
    times.cause.assign(times.enter.size(), none);
    times.source.assign(times.enter.size(), none);
    for (std::size_t group = 0; group + 1 < first_of_group_.size(); ++group) {
        const std::int32_t first = first_of_group_[group];
        const std::int32_t end = first_of_group_[group + 1];
        poll();
        if (end - first == 1) {
            start_visit(events_[index(first)], sample, times);
        } else {
            start_jointly({events_.begin() + first, events_.begin() + end}, sample, times);
        }
    }
    complete(plan_, sample, times, next_stoppage_);
    if (plan_.closures().is_known()) {
        find_caught(sample, times);
    }
}

// The earliest start of a visit's booking, from `start` on, with which its bookings keep clear of
// closures if its drive and the next stay take as long as planned; `never` if there is none.
Tick ExecutionTimetable::clear_of_closures(VisitId x, Tick start) const {
    const VisitClosures& closed = plan_.closures();
    if (!closed.is_known()) {
        return start;
    }
    const Tick drive = plan_.drive(x);
    const Tick before = plan_.books_ahead() ? 0 : drive;  // of the drive, before the start
    const Tick stay = plan_.is_last(x)
                          ? never
                          : drive - before + plan_.dwell(x) + plan_.drive(x + 1) + plan_.headway();
    for (Tick earlier = -1; earlier < start && start < never;) {
        earlier = start;
        start = closed.free_along(x, start - before, drive + plan_.headway());
        start = start >= never ? never : start + before;
        start = start >= never ? never : closed.free_stay(x, start, std::min(stay, never - start));
    }
    return start;
}

void ExecutionTimetable::find_caught(const DelaySample& sample, ActualTimes& times) const {
    const VisitClosures& closed = plan_.closures();
    for (VisitId x = 0; x < plan_.n_visits(); ++x) {
        const Tick start = times.start[index(x)];
        if (start >= never) {
            continue;
        }
        const Tick left = plan_.is_last(x) ? never : times.enter[index(x + 1)];
        const Tick end = left >= never ? never : left + plan_.headway();
        bool is_caught = closed.free_at(x, start, end) > start;
        if (!plan_.is_first(x)) {
            const Tick begin = plan_.books_ahead() ? start : start - sample.drive[index(x)];
            const Tick entered = std::min(times.enter[index(x)], never - plan_.headway());
            is_caught |= closed.free_along(x, begin, entered + plan_.headway() - begin) > begin;
        }
        times.is_caught[index(plan_.robot(x))] |= static_cast<std::uint8_t>(is_caught);
    }
}

void ExecutionTimetable::start_visit(VisitId x, const DelaySample& sample, ActualTimes& times) {
    const Tick from = times.enter[index(x - 1)];
    if (from >= never) {
        return;
    }
    const RobotId robot = plan_.robot(x);
    Stoppages stoppages(sample, robot, next_stoppage_[index(robot)], times.is_broken[index(robot)]);
    const Tick drive_before = plan_.books_ahead() ? 0 : sample.drive[index(x)];
    const Tick drive_after = sample.drive[index(x)] - drive_before;
    const Tick ready = stoppages.busy_until(sum(from, sample.dwell[index(x - 1)] + drive_before));
    VisitId other = none;
    Tick free = 0;
    for (const VisitId one : plan_.before(x)) {
        // A point keeps no headway from itself.
        const Tick headway = plan_.robot(one) == robot ? 0 : plan_.headway();
        if (const Tick end = sum(times.enter[index(one + 1)], headway); end > free) {
            other = one;
            free = end;
        }
    }
    Tick start = stoppages.waits_until(std::max({ready, free, plan_.since(x)}));
    for (Tick clear = start; (clear = clear_of_closures(x, start)) > start;) {
        start = stoppages.waits_until(clear);
    }
    times.start[index(x)] = start;
    times.enter[index(x)] =
        drive_after == 0 ? start : stoppages.busy_until(sum(start, drive_after));
    times.cause[index(x)] = free > ready && start == free ? other + 1 : x - 1;
    times.source[index(x)] = x - 1;
}

// All visits of the group begin when the last of their robots is ready.
void ExecutionTimetable::start_jointly(std::span<const VisitId> group, const DelaySample& sample,
                                       ActualTimes& times) {
    Tick instant = 0;
    VisitId latest = group.front();
    const auto put_off = [&](VisitId x, Tick until) {
        if (until > instant) {
            instant = until;
            latest = x;
        }
    };
    const auto stoppages_of = [&](VisitId x) {
        const RobotId robot = plan_.robot(x);
        return Stoppages(sample, robot, next_stoppage_[index(robot)],
                         times.is_broken[index(robot)]);
    };
    for (const VisitId x : group) {
        const Tick from = times.enter[index(x - 1)];
        const Tick done = sum(from, sample.dwell[index(x - 1)] + sample.drive[index(x)]);
        put_off(x, from >= never ? never : stoppages_of(x).busy_until(done));
        put_off(x, plan_.since(x));
    }
    for (Tick before = -1; before < instant;) {
        before = instant;
        for (const VisitId x : group) {
            put_off(x, times.enter[index(x - 1)] >= never ? never
                                                          : stoppages_of(x).waits_until(instant));
            put_off(x, clear_of_closures(x, instant));
        }
    }
    for (const VisitId x : group) {
        times.enter[index(x)] = times.start[index(x)] = instant;
        times.cause[index(x)] = times.source[index(x)] = latest - 1;
    }
}

void by_clock(const ActionDependencyGraph& plan, const DelaySample& sample, ActualTimes& times) {
    std::vector<std::int32_t> next;
    reset(plan, sample, times, next);
    for (RobotId r = 0; r < plan.n_robots(); ++r) {
        Stoppages stoppages(sample, r, next[index(r)], times.is_broken[index(r)]);
        for (VisitId x = plan.first_of(r) + 1; x <= plan.last_of(r); ++x) {
            const Tick from = times.enter[index(x - 1)];
            if (from >= never) {
                break;
            }
            const Tick done = stoppages.busy_until(sum(from, sample.dwell[index(x - 1)]));
            const Tick depart =
                stoppages.waits_until(std::max(done, plan.planned(x) - plan.drive(x)));
            const Tick arrive = stoppages.busy_until(sum(depart, sample.drive[index(x)]));
            times.enter[index(x)] = stoppages.waits_until(std::max(arrive, plan.planned(x)));
            times.start[index(x)] = plan.books_ahead() ? depart : times.enter[index(x)];
        }
    }
    complete(plan, sample, times, next);
}

}  // namespace rightofway

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
    const auto n_works = static_cast<std::size_t>(plan.works().n_works());
    times.enter.assign(n_visits, never);
    times.start.assign(n_visits, never);
    times.begin.assign(n_works, never);
    times.end.assign(n_works, never);
    times.completion.assign(n_robots, never);
    times.is_broken.assign(n_robots, 0);
    times.is_caught.assign(n_robots, 0);
    next_stoppage.assign(sample.first_stoppage.begin(), sample.first_stoppage.end() - 1);
    for (RobotId r = 0; r < plan.n_robots(); ++r) {
        times.enter[index(plan.first_of(r))] = times.start[index(plan.first_of(r))] = 0;
    }
}

// The real ticks of a visit after its works.
Tick turn_after_works(const ActionDependencyGraph& plan, const DelaySample& sample, VisitId x) {
    Tick left = sample.dwell[index(x)];
    for (WorkId work = plan.works().first_of(x); work < plan.works().end_of(x); ++work) {
        left -= plan.works().share(work, plan.dwell(x), sample.dwell[index(x)]);
    }
    return left;
}

// Sets begin and end of a work that begins at `from` or later.
void work_from(const ActionDependencyGraph& plan, const DelaySample& sample, WorkId work, Tick from,
               Stoppages& stoppages, ActualTimes& times) {
    const VisitId x = plan.works().visit(work);
    const Tick begin = stoppages.waits_until(from);
    times.begin[index(work)] = begin;
    times.end[index(work)] = stoppages.busy_until(
        sum(begin, plan.works().share(work, plan.dwell(x), sample.dwell[index(x)])));
}

// The end of the last work of a visit; its begin for a visit without works.
Tick end_of_works(const ActionDependencyGraph& plan, VisitId x, const ActualTimes& times) {
    const VisitWorks& works = plan.works();
    return works.first_of(x) == works.end_of(x) ? times.enter[index(x)]
                                                : times.end[index(works.end_of(x) - 1)];
}

void complete(const ActionDependencyGraph& plan, const DelaySample& sample, ActualTimes& times,
              std::vector<std::int32_t>& next_stoppage) {
    for (RobotId r = 0; r < plan.n_robots(); ++r) {
        const VisitId last = plan.last_of(r);
        Stoppages stoppages(sample, r, next_stoppage[index(r)], times.is_broken[index(r)]);
        const Tick done = end_of_works(plan, last, times);
        if (const WorkId work = plan.completing_work(r); work != none) {
            times.completion[index(r)] = times.end[index(work)];
        } else if (done < never) {
            times.completion[index(r)] =
                stoppages.busy_until(sum(done, turn_after_works(plan, sample, last)));
        }
    }
}

}  // namespace

ExecutionTimetable::ExecutionTimetable(const ActionDependencyGraph& plan)
    : plan_(plan),
      is_impossible_(static_cast<std::size_t>(plan.n_visits() + plan.works().n_works()), 0) {
    order_events();
    for (RobotId r = 0; r < plan_.n_robots(); ++r) {
        if (!is_possible_event(last_event_in(plan_.last_of(r)))) {
            deadlocked_.push_back(r);
        }
    }
}

// The last event of a robot before it may leave a visit: a work, or the begin of the visit.
ExecutionTimetable::EventId ExecutionTimetable::last_event_in(VisitId visit) const {
    const WorkId end = plan_.works().end_of(visit);
    return plan_.works().first_of(visit) == end ? visit : plan_.n_visits() + end - 1;
}

// The event of the same robot that an event waits for, or `none`.
ExecutionTimetable::EventId ExecutionTimetable::own_event_before(EventId event) const {
    if (!is_work(event)) {
        return plan_.is_first(event) ? none : last_event_in(event - 1);
    }
    const WorkId work = event - plan_.n_visits();
    const VisitId visit = plan_.works().visit(work);
    return plan_.works().first_of(visit) == work ? visit : event - 1;
}

std::size_t ExecutionTimetable::n_others_before(EventId event) const {
    return is_work(event) ? plan_.works().before(event - plan_.n_visits()).size()
                          : plan_.before(event).size();
}

// An event of another robot that an event waits for; `none` for the end of a last visit.
ExecutionTimetable::EventId ExecutionTimetable::other_before(EventId event,
                                                             std::size_t which) const {
    if (is_work(event)) {
        return plan_.n_visits() + plan_.works().before(event - plan_.n_visits())[which];
    }
    const VisitId other = plan_.before(event)[which];
    return plan_.is_last(other) ? none : other + 1;
}

// Emits strongly connected components in order: each after the components that it waits for.
// R. Tarjan, "Depth-first search and linear graph algorithms", SIAM Journal on Computing 1, 1972.
void ExecutionTimetable::order_events() {
    struct Open {
        EventId event;
        std::size_t next;  // wait to follow: 0: own robot, from 1 on: other robots
    };
    const std::size_t n_events = is_impossible_.size();
    std::vector<std::int32_t> number(n_events, -1);
    std::vector<std::int32_t> low(n_events, 0);
    std::vector<std::uint8_t> is_open(n_events, 0);
    std::vector<EventId> component;
    std::vector<Open> path;
    std::int32_t count = 0;
    const auto begin = [&](EventId x) {
        number[index(x)] = low[index(x)] = count++;
        is_open[index(x)] = 1;
        component.push_back(x);
        path.push_back({x, 0});
    };
    for (EventId root = 0; root < static_cast<EventId>(n_events); ++root) {
        if (number[index(root)] < 0) {
            begin(root);
        }
        while (!path.empty()) {
            const EventId x = path.back().event;
            if (path.back().next <= n_others_before(x)) {
                const std::size_t which = path.back().next++;
                const EventId other = which == 0 ? own_event_before(x) : other_before(x, which - 1);
                if (other != none && number[index(other)] < 0) {
                    begin(other);
                } else if (other != none && is_open[index(other)] != 0) {
                    low[index(x)] = std::min(low[index(x)], number[index(other)]);
                }
                continue;
            }
            path.pop_back();
            if (!path.empty()) {
                low[index(path.back().event)] =
                    std::min(low[index(path.back().event)], low[index(x)]);
            }
            if (low[index(x)] == number[index(x)]) {
                const auto from = std::find(component.rbegin(), component.rend(), x).base() - 1;
                std::for_each(from, component.end(), [&](EventId y) { is_open[index(y)] = 0; });
                emit({from, component.end()});
                component.erase(from, component.end());
            }
        }
    }
}

void ExecutionTimetable::emit(std::span<const EventId> group) {
    if (!is_possible(group)) {
        std::for_each(group.begin(), group.end(),
                      [this](EventId x) { is_impossible_[index(x)] = 1; });
    } else if (is_work(group.front()) || !plan_.is_first(group.front())) {
        events_.insert(events_.end(), group.begin(), group.end());
        first_of_group_.push_back(static_cast<std::int32_t>(events_.size()));
    }
}

// True if a component can take place once all other events that it waits for have taken place.
// Several visits can take place jointly only if each can begin as the previous visit ends.
bool ExecutionTimetable::is_possible(std::span<const EventId> group) const {
    const bool is_joint = group.size() > 1;
    const auto is_inside = [&](EventId x) {
        return std::find(group.begin(), group.end(), x) != group.end();
    };
    return std::all_of(group.begin(), group.end(), [&](EventId x) {
        const EventId own = own_event_before(x);
        if (own == none) {
            return true;
        }
        const bool has_length = is_joint && (plan_.headway() > 0 || plan_.books_ahead() ||
                                             is_work(x) || is_inside(own));
        if (has_length || !is_possible_event(own)) {
            return false;
        }
        for (std::size_t k = 0; k < n_others_before(x); ++k) {
            const EventId other = other_before(x, k);
            if (other == none || other == x || !is_possible_event(other)) {
                return false;
            }
        }
        return true;
    });
}

void ExecutionTimetable::by_right_of_way(const DelaySample& sample, ActualTimes& times,
                                         const StopCondition& interrupt) {
    Poll poll(interrupt);
    reset(plan_, sample, times, next_stoppage_);
    times.cause.assign(times.enter.size(), none);
    times.source.assign(times.enter.size(), none);
    times.stay.assign(times.begin.size(), none);
    for (std::size_t group = 0; group + 1 < first_of_group_.size(); ++group) {
        const std::int32_t first = first_of_group_[group];
        const std::int32_t end = first_of_group_[group + 1];
        poll();
        const EventId event = events_[index(first)];
        if (is_work(event)) {
            do_work(event - plan_.n_visits(), sample, times);
        } else if (end - first == 1) {
            start_visit(event, sample, times);
        } else {
            start_jointly({events_.begin() + first, events_.begin() + end}, sample, times);
        }
    }
    complete(plan_, sample, times, next_stoppage_);
    if (plan_.closures().is_known()) {
        find_caught(sample, times);
    }
}

// The visit that the end of the works of a visit is due to: itself, or one whose robot has done a
// work before.
VisitId ExecutionTimetable::stay_until_done_in(VisitId x, const ActualTimes& times) const {
    const VisitWorks& works = plan_.works();
    return works.first_of(x) == works.end_of(x) ? x : times.stay[index(works.end_of(x) - 1)];
}

void ExecutionTimetable::do_work(WorkId work, const DelaySample& sample, ActualTimes& times) {
    const VisitWorks& works = plan_.works();
    const VisitId x = works.visit(work);
    const bool is_first = works.first_of(x) == work;
    VisitId stay = is_first ? x : times.stay[index(work - 1)];
    Tick from = is_first ? times.enter[index(x)] : times.end[index(work - 1)];
    if (from >= never) {
        return;
    }
    from = std::max(from, works.earliest(work));
    for (const WorkId other : works.before(work)) {
        if (times.end[index(other)] > from) {
            from = times.end[index(other)];
            stay = times.stay[index(other)];
        }
    }
    times.stay[index(work)] = stay;
    const RobotId robot = plan_.robot(x);
    Stoppages stoppages(sample, robot, next_stoppage_[index(robot)], times.is_broken[index(robot)]);
    work_from(plan_, sample, work, from, stoppages, times);
}

// The ticks from the begin of a visit at `enter` to the end of its turn, if all goes on as planned.
Tick ExecutionTimetable::planned_stay(VisitId x, Tick enter) const {
    Tick done = enter;
    for (WorkId work = plan_.works().first_of(x); work < plan_.works().end_of(x); ++work) {
        done = std::max(done, plan_.works().earliest(work)) + plan_.works().ticks(work);
    }
    return done - enter + plan_.turn(x);
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
    const auto stay = [&](Tick from) {
        const Tick enter = from + drive - before;
        return plan_.is_last(x)
                   ? never
                   : drive - before + planned_stay(x, enter) + plan_.drive(x + 1) + plan_.headway();
    };
    for (Tick earlier = -1; earlier < start && start < never;) {
        earlier = start;
        start = closed.free_along(x, start - before, drive + plan_.headway());
        start = start >= never ? never : start + before;
        start = start >= never ? never
                               : closed.free_stay(x, start, std::min(stay(start), never - start));
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
    const Tick from = end_of_works(plan_, x - 1, times);
    if (from >= never) {
        return;
    }
    const RobotId robot = plan_.robot(x);
    Stoppages stoppages(sample, robot, next_stoppage_[index(robot)], times.is_broken[index(robot)]);
    const Tick turn = turn_after_works(plan_, sample, x - 1);
    const VisitId stay = stay_until_done_in(x - 1, times);
    const Tick drive_before = plan_.books_ahead() ? 0 : sample.drive[index(x)];
    const Tick drive_after = sample.drive[index(x)] - drive_before;
    const Tick ready = stoppages.busy_until(sum(from, turn + drive_before));
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
    const bool waits = free > ready && start == free;
    times.cause[index(x)] = waits ? other + 1 : stay;
    times.source[index(x)] = waits ? x - 1 : stay;
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
        const Tick from = end_of_works(plan_, x - 1, times);
        const Tick turn = turn_after_works(plan_, sample, x - 1);
        const Tick done = sum(from, turn + sample.drive[index(x)]);
        put_off(x, from >= never ? never : stoppages_of(x).busy_until(done));
        put_off(x, plan_.since(x));
    }
    for (Tick before = -1; before < instant;) {
        before = instant;
        for (const VisitId x : group) {
            put_off(x, end_of_works(plan_, x - 1, times) >= never
                           ? never
                           : stoppages_of(x).waits_until(instant));
            put_off(x, clear_of_closures(x, instant));
        }
    }
    for (const VisitId x : group) {
        times.enter[index(x)] = times.start[index(x)] = instant;
        times.cause[index(x)] = times.source[index(x)] = stay_until_done_in(latest - 1, times);
    }
}

void by_clock(const ActionDependencyGraph& plan, const DelaySample& sample, ActualTimes& times) {
    std::vector<std::int32_t> next;
    reset(plan, sample, times, next);
    for (RobotId r = 0; r < plan.n_robots(); ++r) {
        Stoppages stoppages(sample, r, next[index(r)], times.is_broken[index(r)]);
        for (VisitId x = plan.first_of(r); x <= plan.last_of(r); ++x) {
            Tick done = times.enter[index(x)];
            for (WorkId work = plan.works().first_of(x);
                 work < plan.works().end_of(x) && done < never; ++work) {
                work_from(plan, sample, work, std::max(done, plan.works().planned(work)), stoppages,
                          times);
                done = times.end[index(work)];
            }
            if (done >= never || plan.is_last(x)) {
                break;
            }
            const VisitId y = x + 1;
            done = stoppages.busy_until(sum(done, turn_after_works(plan, sample, x)));
            const Tick depart =
                stoppages.waits_until(std::max(done, plan.planned(y) - plan.drive(y)));
            const Tick arrive = stoppages.busy_until(sum(depart, sample.drive[index(y)]));
            times.enter[index(y)] = stoppages.waits_until(std::max(arrive, plan.planned(y)));
            times.start[index(y)] = plan.books_ahead() ? depart : times.enter[index(y)];
        }
    }
    complete(plan, sample, times, next);
}

}  // namespace rightofway

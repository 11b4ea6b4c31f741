#include "cyclic/rolling_timetable.hpp"

#include <algorithm>
#include <utility>

namespace rightofway {

RollingTimetable::RollingTimetable(const CyclicRoutes& routes)
    : RaiseSearch(CyclicVisit{nobody, 0}),
      routes_(routes),
      lines_(static_cast<std::size_t>(routes.n_robots())),
      before_(static_cast<std::size_t>(routes.n_robots())) {
    const Tick zero = 0;
    for (RobotId r = 0; r < routes.n_robots(); ++r) {
        restart(r, 0, std::span(&zero, 1));
    }
}

void RollingTimetable::restart(RobotId robot, std::int32_t start, std::span<const Tick> enters) {
    Line& line = lines_[index(robot)];
    forget_rights(line, line.base + static_cast<std::int32_t>(line.nodes.size()));
    line.base = line.start = start;
    line.nodes.clear();
    for (const Tick tick : enters) {
        line.nodes.push_back({tick, none});
    }
    line.trials.assign(line.nodes.size(), {0, {nobody, 0}});
    line.frozen = start + static_cast<std::int32_t>(enters.size());
    line.end = line.frozen - 1;
    runs_.clear();
    given_.clear();
}

void RollingTimetable::set_end(RobotId robot, std::int32_t end) {
    Line& line = lines_[index(robot)];
    runs_.clear();
    given_.clear();
    line.nodes.resize(static_cast<std::size_t>(end + 1 - line.base), {0, none});
    line.trials.resize(line.nodes.size(), {0, {nobody, 0}});
    const std::int32_t old_end = std::exchange(line.end, end);
    run_freely(robot, old_end);
}

// Resets a robot's times to those without waits, from a visit to the end of the window.
void RollingTimetable::run_freely(RobotId robot, std::int32_t from) {
    Line& line = lines_[index(robot)];
    const auto least = routes_.leasts(robot);
    std::int32_t place = routes_.place_in_lap({robot, from});
    for (std::int32_t k = from; k < line.end; ++k) {
        Node* const own = &line.nodes[index(k - line.base)];
        Tick lasts = k == 0 ? routes_.least({robot, 0}) : least[index(place)];
        if (k + 1 == line.frozen) {  // leaves after the cut
            lasts = std::max(lasts, cut_ + 1 - own->enter);
        }
        (own + 1)->enter = own->enter + lasts;
        place = place + 1 == static_cast<std::int32_t>(least.size()) ? 0 : place + 1;
    }
}

void RollingTimetable::freeze(RobotId robot, Tick tick) {
    Line& line = lines_[index(robot)];
    while (line.frozen < line.end && line.nodes[index(line.frozen - line.base)].enter <= tick) {
        ++line.frozen;
    }
}

void RollingTimetable::start_window(Tick tick, Tick cut) {
    begins_ = tick;
    cut_ = cut;
    for (Line& line : lines_) {
        while (line.start + 1 < line.frozen &&
               line.nodes[index(line.start + 1 - line.base)].enter <= tick) {
            ++line.start;
        }
        const std::int32_t past = line.start - line.base;
        if (2 * static_cast<std::size_t>(past) > line.nodes.size()) {
            forget_rights(line, line.start);
            line.nodes.erase(line.nodes.begin(), line.nodes.begin() + past);
            line.trials.erase(line.trials.begin(), line.trials.begin() + past);
            line.base = line.start;
        }
    }
}

void RollingTimetable::forget_rights(Line& line, std::int32_t below) {
    for (std::int32_t k = line.base; k < below; ++k) {
        std::int32_t& arc = line.nodes[index(k - line.base)].rights;
        for (; arc != none; arc = arcs_[index(arc)].next) {
            free_arcs_.push_back(arc);
        }
    }
}

std::int32_t RollingTimetable::find(CyclicVisit a, CyclicVisit b) const {
    std::int32_t arc = node(a).rights;
    while (arc != none && arcs_[index(arc)].second != b) {
        arc = arcs_[index(arc)].next;
    }
    return arc;
}

void RollingTimetable::link(CyclicVisit a, CyclicVisit b, DecisionId decision) {
    if (free_arcs_.empty()) {
        free_arcs_.push_back(static_cast<std::int32_t>(arcs_.size()));
        arcs_.emplace_back();
    }
    const std::int32_t arc = free_arcs_.back();
    free_arcs_.pop_back();
    arcs_[index(arc)] = {b, node(a).rights, decision};
    node(a).rights = arc;
    given_.push_back(a);
}

bool RollingTimetable::precede(CyclicVisit a, CyclicVisit b, DecisionId decision) {
    cycle_.clear();
    cycle_decisions_.clear();
    if (is_frozen(b)) {
        return false;
    }
    if (find(a, b) != none) {
        return true;
    }
    const CyclicVisit source = a.next();
    // A swap is a cycle of two robots and zero length; see Timetable.
    if (find(b.before(), source) != none) {
        cycle_ = {b, source};
        cycle_decisions_ = {arcs_[index(find(b.before(), source))].decision};
        return false;
    }
    const Tick delta = enter(source) + routes_.gap_before(b) - enter(b);
    if (delta > 0 && !spread(b, delta, source)) {
        explain(source);
        for (std::size_t k = 1; k < cycle_.size(); ++k) {
            if (cycle_[k - 1].robot != cycle_[k].robot) {
                cycle_decisions_.push_back(
                    arcs_[index(find(cycle_[k - 1].before(), cycle_[k]))].decision);
            }
        }
        forget_raises();
        return false;
    }
    link(a, b, decision);
    if (delta > 0) {
        accept();
    }
    return true;
}

// Applies the raises up to the source, then propagates to later visits, which never lead back.
void RollingTimetable::accept() {
    for (const CyclicVisit x : raised_) {
        const Tick delta = trial(x).raise;
        trial(x).raise = 0;
        if (enter(x) > latest_) {
            push(delta, x);
            continue;
        }
        node(x).enter += delta;
        runs_.push_back({x.robot, x.number, x.number + 1, delta});
        changed_.push_back({x.robot, x.number});
    }
    raised_.clear();
    run_on();
}

void RollingTimetable::push(Tick delta, CyclicVisit visit) {
    pushes_.push_back({delta, visit, enter(visit) + delta});
    std::push_heap(pushes_.begin(), pushes_.end());
}

void RollingTimetable::run_on() {
    while (!pushes_.empty()) {
        std::pop_heap(pushes_.begin(), pushes_.end());
        const Push top = pushes_.back();
        pushes_.pop_back();
        const Tick delta = top.enter - enter(top.visit);
        if (delta > 0) {
            run_from(top.visit, delta);
        }
    }
}

// Raises a visit and its successors on the route while each needs the same delta.
void RollingTimetable::run_from(CyclicVisit visit, Tick delta) {
    const RobotId robot = visit.robot;
    Line& line = lines_[index(robot)];
    const auto least = routes_.leasts(robot);
    const auto length = static_cast<std::int32_t>(least.size());
    std::int32_t place = routes_.place_in_lap(visit);
    Node* own = &line.nodes[index(visit.number - line.base)];
    std::int32_t k = visit.number;
    CyclicVisit last{nobody, 0};  // the last pushed, and when its robot leaves
    Tick last_leave = 0;
    for (;; ++k, ++own) {
        own->enter += delta;
        for (std::int32_t arc = (own - 1)->rights; arc != none; arc = arcs_[index(arc)].next) {
            const CyclicVisit second = arcs_[index(arc)].second;
            const Tick least_enter = own->enter + routes_.gap_before(second);
            const Tick raise = least_enter - enter(second);
            const bool follows = last.next() == second && last_leave >= least_enter;
            if (raise > 0 && !follows) {  // else the previous push covers it
                push(raise, second);
            }
            if (raise > 0) {
                last_leave = (follows ? last_leave : least_enter) + routes_.least(second);
                last = second;
            }
        }
        if (k == line.end) {
            break;
        }
        const Tick raise = own->enter + least[index(place)] - (own + 1)->enter;
        if (raise != delta) {
            if (raise > 0) {
                push(raise, {robot, k + 1});
            }
            break;
        }
        place = place + 1 == length ? 0 : place + 1;
    }
    runs_.push_back({robot, visit.number, k + 1, delta});
    changed_.push_back({robot, visit.number});
}

void RollingTimetable::rollback(const Mark& mark) {
    while (given_.size() > mark.n_given) {
        std::int32_t& latest = node(given_.back()).rights;
        free_arcs_.push_back(latest);
        latest = arcs_[index(latest)].next;
        given_.pop_back();
    }
    while (runs_.size() > mark.n_runs) {
        const Run run = runs_.back();
        runs_.pop_back();
        Line& line = lines_[index(run.robot)];
        for (std::int32_t k = run.from; k < run.to; ++k) {
            line.nodes[index(k - line.base)].enter -= run.delta;
        }
        changed_.push_back({run.robot, run.from});
    }
}

void RollingTimetable::remove(const CyclicRight& right, DecisionId decision) {
    std::int32_t* link = &node(right.first).rights;
    while (*link != none && arcs_[index(*link)].second != right.second) {
        link = &arcs_[index(*link)].next;
    }
    if (*link != none && arcs_[index(*link)].decision == decision) {
        const std::int32_t arc = *link;
        *link = arcs_[index(arc)].next;
        free_arcs_.push_back(arc);
    }
}

void RollingTimetable::recompute(std::span<const CyclicRight> rights) {
    runs_.clear();
    given_.clear();
    for (RobotId r = 0; r < routes_.n_robots(); ++r) {
        Line& line = lines_[index(r)];
        before_[index(r)].clear();
        for (std::int32_t k = line.frozen; k <= line.end; ++k) {
            before_[index(r)].push_back(line.nodes[index(k - line.base)].enter);
        }
        run_freely(r, line.frozen - 1);
    }
    const std::size_t n_changed = changed_.size();
    for (const auto& [first, second] : rights) {
        const Tick delta = enter(first.next()) + routes_.gap_before(second) - enter(second);
        if (delta > 0) {
            push(delta, second);
            run_on();
        }
    }
    runs_.clear();
    changed_.resize(n_changed);
    for (RobotId r = 0; r < routes_.n_robots(); ++r) {
        const Line& line = lines_[index(r)];
        for (std::int32_t k = line.frozen; k <= line.end; ++k) {
            if (line.nodes[index(k - line.base)].enter !=
                before_[index(r)][index(k - line.frozen)]) {
                changed_.push_back({r, k});
                break;
            }
        }
    }
}

}  // namespace rightofway

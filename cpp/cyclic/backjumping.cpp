#include "cyclic/backjumping.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace rightofway {

Backjumping::Backjumping(const CyclicRoutes& routes, RollingTimetable& timetable,
                         ConflictSweep& meetings, CyclicRule rule,
                         std::span<const std::int64_t> loss)
    : routes_(routes), timetable_(timetable), meetings_(meetings), rule_(rule), loss_(loss) {}

Backjumping::Outcome Backjumping::settle(const Conflict& conflict) {
    const CyclicVisit i{conflict.robot_a, conflict.visit_a};
    CyclicVisit j{conflict.robot_b, conflict.visit_b};
    if (conflict.kind == ConflictKind::swap) {
        j = j.before();  // the visit that j ends as i enters
    }
    met_ = {i, j};
    circle_.clear();
    const Segment segment = segment_of(i, j);
    if (segment.is_head_on && reaches_the_end(segment)) {
        const std::int32_t length = segment.i_last.number - segment.i_first.number + 1;
        // Two endless routes that run together for as many visits as both laps do so for ever
        // (Fine and Wilf 1965).
        if (length < routes_.length(i.robot) + routes_.length(j.robot)) {
            return Outcome::too_short;
        }
        circle_ = {i.robot, j.robot};
        return Outcome::deadlock;
    }
    const bool waits = i_waits(segment);
    culprits_.clear();
    for (const bool turned : {false, true}) {
        BackjumpingOrder order{rights_if(segment, waits != turned),
                               rights_if(segment, waits == turned)};
        if (take(std::move(order), turned)) {
            return Outcome::settled;
        }
        blame(next_serial_);
    }
    is_going_back_ = true;
    return Outcome::going_back;
}

Backjumping::Outcome Backjumping::go_back() {
    is_going_back_ = false;
    if (culprits_.empty()) {
        return Outcome::deadlock;
    }
    Step step = forget_from(culprits_.back());
    culprits_.pop_back();
    culprits_.insert(culprits_.end(), step.culprits.begin(), step.culprits.end());
    sort_culprits();
    if (!step.is_turned && !step.order.others.empty()) {
        std::swap(step.order.rights, step.order.others);
        if (take(std::move(step.order), true)) {
            return Outcome::settled;
        }
        blame(step.serial);
    }
    is_going_back_ = true;
    return Outcome::going_back;
}

// The longest run of vertices around two visits that one has in reverse order of the other, or else
// in the same.
Backjumping::Segment Backjumping::segment_of(CyclicVisit i, CyclicVisit j) const {
    for (const std::int32_t step : {-1, 1}) {
        const std::int32_t before = run(i, j, -1, -step);
        const std::int32_t after = run(i, j, 1, step);
        if (before == 0 && after == 0) {
            continue;
        }
        const auto at = [](CyclicVisit visit, std::int32_t later) {
            return CyclicVisit{visit.robot, visit.number + later};
        };
        const bool is_head_on = step < 0;
        return {is_head_on,
                !is_head_on,
                at(i, -before),
                at(i, after),
                at(j, is_head_on ? -after : -before),
                at(j, is_head_on ? before : after)};
    }
    return {false, false, i, i, j, j};
}

std::int32_t Backjumping::run(CyclicVisit i, CyclicVisit j, std::int32_t i_step,
                              std::int32_t j_step) const {
    const auto [i_start, j_start] = std::pair(timetable_.start(i.robot), timetable_.start(j.robot));
    const auto [i_end, j_end] = std::pair(timetable_.end(i.robot), timetable_.end(j.robot));
    std::int32_t length = 0;
    for (;; ++length) {
        i.number += i_step;
        j.number += j_step;
        if (i.number < i_start || i.number >= i_end || j.number < j_start || j.number >= j_end ||
            routes_.vertex(i) != routes_.vertex(j)) {
            return length;
        }
    }
}

bool Backjumping::reaches_the_end(const Segment& segment) const {
    return segment.i_last.number == timetable_.end(segment.i_last.robot) - 1 ||
           segment.j_last.number == timetable_.end(segment.j_last.robot) - 1;
}

// On a tie the one that is first goes first, and if both are the first listed.
bool Backjumping::i_waits(const Segment& segment) const {
    if (rule_ == CyclicRule::fixed_order) {
        return false;
    }
    if (rule_ == CyclicRule::least_loss) {
        const std::int64_t of_i = loss_if(segment, true);
        const std::int64_t of_j = loss_if(segment, false);
        if (of_i != of_j) {
            return of_i < of_j;
        }
    }
    return seen_enter(segment.j_first) < seen_enter(segment.i_first);
}

// How much later the one who waits is at a place of the segment, by what that costs it.
std::int64_t Backjumping::loss_if(const Segment& segment, bool i_waits) const {
    const auto rights = rights_if(segment, i_waits);
    Tick later = 0;
    for (const auto& [first, second] : rights) {
        const Tick free = timetable_.enter(first.next()) + routes_.gap_before(second);
        later = std::max(later, free - seen_enter(second));
    }
    return later * loss_[static_cast<std::size_t>(rights.front().second.robot)];
}

// What was entered before the view begins is there from its beginning.
Tick Backjumping::seen_enter(CyclicVisit visit) const {
    return std::max(timetable_.enter(visit), timetable_.begins());
}

// Head-on, the last visit of one and the first of the other say it all.
std::vector<CyclicRight> Backjumping::rights_if(const Segment& segment, bool i_waits) {
    if (!segment.is_following) {
        return {i_waits ? CyclicRight{segment.j_last, segment.i_first}
                        : CyclicRight{segment.i_last, segment.j_first}};
    }
    std::vector<CyclicRight> rights;
    CyclicVisit j = segment.j_first;
    for (CyclicVisit i = segment.i_first; i <= segment.i_last; i = i.next(), j = j.next()) {
        rights.push_back(i_waits ? CyclicRight{j, i} : CyclicRight{i, j});
    }
    return rights;
}

bool Backjumping::take(BackjumpingOrder&& order, bool is_turned) {
    const Owner serial = next_serial_;
    const RollingTimetable::Mark mark = timetable_.mark();
    auto& changed = timetable_.changed();
    const std::size_t n_changed = changed.size();
    for (const auto& [first, second] : order.rights) {
        if (!timetable_.precede(first, second, serial)) {
            const auto owners = timetable_.cycle_owners();
            blamed_.assign(owners.begin(), owners.end());
            timetable_.rollback(mark);
            changed.resize(n_changed);  // all is as it was
            return false;
        }
    }
    ++next_serial_;
    tell();
    steps_.push_back({serial, mark, false, is_turned, culprits_, std::move(order)});
    return true;
}

// Adds the decisions that made the last right of way impossible.
void Backjumping::blame(Owner below) {
    const auto cycle = timetable_.cycle();
    if (!cycle.empty()) {
        circle_.clear();
        for (auto x = cycle.rbegin(); x != cycle.rend(); ++x) {
            if (circle_.empty() || circle_.back() != x->robot) {
                circle_.push_back(x->robot);
            }
        }
    }
    for (const Owner owner : blamed_) {
        if (owner < below) {
            culprits_.push_back(owner);
        }
    }
    sort_culprits();
}

void Backjumping::sort_culprits() {
    std::sort(culprits_.begin(), culprits_.end());
    culprits_.erase(std::unique(culprits_.begin(), culprits_.end()), culprits_.end());
}

Backjumping::Step Backjumping::forget_from(Owner serial) {
    const auto from = std::find_if(steps_.begin(), steps_.end(),
                                   [serial](const Step& step) { return step.serial == serial; });
    Step step = *from;
    if (!step.is_carried) {
        timetable_.rollback(step.mark);
        steps_.erase(from, steps_.end());
    } else {
        for (auto one = from; one != steps_.end(); ++one) {
            for (const CyclicRight& right : one->order.rights) {
                timetable_.take_away(right, one->serial);
            }
        }
        steps_.erase(from, steps_.end());
        run_again();
    }
    tell();
    return step;
}

void Backjumping::run_again() {
    held_.clear();
    for (const Step& step : steps_) {
        held_.insert(held_.end(), step.order.rights.begin(), step.order.rights.end());
    }
    timetable_.run_again(held_);
    carry_on();
}

void Backjumping::tell() {
    meetings_.change(timetable_.changed());
    timetable_.changed().clear();
}

// What was given before the view moved on is taken back one by one.
void Backjumping::carry_on() {
    for (Step& step : steps_) {
        step.is_carried = true;
    }
}

void Backjumping::drop_past() {
    const auto is_past = [this](const CyclicRight& right) {
        return timetable_.is_frozen(right.second);
    };
    const auto is_out = [this](const CyclicRight& right) {
        return right.first.number < timetable_.start(right.first.robot);
    };
    for (Step& step : steps_) {
        auto& [rights, others] = step.order;
        std::erase_if(rights, [&](const auto& right) { return is_past(right) || is_out(right); });
        if (std::any_of(others.begin(), others.end(), is_past)) {
            others.clear();
        }
        std::erase_if(others, is_out);
    }
    std::erase_if(steps_, [](const Step& step) { return step.order.rights.empty(); });
    look_again();
}

void Backjumping::look_again() {
    for (Step& step : steps_) {
        step.is_turned = false;
        step.culprits.clear();
    }
    carry_on();
}

void Backjumping::put(const std::vector<BackjumpingOrder>& orders) {
    steps_.clear();
    for (const BackjumpingOrder& order : orders) {
        steps_.push_back({next_serial_++, {}, true, false, {}, order});
    }
}

void Backjumping::give() {
    for (const Step& step : steps_) {
        for (const auto& [first, second] : step.order.rights) {
            timetable_.precede(first, second, step.serial);
        }
    }
    tell();
}

}  // namespace rightofway

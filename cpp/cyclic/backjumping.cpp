#include "cyclic/backjumping.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <tuple>
#include <utility>

namespace rightofway {
namespace {

enum class Recurrence { none, in_place, head_on };

// How pairs of a segment come again whole laps apart: later for one robot and earlier for the
// other (head_on: endless), or for one robot only, which can go on for ever (in_place).
Recurrence recurrence(const std::vector<IncompatiblePair>& linked, std::int32_t i_length,
                      std::int32_t j_length) {
    using Key = std::tuple<std::int32_t, std::int32_t, std::int32_t, std::int32_t>;
    std::vector<Key> in_order;
    for (const IncompatiblePair& pair : linked) {
        in_order.emplace_back(pair.i.number % i_length, pair.j.number % j_length, pair.i.number,
                              pair.j.number);
    }
    std::sort(in_order.begin(), in_order.end());
    Recurrence found = Recurrence::none;
    std::int32_t latest = -1;  // visit of j with an earlier visit of i
    for (std::size_t k = 0, end = 0; k < in_order.size(); k = end) {
        const auto [i_place, j_place, i, first] = in_order[k];
        if (k == 0 || std::tie(i_place, j_place) !=
                          std::tie(std::get<0>(in_order[k - 1]), std::get<1>(in_order[k - 1]))) {
            latest = -1;
        }
        bool is_again = false;
        std::int32_t last = first;
        for (end = k; end < in_order.size() && std::get<0>(in_order[end]) == i_place &&
                      std::get<1>(in_order[end]) == j_place && std::get<2>(in_order[end]) == i;
             ++end) {
            last = std::get<3>(in_order[end]);
            is_again = is_again || last == latest;
        }
        if (first < latest) {
            return Recurrence::head_on;
        }
        if (end - k > 1 || is_again) {
            found = Recurrence::in_place;
        }
        latest = std::max(latest, last);
    }
    return found;
}

// Periodic routes that agree for the length of both laps together agree endlessly.
// N. J. Fine and H. S. Wilf, Uniqueness theorems for periodic functions, 1965.
Recurrence recurrence_of_run(std::size_t n_visits, std::int32_t i_length, std::int32_t j_length) {
    const std::int64_t both = std::int64_t{i_length} + j_length;
    return static_cast<std::int64_t>(n_visits) < both ? Recurrence::none : Recurrence::head_on;
}

// Of (start, end before it), those with an end that no earlier start waits for.
using Waits = std::vector<std::pair<CyclicVisit, CyclicVisit>>;
std::vector<CyclicRight> implying(Waits& waits) {
    std::sort(waits.begin(), waits.end(), [](const auto& left, const auto& right) {
        return left.first != right.first ? left.first < right.first : left.second > right.second;
    });
    std::vector<CyclicRight> rights;
    for (const auto& [start, end] : waits) {
        if (rights.empty() || end > rights.back().first) {
            rights.push_back({end, start});
        }
    }
    return rights;
}

}  // namespace

Backjumping::Backjumping(const CyclicRoutes& routes, RollingTimetable& timetable,
                         ConflictSweep& conflicts, CyclicRule rule,
                         std::span<const std::int64_t> loss)
    : routes_(routes), timetable_(timetable), conflicts_(conflicts), rule_(rule), loss_(loss) {}

Backjumping::Outcome Backjumping::resolve(const Conflict& conflict) {
    const CyclicVisit i{conflict.robot_a, conflict.visit_a};
    CyclicVisit j{conflict.robot_b, conflict.visit_b};
    if (conflict.kind == ConflictKind::swap) {
        j = j.before();  // the visit of j's robot that ends as i enters
    }
    conflict_visit_ = i;
    waiting_cycle_.clear();
    Outcome outcome = Outcome::resolved;
    const auto found = choice(i, j, outcome);
    if (!found) {
        return outcome;
    }
    const bool waits = i_waits(*found);
    culprits_.clear();
    for (const bool is_turned : {false, true}) {
        if (decide({found->rights_if(waits != is_turned), found->rights_if(waits == is_turned)},
                   is_turned)) {
            return Outcome::resolved;
        }
        add_culprits_of_refusal(next_id_);
    }
    is_backjumping_ = true;
    return Outcome::backjumping;
}

Backjumping::Outcome Backjumping::backjump() {
    is_backjumping_ = false;
    if (culprits_.empty()) {
        return Outcome::deadlock;
    }
    Decision decision = undo_from(culprits_.back());
    culprits_.pop_back();
    add_culprits(decision.culprits, next_id_);
    if (!decision.is_turned && !decision.order.others.empty()) {
        std::swap(decision.order.rights, decision.order.others);
        if (decide(std::move(decision.order), true)) {
            return Outcome::resolved;
        }
        add_culprits_of_refusal(decision.id);
    }
    is_backjumping_ = true;
    return Outcome::backjumping;
}

std::optional<Backjumping::Choice> Backjumping::choice(CyclicVisit i, CyclicVisit j,
                                                       Outcome& outcome) {
    const bool is_run = !routes_.books_edges();
    const LinkedVisits linked = is_run ? run_through(i, j) : linked_to(i, j);
    Choice choice{linked.front().i_starts(), linked.front().j_starts(), {}, {}};
    CyclicVisit i_last = i;
    CyclicVisit j_last = j;
    Waits of_i;
    Waits of_j;
    of_i.reserve(linked.size());
    of_j.reserve(linked.size());
    std::int64_t products = 0;
    std::int64_t sum_i = 0;
    std::int64_t sum_j = 0;
    for (const IncompatiblePair& pair : linked) {
        choice.i_first = std::min(choice.i_first, pair.i_starts());
        choice.j_first = std::min(choice.j_first, pair.j_starts());
        i_last = std::max(i_last, pair.i);
        j_last = std::max(j_last, pair.j_starts());
        of_i.emplace_back(pair.i_starts(), pair.j);
        of_j.emplace_back(pair.j_starts(), pair.i);
        const std::int64_t a = pair.i.number - i.number;
        const std::int64_t b = pair.j.number - j.number;
        products += a * b;
        sum_i += a;
        sum_j += b;
    }
    // Head-on: visits of i meet earlier visits of j, the later they are.
    const bool is_head_on = static_cast<std::int64_t>(linked.size()) * products - sum_i * sum_j < 0;
    const bool reaches_end = i_last.number >= timetable_.end(i.robot) - 1 ||
                             j_last.number >= timetable_.end(j.robot) - 1;
    if (is_head_on && reaches_end) {
        const std::int32_t i_length = routes_.length(i.robot);
        const std::int32_t j_length = routes_.length(j.robot);
        switch (is_run ? recurrence_of_run(linked.size(), i_length, j_length)
                       : recurrence(linked, i_length, j_length)) {
            case Recurrence::none:
                outcome = Outcome::window_too_short;
                return std::nullopt;
            case Recurrence::head_on:
                waiting_cycle_ = {i.robot, j.robot};
                outcome = Outcome::deadlock;
                return std::nullopt;
            case Recurrence::in_place:
                break;
        }
    }
    choice.if_i_waits = implying(of_i);
    choice.if_j_waits = implying(of_j);
    return choice;
}

// All pairs linked to a pair of incompatible visits, directly or through others. Two pairs are
// linked if the robots would wait for each other for ever if not one of them went first in both.
Backjumping::LinkedVisits Backjumping::linked_to(CyclicVisit i, CyclicVisit j) const {
    const auto pair_of = [&](CyclicVisit one, CyclicVisit other) {
        const bool i_leaves = one.number + 1 < timetable_.end(i.robot);
        const bool j_leaves = other.number + 1 < timetable_.end(j.robot);
        return routes_.incompatible(one, i_leaves, other, j_leaves);
    };
    const auto is_linked = [](const IncompatiblePair& one, const IncompatiblePair& other) {
        return one.j_starts().number <= other.j.number + 1 &&
               other.i_starts().number <= one.i.number + 1 &&
               one.i_starts().number <= other.i.number + 1 &&
               other.j_starts().number <= one.j.number + 1;
    };
    LinkedVisits linked{*pair_of(i, j)};
    std::set<std::pair<std::int32_t, std::int32_t>> known{{i.number, j.number}};
    for (std::size_t k = 0; k < linked.size(); ++k) {
        const IncompatiblePair here = linked[k];
        for (std::int32_t di = -1; di <= 1; ++di) {
            for (std::int32_t dj = -1; dj <= 1; ++dj) {
                const CyclicVisit one{i.robot, here.i.number + di};
                const CyclicVisit other{j.robot, here.j.number + dj};
                if (!timetable_.is_in_window(one) || !timetable_.is_in_window(other) ||
                    known.contains({one.number, other.number})) {
                    continue;
                }
                const auto near = pair_of(one, other);
                if (near && is_linked(here, *near)) {
                    known.insert({one.number, other.number});
                    linked.push_back(*near);
                }
            }
        }
    }
    return linked;
}

// The longest run of vertices around two visits that the robots visit in reverse order, or else in
// the same order.
Backjumping::LinkedVisits Backjumping::run_through(CyclicVisit i, CyclicVisit j) const {
    const auto at = [](CyclicVisit visit, std::int32_t later) {
        return CyclicVisit{visit.robot, visit.number + later};
    };
    const auto run_length = [&](std::int32_t i_step, std::int32_t j_step) {
        for (std::int32_t length = 0;; ++length) {
            const CyclicVisit one = at(i, (length + 1) * i_step);
            const CyclicVisit other = at(j, (length + 1) * j_step);
            if (!timetable_.is_in_window(one) || !timetable_.is_in_window(other) ||
                routes_.vertex(one) != routes_.vertex(other)) {
                return length;
            }
        }
    };
    std::int32_t j_step = -1;
    std::int32_t before = run_length(-1, -j_step);
    std::int32_t after = run_length(1, j_step);
    if (before == 0 && after == 0) {
        j_step = 1;
        before = run_length(-1, -j_step);
        after = run_length(1, j_step);
    }
    LinkedVisits run;
    run.reserve(static_cast<std::size_t>(before + after + 1));
    for (std::int32_t k = -before; k <= after; ++k) {
        run.push_back({at(i, k), at(j, k * j_step), ExcludingBookings::vertices()});
    }
    return run;
}

// On a tie, the robot that enters the segment first goes first; on a second tie, i.
bool Backjumping::i_waits(const Choice& choice) const {
    if (rule_ == CyclicRule::fixed_order) {
        return false;
    }
    if (rule_ == CyclicRule::least_loss) {
        const std::int64_t of_i = loss_if(choice, true);
        const std::int64_t of_j = loss_if(choice, false);
        if (of_i != of_j) {
            return of_i < of_j;
        }
    }
    return enter_in_window(choice.j_first) < enter_in_window(choice.i_first);
}

// The largest delay of the waiting robot at a vertex of the segment, times its cost per tick.
std::int64_t Backjumping::loss_if(const Choice& choice, bool i_waits) const {
    const auto& rights = choice.rights_if(i_waits);
    Tick delay = 0;
    for (const auto& [first, second] : rights) {
        const Tick free = timetable_.enter(first.next()) + routes_.gap_before(second);
        delay = std::max(delay, free - enter_in_window(second));
    }
    return delay * loss_[index(rights.front().second.robot)];
}

// The enter of a visit, at least the beginning of the window.
Tick Backjumping::enter_in_window(CyclicVisit visit) const {
    return std::max(timetable_.enter(visit), timetable_.begins());
}

// Gives all rights of way of an order; returns false and changes nothing if one is refused.
bool Backjumping::decide(SegmentOrder&& order, bool is_turned) {
    const DecisionId id = next_id_;
    const RollingTimetable::Mark mark = timetable_.mark();
    const std::size_t n_changed = timetable_.changed().size();
    for (const auto& [first, second] : order.rights) {
        if (!timetable_.precede(first, second, id)) {
            timetable_.rollback(mark);
            timetable_.changed().resize(n_changed);
            return false;
        }
    }
    ++next_id_;
    report_changes();
    decisions_.push_back({id, mark, false, is_turned, culprits_, std::move(order)});
    return true;
}

void Backjumping::add_culprits(std::span<const DecisionId> ids, DecisionId below) {
    std::copy_if(ids.begin(), ids.end(), std::back_inserter(culprits_),
                 [below](DecisionId id) { return id < below; });
    std::sort(culprits_.begin(), culprits_.end());
    culprits_.erase(std::unique(culprits_.begin(), culprits_.end()), culprits_.end());
}

// Adds the decisions on the cycle of the last refused right of way.
void Backjumping::add_culprits_of_refusal(DecisionId below) {
    const auto cycle = timetable_.cycle();
    if (!cycle.empty()) {
        waiting_cycle_.clear();
        for (auto x = cycle.rbegin(); x != cycle.rend(); ++x) {
            if (waiting_cycle_.empty() || waiting_cycle_.back() != x->robot) {
                waiting_cycle_.push_back(x->robot);
            }
        }
    }
    add_culprits(timetable_.cycle_decisions(), below);
}

Backjumping::Decision Backjumping::undo_from(DecisionId id) {
    const auto from = std::find_if(decisions_.begin(), decisions_.end(),
                                   [id](const Decision& decision) { return decision.id == id; });
    Decision undone = *from;
    if (!undone.is_older) {
        timetable_.rollback(undone.mark);
        decisions_.erase(from, decisions_.end());
    } else {
        for (auto one = from; one != decisions_.end(); ++one) {
            for (const CyclicRight& right : one->order.rights) {
                timetable_.remove(right, one->id);
            }
        }
        decisions_.erase(from, decisions_.end());
        std::vector<CyclicRight> kept;
        for (Decision& decision : decisions_) {
            const auto& rights = decision.order.rights;
            kept.insert(kept.end(), rights.begin(), rights.end());
            decision.is_older = true;
        }
        timetable_.recompute(kept);
    }
    report_changes();
    return undone;
}

void Backjumping::report_changes() {
    conflicts_.times_changed(timetable_.changed());
    timetable_.changed().clear();
}

std::vector<SegmentOrder> Backjumping::orders() const {
    std::vector<SegmentOrder> orders;
    for (const Decision& decision : decisions_) {
        orders.push_back(decision.order);
    }
    return orders;
}

void Backjumping::drop_past() {
    const auto is_past = [this](const CyclicRight& right) {
        return timetable_.is_frozen(right.second);
    };
    const auto is_before_window = [this](const CyclicRight& right) {
        return right.first.number < timetable_.start(right.first.robot);
    };
    for (Decision& decision : decisions_) {
        auto& [rights, others] = decision.order;
        std::erase_if(rights, is_past);
        std::erase_if(rights, is_before_window);
        if (std::any_of(others.begin(), others.end(), is_past)) {
            others.clear();
        }
        std::erase_if(others, is_before_window);
    }
    std::erase_if(decisions_, [](const Decision& one) { return one.order.rights.empty(); });
    allow_all_turns();
}

void Backjumping::allow_all_turns() {
    for (Decision& decision : decisions_) {
        decision.is_turned = false;
        decision.is_older = true;
        decision.culprits.clear();
    }
}

void Backjumping::restore(const std::vector<SegmentOrder>& orders) {
    decisions_.clear();
    for (const SegmentOrder& order : orders) {
        decisions_.push_back({next_id_++, {}, true, false, {}, order});
    }
}

void Backjumping::give_rights() {
    for (const Decision& decision : decisions_) {
        for (const auto& [first, second] : decision.order.rights) {
            timetable_.precede(first, second, decision.id);
        }
    }
    report_changes();
}

}  // namespace rightofway

#include "cyclic/simulator.hpp"

#include <algorithm>
#include <utility>

#include "core/reject.hpp"

namespace rightofway {
namespace {

constexpr int decisions_between_questions = 32;

// Upper limit of the ticks of a horizon, so that no sum of them overflows.
constexpr Tick longest_horizon = Tick{1} << 50;

const Horizon& checked(const Horizon& horizon, RobotId n_robots) {
    require_id("pacemaker", horizon.pacemaker, n_robots);
    require_range("lag", horizon.lag, 1, longest_horizon);
    require_range("most_lag", horizon.most_lag, 0, longest_horizon);
    require_range("patience", horizon.patience, 0, longest_horizon);
    require_range("reach", horizon.reach, 0, longest_horizon);
    if (horizon.memory < 1) {
        reject("memory", horizon.memory, "is not above 0");
    }
    return horizon;
}

}  // namespace

CyclicSimulator::CyclicSimulator(const LapArrays& laps, const Horizon& horizon, CyclicRule rule,
                                 std::vector<std::int64_t> loss)
    : routes_(laps),
      horizon_(checked(horizon, routes_.n_robots())),
      timetable_(routes_),
      conflicts_(routes_, timetable_),
      loss_(std::move(loss)),
      decisions_(routes_, timetable_, conflicts_, rule, loss_),
      past_(routes_),
      lag_(horizon.lag),
      lookahead_(static_cast<std::size_t>(routes_.n_robots())),
      ends_(static_cast<std::size_t>(routes_.n_robots())) {
    set_rule(rule);
}

void CyclicSimulator::set_rule(CyclicRule rule) {
    if (rule == CyclicRule::least_loss) {
        require_length("loss", loss_.size(), static_cast<std::size_t>(n_robots()));
        for (std::size_t r = 0; r < loss_.size(); ++r) {
            if (loss_[r] < 1) {
                reject_entry("loss", r, loss_[r], "is not above 0");
            }
        }
    }
    decisions_.set_rule(rule);
    reset_states();
}

CyclicSimulator::End CyclicSimulator::advance(const StopCondition& is_over) {
    end_ = End::open;
    return end_ = run(is_over);
}

CyclicSimulator::End CyclicSimulator::run(const StopCondition& is_over) {
    while (true) {
        if (!has_window_) {
            if (is_over()) {
                return End::open;
            }
            if (!start_window()) {
                return End::repeats;
            }
        }
        switch (resolve_conflicts(is_over)) {
            case Step::over:
                return End::open;
            case Step::done:
                freeze_to_next_cut();
                break;
            case Step::deadlock:
                if (!undo_cuts()) {
                    return End::deadlock;
                }
        }
        has_window_ = false;
    }
}

// Moves the window to the cut; false if the state at the cut has recurred.
bool CyclicSimulator::start_window() {
    if (!is_retrying()) {
        lag_ = horizon_.lag;
        n_to_undo_ = 1;
    }
    timetable_.start_window(std::max(cut_ - horizon_.reach, Tick{0}), cut_);
    std::fill(lookahead_.begin(), lookahead_.end(), 3 * lag_);
    extend_window();
    if (is_restored_) {
        decisions_.give_rights();
        is_restored_ = false;
        window_end_ = window_end();
    }
    decisions_.drop_past();
    Snapshot snapshot{cut_, {}, decisions_.orders()};
    for (RobotId r = 0; r < n_robots(); ++r) {
        snapshot.n_started.push_back(timetable_.frozen(r));
    }
    snapshots_.push_back(std::move(snapshot));
    if (snapshots_.size() > static_cast<std::size_t>(horizon_.memory)) {
        snapshots_.pop_front();
    }
    if (!is_retrying()) {
        write_state();
        if (const auto seen = seen_.find_or_add(state_, cut_)) {
            first_seen_ = *seen;
            return false;
        }
    }
    has_window_ = true;
    return true;
}

// Extends the window to the lookahead, and to all visits of decisions.
void CyclicSimulator::extend_window() {
    for (RobotId r = 0; r < n_robots(); ++r) {
        const std::int32_t n_started = timetable_.frozen(r);
        ends_[index(r)] = n_started + routes_.n_visits_in({r, n_started}, lookahead_[index(r)]);
    }
    const auto include = [this](CyclicVisit visit) {
        ends_[index(visit.robot)] = std::max(ends_[index(visit.robot)], visit.number + 1);
    };
    include({horizon_.pacemaker, next_home(horizon_.pacemaker)});
    decisions_.for_each_order([&](const std::vector<CyclicRight>& rights) {
        for (const auto& [first, second] : rights) {
            include(first);
            include(second);
        }
    });
    for (RobotId r = 0; r < n_robots(); ++r) {
        const std::int32_t old_end = timetable_.end(r);
        timetable_.set_end(r, ends_[index(r)]);
        conflicts_.end_changed(r, old_end);
    }
    window_end_ = window_end();
}

Tick CyclicSimulator::window_end() const {
    Tick end = never;
    for (RobotId r = 0; r < n_robots(); ++r) {
        end = std::min(end, timetable_.enter({r, timetable_.end(r)}));
    }
    return end;
}

// Resolves all conflicts up to the lag after the next cut.
CyclicSimulator::Step CyclicSimulator::resolve_conflicts(const StopCondition& is_over) {
    for (int count = 1;; ++count) {
        if (decisions_.is_backjumping()) {
            if (is_over()) {
                return Step::over;
            }
            if (decisions_.backjump() == Backjumping::Outcome::deadlock) {
                return Step::deadlock;
            }
            continue;
        }
        if (count % decisions_between_questions == 0 && is_over()) {
            return Step::over;
        }
        if (next_cut() - timetable_.begins() > horizon_.patience) {
            replace_pacemaker();
        }
        const Tick limit = next_cut() + lag_;
        const auto found = conflicts_.next(limit);
        const Tick tick = found ? found->tick : limit;
        if (!is_in_window(tick)) {
            for (RobotId r = 0; r < n_robots(); ++r) {
                if (timetable_.enter({r, timetable_.end(r)}) <= tick) {
                    lookahead_[index(r)] *= 2;
                }
            }
        } else if (!found) {
            return Step::done;
        } else {
            conflict_ = *found;
            const auto outcome = decisions_.resolve(conflict_);
            if (outcome == Backjumping::Outcome::deadlock) {
                return Step::deadlock;
            }
            if (outcome != Backjumping::Outcome::window_too_short) {
                continue;
            }
            lookahead_[index(conflict_.robot_a)] *= 2;
            lookahead_[index(conflict_.robot_b)] *= 2;
        }
        decisions_.allow_all_turns();
        extend_window();
    }
}

bool CyclicSimulator::is_in_window(Tick tick) {
    if (tick >= window_end_) {
        window_end_ = window_end();
    }
    return tick < window_end_;
}

void CyclicSimulator::freeze_to_next_cut() {
    cut_ = next_cut();
    for (RobotId r = 0; r < n_robots(); ++r) {
        timetable_.freeze(r, cut_);
        for (std::int32_t k = past_.n_started(r); k < timetable_.frozen(r); ++k) {
            past_.add(r, timetable_.enter({r, k}));
        }
    }
}

// Undoes some cuts and doubles the lag; false if the lag is at its limit.
bool CyclicSimulator::undo_cuts() {
    if (lag_ >= horizon_.most_lag) {
        return false;
    }
    retried_until_ = std::max(retried_until_, cut_ + 1);
    const std::size_t n_undone = std::min(n_to_undo_, snapshots_.size());
    snapshots_.resize(snapshots_.size() - n_undone + 1);
    const Snapshot snapshot = std::move(snapshots_.back());
    snapshots_.pop_back();
    restore(snapshot);
    lag_ *= 2;
    n_to_undo_ *= 2;
    seen_.forget_after(cut_);
    return true;
}

void CyclicSimulator::restore(const Snapshot& snapshot) {
    cut_ = snapshot.cut;
    const Tick begins = std::max(cut_ - horizon_.reach, Tick{0});
    std::vector<Tick> enters;
    for (RobotId r = 0; r < n_robots(); ++r) {
        past_.truncate(r, snapshot.n_started[index(r)]);
        std::int32_t start = snapshot.n_started[index(r)] - 1;
        while (start > 0 && past_.enter({r, start}) > begins) {
            --start;
        }
        enters.clear();
        for (std::int32_t k = start; k < snapshot.n_started[index(r)]; ++k) {
            enters.push_back(past_.enter({r, k}));
        }
        timetable_.restart(r, start, enters);
    }
    timetable_.start_window(begins, cut_);
    conflicts_.restart();
    decisions_.restore(snapshot.orders);
    is_restored_ = true;
}

// Replaces a pacemaker that seems to wait for ever by the robot that is home first.
void CyclicSimulator::replace_pacemaker() {
    RobotId first = nobody;
    Tick earliest = never;
    for (RobotId r = 0; r < n_robots(); ++r) {
        const std::int32_t home = next_home(r);
        if (home < timetable_.end(r) && timetable_.enter({r, home}) < earliest) {
            earliest = timetable_.enter({r, home});
            first = r;
        }
    }
    horizon_.pacemaker = first;
    seen_.clear();
}

std::int32_t CyclicSimulator::next_home(RobotId robot) const {
    const std::int32_t length = routes_.length(robot);
    return (timetable_.frozen(robot) + length - 1) / length * length;
}

Tick CyclicSimulator::next_cut() const {
    return timetable_.enter({horizon_.pacemaker, next_home(horizon_.pacemaker)});
}

// Writes the state that determines all later decisions, relative to the window's beginning.
void CyclicSimulator::write_state() {
    state_.clear();
    const auto write_tick = [this](Tick ticks) {
        state_.push_back(static_cast<std::int32_t>(ticks >> 32));
        state_.push_back(static_cast<std::int32_t>(ticks));
    };
    write_tick(cut_ - timetable_.begins());
    for (RobotId r = 0; r < n_robots(); ++r) {
        const std::int32_t start = timetable_.start(r);
        const std::int32_t frozen = timetable_.frozen(r);
        state_.insert(state_.end(), {routes_.place_in_lap({r, start}), frozen - start});
        for (std::int32_t k = start; k < frozen; ++k) {
            const CyclicVisit visit{r, k};
            const Tick enter = std::max(timetable_.enter(visit), timetable_.begins());
            const Tick leave =
                k + 1 < frozen ? timetable_.enter(visit.next())
                               : std::max(timetable_.enter(visit) + routes_.least(visit), cut_ + 1);
            write_tick(std::max(leave - enter, Tick{1}));
        }
    }
    decisions_.for_each_order([this](const std::vector<CyclicRight>& rights) {
        state_.push_back(static_cast<std::int32_t>(rights.size()));
        for (const auto& [first, second] : rights) {
            for (const CyclicVisit visit : {first, second}) {
                state_.push_back(visit.robot);
                state_.push_back(visit.number - timetable_.start(visit.robot));
            }
        }
    });
}

}  // namespace rightofway

#include "cyclic/simulator.hpp"

#include <algorithm>
#include <utility>

#include "core/reject.hpp"

namespace rightofway {
namespace {

constexpr int asked_every = 32;  // decisions

}  // namespace

CyclicSimulator::CyclicSimulator(const LapArrays& laps, const Horizon& pace, CyclicRule rule,
                                 std::vector<std::int64_t> loss)
    : routes_(laps),
      pace_(pace),
      timetable_(routes_),
      meetings_(routes_, timetable_),
      loss_(std::move(loss)),
      giving_(routes_, timetable_, meetings_, rule, loss_),
      waits_(routes_),
      lag_(pace.lag),
      ahead_(routes_.n_robots()),
      shown_(routes_.n_robots()) {
    follow(rule);
}

void CyclicSimulator::follow(CyclicRule rule) {
    if (rule == CyclicRule::least_loss) {
        require_length("loss", loss_.size(), static_cast<std::size_t>(n_robots()));
        for (std::size_t r = 0; r < loss_.size(); ++r) {
            if (loss_[r] < 1) {
                reject_entry("loss", r, loss_[r], "is not above 0");
            }
        }
    }
    giving_.follow(rule);
    forget();
}

CyclicSimulator::End CyclicSimulator::go_on(const StopCondition& is_over) {
    while (true) {
        if (!has_begun_) {
            if (is_over()) {
                return End::open;
            }
            if (!begin()) {
                return End::repeats;
            }
        }
        switch (settle(is_over)) {
            case Step::over:
                return End::open;
            case Step::go_on:
                freeze();
                break;
            case Step::deadlock:
                if (!go_back()) {
                    return End::deadlock;
                }
        }
        has_begun_ = false;
    }
}

// Moves the view on to the cut; false if its state has come before.
bool CyclicSimulator::begin() {
    if (!is_in_trouble()) {
        lag_ = pace_.lag;
        back_ = 1;
    }
    timetable_.begin_at(std::max(cut_ - pace_.reach, Tick{0}), cut_);
    std::fill(ahead_.begin(), ahead_.end(), 3 * lag_);
    show();
    if (has_returned_) {
        giving_.give();
        has_returned_ = false;
        end_ = earliest_end();
    }
    giving_.drop_past();
    Moment moment{cut_, {}, {}};
    for (RobotId r = 0; r < n_robots(); ++r) {
        moment.n_begun.push_back(timetable_.frozen(r));
    }
    for (std::size_t k = 0; k < giving_.n_orders(); ++k) {
        moment.orders.push_back(giving_.order(k));
    }
    past_.push_back(std::move(moment));
    if (past_.size() > static_cast<std::size_t>(pace_.memory)) {
        past_.pop_front();
    }
    if (!is_in_trouble()) {
        write_state();
        if (const auto before = seen_.find_or_add(state_, cut_)) {
            came_before_ = *before;
            return false;
        }
    }
    has_begun_ = true;
    return true;
}

// Shows as much as lasts as long as it has to, and all that has been decided.
void CyclicSimulator::show() {
    for (RobotId r = 0; r < n_robots(); ++r) {
        const std::int32_t n_begun = timetable_.frozen(r);
        shown_[r] = n_begun + routes_.lasting({r, n_begun}, ahead_[r]);
    }
    const auto include = [this](CyclicVisit visit) {
        shown_[visit.robot] = std::max(shown_[visit.robot], visit.number + 1);
    };
    include({pace_.pacemaker, next_home(pace_.pacemaker)});
    for (std::size_t k = 0; k < giving_.n_orders(); ++k) {
        for (const auto* rights : {&giving_.order(k).rights, &giving_.order(k).others}) {
            for (const auto& [first, second] : *rights) {
                include(first);
                include(second);
            }
        }
    }
    for (RobotId r = 0; r < n_robots(); ++r) {
        const std::int32_t old_end = timetable_.end(r);
        timetable_.show(r, shown_[r]);
        meetings_.show(r, old_end);
    }
    end_ = earliest_end();
}

void CyclicSimulator::show_longer(Tick until) {
    for (RobotId r = 0; r < n_robots(); ++r) {
        if (timetable_.enter({r, timetable_.end(r)}) <= until) {
            ahead_[r] *= 2;
        }
    }
}

Tick CyclicSimulator::earliest_end() const {
    Tick end = never;
    for (RobotId r = 0; r < n_robots(); ++r) {
        end = std::min(end, timetable_.enter({r, timetable_.end(r)}));
    }
    return end;
}

// Settles what has to be before the next cut.
CyclicSimulator::Step CyclicSimulator::settle(const StopCondition& is_over) {
    for (int count = 1;; ++count) {
        if (giving_.is_going_back()) {
            if (is_over()) {
                return Step::over;
            }
            if (giving_.go_back() == Backjumping::Outcome::deadlock) {
                return Step::deadlock;
            }
            continue;
        }
        if (count % asked_every == 0 && is_over()) {
            return Step::over;
        }
        if (next_cut() - timetable_.begins() > pace_.patience) {
            change_pacemaker();
        }
        const Tick limit = next_cut() + lag_;
        const auto meeting = meetings_.next(limit);
        const Tick tick = meeting ? meeting->tick : limit;
        if (!is_far_enough(tick)) {
            show_longer(tick);
        } else if (!meeting) {
            return Step::go_on;
        } else {
            met_ = *meeting;
            const auto outcome = giving_.settle(met_);
            if (outcome == Backjumping::Outcome::deadlock) {
                return Step::deadlock;
            }
            if (outcome != Backjumping::Outcome::too_short) {
                continue;
            }
            ahead_[met_.robot_a] *= 2;
            ahead_[met_.robot_b] *= 2;
        }
        giving_.look_again();
        show();
    }
}

bool CyclicSimulator::is_far_enough(Tick tick) {
    if (tick >= end_) {
        end_ = earliest_end();
    }
    return tick < end_;
}

void CyclicSimulator::freeze() {
    cut_ = next_cut();
    for (RobotId r = 0; r < n_robots(); ++r) {
        timetable_.freeze(r, cut_);
        for (std::int32_t k = waits_.n_begun(r); k < timetable_.frozen(r); ++k) {
            waits_.add(r, timetable_.enter({r, k}));
        }
    }
}

// Takes some cuts back and looks further ahead from now on; false if it is no use.
bool CyclicSimulator::go_back() {
    if (lag_ >= pace_.most_lag) {
        return false;
    }
    trouble_ = std::max(trouble_, cut_ + 1);
    const std::size_t n_back = std::min(back_, past_.size());
    past_.resize(past_.size() - n_back + 1);
    const Moment moment = std::move(past_.back());
    past_.pop_back();
    return_to(moment);
    lag_ *= 2;
    back_ *= 2;
    seen_.forget_after(cut_);
    return true;
}

void CyclicSimulator::return_to(const Moment& moment) {
    cut_ = moment.tick;
    const Tick begins = std::max(cut_ - pace_.reach, Tick{0});
    std::vector<Tick> enters;
    for (RobotId r = 0; r < n_robots(); ++r) {
        waits_.cut(r, moment.n_begun[r]);
        std::int32_t start = moment.n_begun[r] - 1;
        while (start > 0 && waits_.enter({r, start}) > begins) {
            --start;
        }
        enters.clear();
        for (std::int32_t k = start; k < moment.n_begun[r]; ++k) {
            enters.push_back(waits_.enter({r, k}));
        }
        timetable_.put(r, start, enters);
    }
    timetable_.begin_at(begins, cut_);
    meetings_.restart();
    giving_.put(moment.orders);
    has_returned_ = true;
}

// The robot that is home again first sets the pace; this one seems to wait for ever.
void CyclicSimulator::change_pacemaker() {
    RobotId first = nobody;
    Tick earliest = never;
    for (RobotId r = 0; r < n_robots(); ++r) {
        const std::int32_t home = next_home(r);
        if (home < timetable_.end(r) && timetable_.enter({r, home}) < earliest) {
            earliest = timetable_.enter({r, home});
            first = r;
        }
    }
    pace_.pacemaker = first;
    seen_.clear();
}

std::int32_t CyclicSimulator::next_home(RobotId robot) const {
    const std::int32_t length = routes_.length(robot);
    return (timetable_.frozen(robot) + length - 1) / length * length;
}

Tick CyclicSimulator::next_cut() const {
    return timetable_.enter({pace_.pacemaker, next_home(pace_.pacemaker)});
}

// All that decides what comes, counted from the beginning of the view.
void CyclicSimulator::write_state() {
    state_.clear();
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
    for (std::size_t k = 0; k < giving_.n_orders(); ++k) {
        for (const auto* rights : {&giving_.order(k).rights, &giving_.order(k).others}) {
            state_.push_back(static_cast<std::int32_t>(rights->size()));
            for (const auto& [first, second] : *rights) {
                write_visit(first);
                write_visit(second);
            }
        }
    }
}

void CyclicSimulator::write_visit(CyclicVisit visit) {
    state_.push_back(visit.robot);
    state_.push_back(visit.number - timetable_.start(visit.robot));
}

void CyclicSimulator::write_tick(Tick ticks) {
    state_.push_back(static_cast<std::int32_t>(ticks >> 32));
    state_.push_back(static_cast<std::int32_t>(ticks));
}

}  // namespace rightofway

#include "tours/charging.hpp"

#include <algorithm>
#include <utility>

namespace rightofway {
namespace {

constexpr std::size_t most_labels = 8;
constexpr std::size_t most_places = 3;  // charging places that are tried on a leg
constexpr std::int64_t beyond_full = std::int64_t{1} << 58;

// rate * ticks, at most `beyond_full`.
std::int64_t consume(std::int64_t rate, Tick ticks) {
    return rate != 0 && ticks > beyond_full / rate ? beyond_full : rate * ticks;
}

Tick ticks_to_gain(std::int64_t amount, std::int64_t rate) { return (amount + rate - 1) / rate; }

}  // namespace

// Lets the last charge take this many ticks more. All between it and now happens later.
void ChargePlanner::grow(Label& label, Tick ticks) const {
    const std::int64_t gain = battery_->charge == 0 ? 0
                              : ticks >= ticks_to_gain(label.room, battery_->charge)
                                  ? label.room
                                  : ticks * battery_->charge;
    label.room -= gain;
    label.soc += gain;
    label.t += ticks;
    label.ticks += ticks;
    label.slack -= ticks;
    label.cost += label.slope * static_cast<double>(ticks);
}

// Has at least this state of charge now, by a longer last charge if needed.
bool ChargePlanner::reach(Label& label, std::int64_t soc) const {
    const std::int64_t missing = soc - label.soc;
    if (missing <= 0) {
        return true;
    }
    if (label.charging < 0 || missing > label.room || battery_->charge == 0) {
        return false;
    }
    const Tick ticks = ticks_to_gain(missing, battery_->charge);
    if (ticks > label.slack) {
        return false;
    }
    grow(label, ticks);
    return true;
}

bool ChargePlanner::drive(Label& label, std::int32_t from, std::int32_t to) const {
    const Tick ticks = problem_.drive(*robot_, from, to);
    if (ticks >= TourProblem::no_way) {
        return false;
    }
    label.t += ticks;
    label.soc -= problem_.drain(*battery_, from, to) + consume(battery_->on, ticks);
    return reach(label, label.is_low ? 0 : battery_->reserve);
}

Tick ChargePlanner::earliest(std::int32_t stop) const {
    const TourStop& at = problem_.stop(stop);
    return at.is_first ? std::max(at.earliest, releases_[index(at.job)]) : at.earliest;
}

// Whether the robot waits here for the stop to open although it could have charged for longer.
bool ChargePlanner::must_wait(const Label& label, std::int32_t stop) const {
    return label.charging >= 0 && label.slack > 0 && label.t < earliest(stop);
}

// Waits until the stop is open and works there. The last charge may grow over the waiting; if it
// does not, it stays as it is, because all that comes later no longer depends on when it ended.
bool ChargePlanner::serve(Label& label, std::int32_t stop, bool fills_waiting) const {
    const TourStop& at = problem_.stop(stop);
    const TourJob& job = problem_.job(at.job);
    if (must_wait(label, stop) && fills_waiting) {
        grow(label, std::min(earliest(stop) - label.t, label.slack));
    }
    if (label.t < earliest(stop)) {
        label.soc -= consume(battery_->on, earliest(stop) - label.t);
        label.t = earliest(stop);
        label.slack = 0;
    }
    label.t += at.work;
    label.soc -= consume(battery_->on, at.work) + consume(battery_->work, at.work);
    if (label.t > at.latest || !reach(label, battery_->reserve) || label.t > at.latest) {
        return false;
    }
    if (at.latest != never) {
        label.slack = std::min(label.slack, at.latest - label.t);
    }
    if (at.is_last && problem_.objective() == TourObjective::service) {
        label.cost += static_cast<double>(problem_.service(job, label.t));
        label.slope += static_cast<double>(problem_.service_slope(job, label.t));
    }
    return true;
}

bool ChargePlanner::rest(Label& label, std::int32_t place) const {
    return reach(label, battery_->reserve + battery_->to_charging[index(place)]);
}

// A charge of no ticks was on the way: it is as if the robot had driven by.
void ChargePlanner::forget_empty_charge(Label& label) const {
    if (label.charging >= 0 && label.ticks == 0) {
        const Label& before = past_[index(label.parent)];
        label.charging = before.charging;
        label.gap = before.gap;
        label.ticks = before.ticks;
        label.parent = before.parent;
    }
}

// Arrives at a charging place, where the charge before this one ends for good.
bool ChargePlanner::begin_charge(Label& label, std::int32_t place, std::int32_t gap) {
    forget_empty_charge(label);
    past_.push_back(label);
    label.parent = static_cast<std::int32_t>(past_.size()) - 1;
    label.charging = place;
    label.gap = gap;
    label.room = std::max<std::int64_t>(battery_->full - label.soc, 0);
    label.slack = never;
    label.ticks = 0;
    label.slope = 0;
    const bool was_low = std::exchange(label.is_low, false);
    return !was_low || reach(label, battery_->reserve);
}

// The charging places of least detour between two places.
void ChargePlanner::choose_places(std::int32_t from, std::int32_t to) {
    places_.assign(battery_->charging.begin(), battery_->charging.end());
    const auto detour = [&](std::int32_t at) {
        return problem_.drive(*robot_, from, at) + problem_.drive(*robot_, at, to);
    };
    const auto n = std::min(most_places, places_.size());
    std::partial_sort(places_.begin(), places_.begin() + static_cast<std::ptrdiff_t>(n),
                      places_.end(), [&](std::int32_t a, std::int32_t b) {
                          return std::pair(detour(a), a) < std::pair(detour(b), b);
                      });
    places_.resize(n);
}

std::int64_t ChargePlanner::potential(const Label& label) const {
    const std::int64_t gain = label.charging < 0 ? 0 : consume(battery_->charge, label.slack);
    return label.soc + std::min(label.room, gain);
}

// Adds a label unless another is as good; of too many, forgets the one of the worst rank, but not
// the one that can charge most.
void ChargePlanner::keep(const Label& label, std::vector<Label>& labels) const {
    const auto is_as_good = [this](const Label& a, const Label& b) {
        return a.cost <= b.cost && a.t <= b.t && a.soc >= b.soc && potential(a) >= potential(b);
    };
    if (std::any_of(labels.begin(), labels.end(),
                    [&](const Label& other) { return is_as_good(other, label); })) {
        return;
    }
    std::erase_if(labels, [&](const Label& other) { return is_as_good(label, other); });
    labels.push_back(label);
    if (labels.size() > most_labels) {
        const auto fullest = std::max_element(
            labels.begin(), labels.end(),
            [this](const Label& a, const Label& b) { return potential(a) < potential(b); });
        std::iter_swap(labels.begin(), fullest);
        labels.erase(
            std::max_element(labels.begin() + 1, labels.end(),
                             [this](const Label& a, const Label& b) { return rank(a) < rank(b); }));
    }
}

// Drives to the next place: directly, over one charging place, and over two.
void ChargePlanner::leave(const Label& label, std::int32_t gap, std::int32_t from,
                          std::int32_t to) {
    Label direct = label;
    if (!label.is_low && drive(direct, from, to)) {
        keep(direct, arrived_);
    }
    for (const std::int32_t place : places_) {
        Label via = label;
        if (!drive(via, from, place) || !begin_charge(via, place, gap)) {
            continue;
        }
        Label arrived = via;
        if (drive(arrived, place, to)) {
            keep(arrived, arrived_);
        }
        for (const std::int32_t second : places_) {
            Label again = via;
            if (second != place && drive(again, place, second) &&
                begin_charge(again, second, gap) && drive(again, second, to)) {
                keep(again, arrived_);
            }
        }
    }
}

// With no end given the robot rests at its last stop, or at a charging place after it, where it
// need not charge.
void ChargePlanner::end_tour(const Label& label, std::int32_t from) {
    if (robot_->end >= 0) {
        arrived_.clear();
        leave(label, static_cast<std::int32_t>(stops_.size()), from, robot_->end);
        for (Label& at_end : arrived_) {
            if (rest(at_end, robot_->end)) {
                forget_empty_charge(at_end);
                ended_.push_back(at_end);
            }
        }
        return;
    }
    Label here = label;
    if (!label.is_low && rest(here, from)) {
        forget_empty_charge(here);
        ended_.push_back(here);
    }
    for (const std::int32_t place : places_) {
        Label there = label;
        if (drive(there, from, place) &&
            begin_charge(there, place, static_cast<std::int32_t>(stops_.size())) &&
            rest(there, place)) {
            ended_.push_back(there);
        }
    }
}

std::int32_t ChargePlanner::place_before(std::size_t gap) const {
    return gap == 0 ? robot_->start : problem_.stop(stops_[gap - 1]).place;
}

// Without any charge, if the battery lasts.
bool ChargePlanner::is_quick(TourTimes& times) {
    Label label;
    label.t = robot_->ready;
    label.soc = robot_->soc;
    if (label.soc < battery_->reserve && !stops_.empty()) {
        return false;
    }
    label.is_low = label.soc < battery_->reserve;
    for (std::size_t k = 0; k < stops_.size(); ++k) {
        if (!drive(label, place_before(k), problem_.stop(stops_[k]).place) ||
            !serve(label, stops_[k], false)) {
            return false;
        }
    }
    const std::int32_t last = place_before(stops_.size());
    const std::int32_t end = robot_->end < 0 ? last : robot_->end;
    return (end == last || drive(label, last, end)) && (stops_.empty() || rest(label, end)) &&
           time(label, times);
}

bool ChargePlanner::plan(RobotId robot, std::span<const std::int32_t> stops,
                         std::span<const Tick> releases, TourTimes& times) {
    robot_ = &problem_.robot(robot);
    battery_ = &problem_.battery(robot_->battery);
    stops_ = stops;
    releases_ = releases;
    past_.clear();
    if (is_quick(times)) {
        return true;
    }
    weight_left_ = 1;
    const bool is_service = problem_.objective() == TourObjective::service;
    for (const std::int32_t stop : stops_) {
        const TourStop& at = problem_.stop(stop);
        if (at.is_last && is_service) {
            weight_left_ += static_cast<double>(problem_.service_slope(problem_.job(at.job), 0));
        }
    }
    Label first;
    first.t = robot_->ready;
    first.soc = robot_->soc;
    first.is_low = first.soc < battery_->reserve;
    labels_.assign(1, first);
    for (std::size_t k = 0; k < stops_.size(); ++k) {
        const TourStop& at = problem_.stop(stops_[k]);
        choose_places(place_before(k), at.place);
        arrived_.clear();
        for (const Label& label : labels_) {
            leave(label, static_cast<std::int32_t>(k), place_before(k), at.place);
        }
        if (at.is_last && is_service) {
            weight_left_ -= static_cast<double>(problem_.service_slope(problem_.job(at.job), 0));
        }
        labels_.clear();
        for (const Label& label : arrived_) {
            for (const bool fills_waiting : {true, false}) {
                Label served = label;
                if ((fills_waiting || must_wait(label, stops_[k])) &&
                    serve(served, stops_[k], fills_waiting)) {
                    keep(served, labels_);
                }
            }
        }
    }
    const std::int32_t last = place_before(stops_.size());
    choose_places(last, robot_->end < 0 ? last : robot_->end);
    ended_.clear();
    for (const Label& label : labels_) {
        end_tour(label, last);
    }
    std::sort(ended_.begin(), ended_.end(), [](const Label& a, const Label& b) {
        return std::pair(a.cost, a.t) < std::pair(b.cost, b.t);
    });
    return std::any_of(ended_.begin(), ended_.end(),
                       [&](const Label& label) { return time(label, times); });
}

// Computes the times of the tour with the charges of a label, and checks `latest` once more: a
// charge that grew late may have moved stops before it was known that they would wait.
bool ChargePlanner::time(const Label& last, TourTimes& times) const {
    times.charges.clear();
    for (const Label* label = &last; label->charging >= 0; label = &past_[index(label->parent)]) {
        times.charges.push_back({label->gap, label->charging, 0, label->ticks});
    }
    std::reverse(times.charges.begin(), times.charges.end());
    times.begin.clear();
    times.end.clear();
    times.service = 0;
    Tick t = robot_->ready;
    std::int32_t at = robot_->start;
    auto charge = times.charges.begin();
    const auto drive_to = [&](std::int32_t place) {
        t += problem_.drive(*robot_, at, place);
        at = place;
    };
    for (std::size_t k = 0; k <= stops_.size(); ++k) {
        for (; charge != times.charges.end() && index(charge->gap) == k; ++charge) {
            drive_to(charge->place);
            charge->begin = t;
            t += charge->ticks;
        }
        if (k == stops_.size()) {
            break;
        }
        const TourStop& stop = problem_.stop(stops_[k]);
        drive_to(stop.place);
        t = std::max(
            t, stop.is_first ? std::max(stop.earliest, releases_[index(stop.job)]) : stop.earliest);
        times.begin.push_back(t);
        t += stop.work;
        times.end.push_back(t);
        if (t > stop.latest) {
            return false;
        }
        if (stop.is_last) {
            times.service += problem_.service(problem_.job(stop.job), t);
        }
    }
    if (robot_->end >= 0) {
        drive_to(robot_->end);
    }
    const bool only_rests = !times.charges.empty() && times.charges.back().ticks == 0;
    times.completion = only_rests ? times.end.empty() ? robot_->ready : times.end.back() : t;
    return true;
}

}  // namespace rightofway

#include "search/periodic_bookings.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "core/poll.hpp"
#include "core/reject.hpp"

namespace rightofway {
namespace {

constexpr Tick longest = Tick{1} << 50;
constexpr Tick most_periods = 1 << 16;                // between two given visits
constexpr std::int32_t most_periodic_rows = 1 << 26;  // that many take 1.6 GB

void require_visits(const Visits& visits, const PeriodicBookings& bookings, std::size_t least) {
    require_length("dwell", visits.dwell.size(), visits.vertex.size());
    require_length("drive", visits.drive.size(), visits.vertex.size());
    require_length("edge", visits.edge.size(), bookings.has_sizes() ? visits.vertex.size() : 0);
    require_ids("edge", visits.edge, bookings.n_rows());
    require_ids("vertex", visits.vertex, bookings.n_rows());
    if (visits.vertex.size() < least) {
        reject("vertex", static_cast<std::int64_t>(visits.vertex.size()), "visits are too few");
    }
    Tick left = latest_tick;
    for (std::size_t k = 0; k < visits.vertex.size(); ++k) {
        if (visits.dwell[k] < 0 || visits.dwell[k] > longest) {
            reject_entry("dwell", k, visits.dwell[k], "is negative or too long");
        }
        if (visits.drive[k] <= 0 || visits.drive[k] > longest) {
            reject_entry("drive", k, visits.drive[k], "is not above 0, or too long");
        }
        left -= visits.dwell[k] + visits.drive[k];
        if (left < 0) {
            reject_entry("drive", k, visits.drive[k],
                         "and the durations before it add up beyond 2^60 (use a larger tick)");
        }
    }
}

template <class T>
void sort_unique(std::vector<T>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace

PeriodicBookings::PeriodicBookings(std::int32_t n_rows, std::optional<Tick> period, Tick headway,
                                   bool books_ahead, const ExcludedRows& rows)
    : period_(period.value_or(never)), headway_(headway), books_ahead_(books_ahead), lists_(rows) {
    require_range("n_rows", n_rows, 0, most_periodic_rows);
    if (period && (*period <= 0 || *period > longest)) {
        reject("period", *period, "is not above 0, or too long");
    }
    if (headway < 0 || headway > longest) {
        reject("headway", headway, "is negative or too long");
    }
    at_.resize(static_cast<std::size_t>(n_rows));
    is_changed_.assign(at_.size(), 0);
    if (has_sizes()) {
        require_length("lists", index(lists_.n_rows()), at_.size());
        joined_.resize(at_.size());
    }
}

Tick PeriodicBookings::fold(Tick tick) const {
    if (!has_period()) {
        return tick;
    }
    const Tick rest = tick % period_;
    return rest < 0 ? rest + period_ : rest;
}

const PeriodicBookings::Row& PeriodicBookings::gaps_of(std::int32_t row) const {
    const std::size_t here = index(row);
    if (!has_sizes()) {
        return at_[here];
    }
    if (is_changed_[here] != 0) {
        join(row);
        is_changed_[here] = 0;
    }
    return joined_[here];
}

void PeriodicBookings::join(std::int32_t row) const {
    Row& joined = joined_[index(row)];
    joined.clear();
    for (const Booking& mark : at_[index(row)]) {
        if (!joined.empty() && mark.start <= joined.back().end) {
            joined.back().end = std::max(joined.back().end, mark.end);
        } else {
            joined.push_back({mark.start, mark.end, nobody});
        }
    }
    // With a period, the last may reach into the first ones of the next round.
    std::size_t n_covered = 0;
    while (has_period() && n_covered + 1 < joined.size() &&
           joined.back().end >= joined[n_covered].start + period_) {
        joined.back().end = std::max(joined.back().end, joined[n_covered].end + period_);
        ++n_covered;
    }
    joined.erase(joined.begin(), joined.begin() + static_cast<std::ptrdiff_t>(n_covered));
}

// Bookings of a row (or joined marks) begin and end in one order, so only the two neighbours can
// overlap.
bool PeriodicBookings::is_free(std::int32_t of, const Booking& booking) const {
    const Row& row = gaps_of(of);
    if (row.empty()) {
        return true;
    }
    const auto next = std::lower_bound(row.begin(), row.end(), Booking{booking.start, 0, nobody});
    const Tick ends_before = next == row.begin() ? row.back().end - period_ : std::prev(next)->end;
    const Tick starts_next = next == row.end() ? row.front().start + period_ : next->start;
    return ends_before <= booking.start && booking.end <= starts_next;
}

bool PeriodicBookings::add(RobotId robot, const Visits& visits, std::span<const Tick> enter,
                           std::optional<Tick> leave) {
    require_visits(visits, *this, has_period() ? 2 : 0);
    const std::size_t n = visits.vertex.size();
    if (robot < 0) {
        reject("robot", robot, "is negative");
    }
    require_length("enter", enter.size(), n);
    require_ranges("enter", enter, -latest_tick, latest_tick);
    if (has_period() && rows_of_.contains(robot)) {
        reject("robot", robot, "is there already");
    }
    if (has_period() == leave.has_value()) {
        reject("leave", leave.value_or(0), "is needed without a period, and only then");
    }
    require_range("leave", leave.value_or(0), -latest_tick, never);
    const Tick last_leave = leave ? *leave : enter[0] + period_;
    std::vector<std::pair<std::int32_t, Booking>> bookings;
    for (std::size_t k = 0; k < n; ++k) {
        const Tick ends = k + 1 < n ? enter[k + 1] : last_leave;
        if (ends <= enter[k]) {
            reject_entry("enter", k, enter[k], "is not before the next, or not within a period");
        }
        const Tick start = enter[k] - approach(visits, k);
        const Tick folded = fold(start);
        bookings.push_back({visits.vertex[k], {folded, folded + (ends + headway_ - start), robot}});
        if (visits.edge_into(k) != none) {
            const Tick arrives = folded + (enter[k] + headway_ - start);
            bookings.push_back({visits.edge[k], {folded, arrives, robot}});
        }
    }
    if (has_period() && !std::all_of(bookings.begin(), bookings.end(), [this](const auto& one) {
            return is_free(one.first, one.second);
        })) {
        return false;
    }
    std::vector<std::int32_t>& rows = rows_of_[robot];
    const auto insert = [&](std::int32_t row, const Booking& booking) {
        Row& bookings_there = at_[index(row)];
        bookings_there.insert(
            std::upper_bound(bookings_there.begin(), bookings_there.end(), booking), booking);
        rows.push_back(row);
    };
    for (const auto& [row, booking] : bookings) {
        for (const std::int32_t marked : lists_.of(row)) {
            insert(marked, booking);
            is_changed_[index(marked)] = 1;
        }
    }
    sort_unique(rows);
    return true;
}

void PeriodicBookings::remove(RobotId robot) {
    const auto found = rows_of_.find(robot);
    if (found == rows_of_.end()) {
        return;
    }
    for (const std::int32_t row : found->second) {
        std::erase_if(at_[index(row)], [robot](const Booking& one) { return one.robot == robot; });
        is_changed_[index(row)] = 1;
    }
    rows_of_.erase(found);
}

std::vector<RobotId> PeriodicBookings::users(std::span<const std::int32_t> rows, Tick from,
                                             Tick to) const {
    std::vector<RobotId> found;
    for (const std::int32_t row : rows) {
        require_id("vertex", row, n_rows());
        for (const Booking& one : at_[index(row)]) {
            if (one.start < to && from < one.end) {
                found.push_back(one.robot);
            }
        }
    }
    sort_unique(found);
    return found;
}

// The earliest enter in [enter, last] after a drive of some ticks along an edge that is free.
Tick PeriodicBookings::drives(std::int32_t edge, Tick enter, Tick last, Tick ticks) const {
    Tick found = never;
    for_each_gap(edge, enter - ticks, last - ticks, [&](const Gap& gap) {
        const Tick soonest = gap.start == -never ? enter : std::max(enter, gap.start + ticks);
        if (soonest <= last && (gap.end == never || soonest + headway_ <= gap.end)) {
            found = soonest;
        }
        return found == never;
    });
    return found;
}

Tick PeriodicBookings::enters(const Gap& here, const Gap& there, Tick soonest, Tick last,
                              Tick approach, std::int32_t edge) const {
    Tick enter = there.start == -never ? soonest : std::max(soonest, there.start + approach);
    if (edge != none && enter <= last) {
        enter = drives(edge, enter, last, approach);
    }
    const bool fits = there.end == never || enter + headway_ < there.end;
    const bool swaps = headway_ == 0 && approach == 0 && there.start == enter &&
                       here.end == enter && there.before == here.after;
    return enter <= last && fits && !swaps ? enter : never;
}

void PeriodicBookings::prepare(const Visits& visits, std::size_t last) {
    const std::size_t n = visits.vertex.size();
    rest_.assign(last + 1, 0);
    for (std::size_t k = last; k-- > 0;) {
        rest_[k] = rest_[k + 1] + visits.dwell[k] + visits.drive[(k + 1) % n];
    }
    stays_.resize(std::max(stays_.size(), last + 1));
    reached_ = 0;
}

bool PeriodicBookings::search(const Visits& visits, Tick phase, std::vector<Tick>& enter,
                              const StopCondition& is_over) {
    if (!has_period()) {
        reject("period", 0, "is needed for visits that repeat");
    }
    require_visits(visits, *this, 2);
    require_range("phase", phase, -latest_tick, latest_tick);
    prepare(visits, visits.vertex.size());
    if (rest_[0] > period_) {
        return false;
    }
    const Tick first = fold(phase);
    bool is_found = false;
    for_each_gap(visits.vertex[0], first, first + period_, [&](const Gap& home) {
        const Tick start = home.start == -never ? first : home.start + approach(visits, 0);
        is_found = close_from(visits, home, start, enter, is_over);
        return !is_found;
    });
    return is_found;
}

// Finds the earliest start in a gap of the first vertex that repeats a period later.
bool PeriodicBookings::close_from(const Visits& visits, const Gap& home, Tick start,
                                  std::vector<Tick>& enter, const StopCondition& is_over) {
    const std::size_t n = visits.vertex.size();
    const Tick latest =
        home.end == never ? start : home.end - headway_ - visits.dwell[0] - visits.drive[1];
    while (start <= latest && !is_over()) {
        // Visit n repeats visit 0, in the same gap a period later.
        const auto& last = spread(visits, n, {start, home, none}, latest + period_, is_over);
        const auto again = std::find_if(last.begin(), last.end(), [&](const Stay& stay) {
            return home.end == never || stay.gap.start == home.start + period_;
        });
        if (again == last.end()) {
            return false;
        }
        if (again->enter <= start + period_) {
            trace(n, *again, enter);
            enter[0] = again->enter - period_;
            enter.pop_back();
            return true;
        }
        start = again->enter - period_;
    }
    return false;
}

bool PeriodicBookings::connect(const Visits& visits, Tick from, Tick until, Tick leave,
                               std::vector<Tick>& enter, const StopCondition& is_over) {
    require_visits(visits, *this, 1);
    require_range("begins", from, -latest_tick, latest_tick);
    require_range("until", until, -latest_tick, latest_tick);
    require_range("leave", leave, -latest_tick, never);
    if (has_period() && (until - from) / period_ > most_periods) {
        reject("until", until,
               "is more than " + std::to_string(most_periods) + " periods after begins, " +
                   std::to_string(from));
    }
    const std::size_t last = visits.vertex.size() - 1;
    prepare(visits, last);
    std::optional<Gap> first;
    const Tick start = from - approach(visits, 0);
    for_each_gap(visits.vertex[0], start, start, [&](const Gap& gap) {
        if (from + headway_ < gap.end) {
            first = gap;
        }
        return !first;
    });
    if (!first) {
        return false;
    }
    const auto& stays = spread(visits, last, {from, *first, none}, until, is_over);
    const auto found = std::find_if(stays.begin(), stays.end(), [&](const Stay& stay) {
        return stay.enter <= until && (stay.gap.end == never || leave + headway_ <= stay.gap.end);
    });
    if (found == stays.end()) {
        return false;
    }
    trace(last, *found, enter);
    return true;
}

// The earliest enter into each gap of visit `last` after the stay `first`, at most `latest`. Visit
// n repeats visit 0. None if it is stopped.
const std::vector<PeriodicBookings::Stay>& PeriodicBookings::spread(const Visits& visits,
                                                                    std::size_t last,
                                                                    const Stay& first, Tick latest,
                                                                    const StopCondition& is_over) {
    Poll poll(is_over);
    for (std::size_t k = 0; k <= last; ++k) {
        stays_[k].clear();
    }
    stays_[0].push_back(first);
    for (std::size_t k = 0; k < last && !stays_[k].empty(); ++k) {
        reached_ = std::max(reached_, k);
        const std::size_t next = (k + 1) % visits.vertex.size();
        const Tick ahead = approach(visits, next);
        for (std::size_t from = 0; from < stays_[k].size(); ++from) {
            if (poll()) {
                stays_[last].clear();
                return stays_[last];
            }
            const Stay& here = stays_[k][from];
            const Tick soonest = here.enter + visits.dwell[k] + visits.drive[next];
            const Tick latest_enter = std::min(
                here.gap.end == never ? never : here.gap.end - headway_, latest - rest_[k + 1]);
            if (soonest > latest_enter) {
                continue;
            }
            for_each_gap(visits.vertex[next], soonest, latest_enter - ahead, [&](const Gap& gap) {
                const Tick enter =
                    enters(here.gap, gap, soonest, latest_enter, ahead, visits.edge_into(next));
                if (enter == never) {
                    return true;
                }
                const Stay stay{enter, gap, static_cast<std::int32_t>(from)};
                const auto known = std::find_if(
                    stays_[k + 1].begin(), stays_[k + 1].end(), [&gap](const Stay& other) {
                        return other.gap.start == gap.start && other.gap.end == gap.end;
                    });
                if (known == stays_[k + 1].end()) {
                    stays_[k + 1].push_back(stay);
                } else if (enter < known->enter) {
                    *known = stay;
                }
                return true;
            });
        }
    }
    return stays_[last];
}

void PeriodicBookings::trace(std::size_t last, const Stay& stay, std::vector<Tick>& enter) const {
    enter.resize(last + 1);
    const Stay* one = &stay;
    for (std::size_t k = last; k > 0; --k) {
        enter[k] = one->enter;
        one = &stays_[k - 1][index(one->from)];
    }
    enter[0] = one->enter;
}

}  // namespace rightofway

#include "search/periodic_bookings.hpp"

#include <algorithm>

#include "core/reject.hpp"

namespace rightofway {
namespace {

constexpr Tick longest_period = Tick{1} << 50;

void require_round(const Round& round, VertexId n_vertices) {
    require_length("dwell", round.dwell.size(), round.vertex.size());
    require_length("drive", round.drive.size(), round.vertex.size());
    if (round.vertex.size() < 2) {
        reject("vertex", static_cast<std::int64_t>(round.vertex.size()), "visits are too few");
    }
    for (std::size_t k = 0; k < round.vertex.size(); ++k) {
        require_id("vertex[" + std::to_string(k) + "]", round.vertex[k], n_vertices);
        if (round.dwell[k] < 0 || round.dwell[k] > longest_period) {
            reject_entry("dwell", k, round.dwell[k], "is negative or too long");
        }
        if (round.drive[k] <= 0 || round.drive[k] > longest_period) {
            reject_entry("drive", k, round.drive[k], "is not above 0, or too long");
        }
    }
}

}  // namespace

PeriodicBookings::PeriodicBookings(VertexId n_vertices, Tick period, Tick headway, bool books_ahead)
    : period_(period), headway_(headway), books_ahead_(books_ahead) {
    if (n_vertices < 0) {
        reject("n_vertices", n_vertices, "is negative");
    }
    if (period <= 0 || period > longest_period) {
        reject("period", period, "is not above 0, or too long");
    }
    if (headway < 0 || headway > longest_period) {
        reject("headway", headway, "is negative or too long");
    }
    at_.resize(static_cast<std::size_t>(n_vertices));
}

std::vector<PeriodicBookings::Booking>::const_iterator PeriodicBookings::first_from(
    const std::vector<Booking>& row, Tick tick) {
    return std::lower_bound(row.begin(), row.end(), tick,
                            [](const Booking& one, Tick from) { return one.start < from; });
}

Tick PeriodicBookings::fold(Tick tick) const {
    const Tick rest = tick % period_;
    return rest < 0 ? rest + period_ : rest;
}

// What a visit books, its start turned into the first period.
PeriodicBookings::Booking PeriodicBookings::folded(const Round& round, std::span<const Tick> enter,
                                                   std::size_t k, RobotId robot) const {
    const std::size_t n = round.vertex.size();
    const Tick leave = k + 1 < n ? enter[k + 1] : enter[0] + period_;
    const Tick start = enter[k] - (books_ahead_ ? round.drive[k] : 0);
    const Tick begins = fold(start);
    return {begins, begins + (leave + headway_ - start), robot};
}

// Bookings of a vertex begin and end in the same order, so only the two next to a new one matter.
bool PeriodicBookings::is_free(VertexId vertex, const Booking& booking) const {
    const auto& row = at_[static_cast<std::size_t>(vertex)];
    if (row.empty()) {
        return true;
    }
    const auto next = first_from(row, booking.start);
    const Tick ends_before = next == row.begin() ? row.back().end - period_ : std::prev(next)->end;
    const Tick starts_next = next == row.end() ? row.front().start + period_ : next->start;
    return ends_before <= booking.start && booking.end <= starts_next;
}

void PeriodicBookings::add(RobotId robot, const Round& round, std::span<const Tick> enter) {
    require_round(round, static_cast<VertexId>(at_.size()));
    require_length("enter", enter.size(), round.vertex.size());
    if (vertices_of_.contains(robot)) {
        reject("robot", robot, "is there already");
    }
    const std::size_t n = enter.size();
    for (std::size_t k = 0; k < n; ++k) {
        if ((k + 1 < n ? enter[k + 1] : enter[0] + period_) <= enter[k]) {
            reject_entry("enter", k, enter[k], "is not before the next, or not within a period");
        }
        if (!is_free(round.vertex[k], folded(round, enter, k, robot))) {
            reject_entry("enter", k, enter[k], "overlaps the booking of another robot");
        }
    }
    for (std::size_t k = 0; k < n; ++k) {
        auto& row = at_[static_cast<std::size_t>(round.vertex[k])];
        const Booking booking = folded(round, enter, k, robot);
        row.insert(first_from(row, booking.start), booking);
    }
    std::vector<VertexId>& vertices = vertices_of_[robot];
    vertices.assign(round.vertex.begin(), round.vertex.end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
}

void PeriodicBookings::remove(RobotId robot) {
    const auto found = vertices_of_.find(robot);
    if (found == vertices_of_.end()) {
        return;
    }
    for (const VertexId vertex : found->second) {
        std::erase_if(at_[static_cast<std::size_t>(vertex)],
                      [robot](const Booking& one) { return one.robot == robot; });
    }
    vertices_of_.erase(found);
}

Tick PeriodicBookings::enters(const Gap& here, const Gap& there, Tick soonest, Tick last,
                              Tick approach) const {
    const Tick enter = there.start == -never ? soonest : std::max(soonest, there.start + approach);
    const bool fits = there.end == never || enter + headway_ < there.end;
    const bool swaps = headway_ == 0 && approach == 0 && there.start == enter &&
                       here.end == enter && there.before == here.after;
    return enter <= last && fits && !swaps ? enter : never;
}

bool PeriodicBookings::search(const Round& round, Tick phase, std::vector<Tick>& enter,
                              const StopCondition& is_over) {
    require_round(round, static_cast<VertexId>(at_.size()));
    const std::size_t n = round.vertex.size();
    rest_.assign(n + 1, 0);
    for (std::size_t k = n; k-- > 0;) {
        rest_[k] = rest_[k + 1] + round.dwell[k] + round.drive[(k + 1) % n];
    }
    stays_.resize(std::max(stays_.size(), n + 1));
    if (rest_[0] > period_) {
        return false;
    }
    const Tick approach = books_ahead_ ? round.drive[0] : 0;
    const Tick first = fold(phase);
    bool is_found = false;
    reached_ = 0;
    for_each_gap(round.vertex[0], first, first + period_, [&](const Gap& home) {
        const Tick start = home.start == -never ? first : home.start + approach;
        is_found = close_from(round, home, start, enter, is_over);
        return !is_found;
    });
    return is_found;
}

// Starts as early in a gap of its home as it can be back there a period later.
bool PeriodicBookings::close_from(const Round& round, const Gap& home, Tick start,
                                  std::vector<Tick>& enter, const StopCondition& is_over) {
    const Tick leaves =
        home.end == never ? start : home.end - headway_ - round.dwell[0] - round.drive[1];
    while (start <= leaves && !is_over()) {
        // Home again at the latest when the last possible start comes again.
        const Tick again = run(round, home, start, (home.end == never ? start : leaves) + period_);
        if (again >= never) {
            return false;
        }
        if (again <= start + period_) {
            trace(round, closing_, enter);
            return true;
        }
        start = again - period_;
    }
    return false;
}

// When a robot that enters its home at `start` is there again, in the same gap a period later;
// `never` if it cannot be.
Tick PeriodicBookings::run(const Round& round, const Gap& home, Tick start, Tick latest) {
    const std::size_t n = round.vertex.size();
    for (std::size_t k = 0; k <= n; ++k) {
        stays_[k].clear();
    }
    stays_[0].push_back({start, home, nobody});
    for (std::size_t k = 0; k < n && !stays_[k].empty(); ++k) {
        reached_ = std::max(reached_, k);
        for (std::size_t from = 0; from < stays_[k].size(); ++from) {
            go_on(round, k, static_cast<std::int32_t>(from), latest);
        }
    }
    closing_ = nobody;
    for (std::size_t k = 0; k < stays_[n].size(); ++k) {
        const Stay& stay = stays_[n][k];
        if (home.end == never || stay.gap.start == home.start + period_) {
            closing_ = static_cast<std::int32_t>(k);
            return stay.enter;
        }
    }
    return never;
}

// Drives from a stay into every gap of the next vertex that it can enter.
void PeriodicBookings::go_on(const Round& round, std::size_t k, std::int32_t from, Tick latest) {
    const std::size_t n = round.vertex.size();
    const Stay here = stays_[k][static_cast<std::size_t>(from)];
    const std::size_t next = (k + 1) % n;
    const Tick soonest = here.enter + round.dwell[k] + round.drive[next];
    const Tick last =
        std::min(here.gap.end == never ? never : here.gap.end - headway_, latest - rest_[k + 1]);
    if (soonest > last) {
        return;
    }
    const Tick approach = books_ahead_ ? round.drive[next] : 0;
    for_each_gap(round.vertex[next], soonest, last - approach, [&](const Gap& gap) {
        const Tick enter = enters(here.gap, gap, soonest, last, approach);
        if (enter < never) {
            arrive(k + 1, {enter, gap, from});
        }
        return true;
    });
}

void PeriodicBookings::arrive(std::size_t k, const Stay& stay) {
    for (Stay& known : stays_[k]) {
        if (known.gap.start == stay.gap.start && known.gap.end == stay.gap.end) {
            if (stay.enter < known.enter) {
                known = stay;
            }
            return;
        }
    }
    stays_[k].push_back(stay);
}

void PeriodicBookings::trace(const Round& round, std::int32_t last,
                             std::vector<Tick>& enter) const {
    const std::size_t n = round.vertex.size();
    enter.resize(n);
    std::int32_t stay = last;
    for (std::size_t k = n; k > 0; --k) {
        const Stay& one = stays_[k][static_cast<std::size_t>(stay)];
        enter[k % n] = k == n ? one.enter - period_ : one.enter;
        stay = one.from;
    }
}

}  // namespace rightofway

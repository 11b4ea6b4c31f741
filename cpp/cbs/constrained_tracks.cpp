#include "cbs/constrained_tracks.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace rightofway {
namespace {

// How often a search for a track with few overlaps may ask whether it is over, each some hundred
// states: it has many where a robot can wait at many places. No proof needs its track.
constexpr int most_questions = 20;

// Swaps and rotations at one instant are forbidden on edges, which points do not book otherwise.
std::int32_t count_rows(const Problem& problem) {
    return problem.may_follow() && !problem.has_sizes() ? problem.n_resources() : problem.n_rows();
}

}  // namespace

Traffic::Traffic(const Problem& problem)
    : problem_(problem),
      table_(count_rows(problem)),
      tracks_(static_cast<std::size_t>(problem.n_robots()), nullptr) {
    const Closures& closed = problem.closures();
    for (std::size_t k = 0; k < closed.row.size(); ++k) {
        table_.insert(closed.row[k], {closed.start[k], closed.end[k]}, nobody);
    }
}

// Calls `use` with each row from which a booking of the track excludes other robots, and when.
template <class Use>
void Traffic::for_each_mark(const ConstrainedTrack& track, const Use& use) const {
    for (const RowBooking& booking : track.bookings) {
        if (!problem_.has_sizes()) {
            use(booking.row, booking.time);
            continue;
        }
        for (const std::int32_t row : problem_.excluded(booking.row)) {
            use(row, booking.time);
        }
    }
}

void Traffic::exchange(RobotId robot, const ConstrainedTrack* track) {
    const ConstrainedTrack*& own = tracks_[index(robot)];
    if (own == track) {
        return;
    }
    if (own != nullptr) {
        for_each_mark(*own, [&](std::int32_t row, const Booking& time) {
            table_.erase(row, time.start, robot);
        });
    }
    own = track;
    if (own != nullptr) {
        for_each_mark(
            *own, [&](std::int32_t row, const Booking& time) { table_.insert(row, time, robot); });
    }
}

const std::vector<RobotId>& Traffic::robots_met(RobotId robot, const ConstrainedTrack& track) {
    met_.clear();
    const auto meet = [&](RobotId other) {
        if (other != robot && other != nobody) {
            met_.push_back(other);
        }
    };
    for (const RowBooking& booking : track.bookings) {
        const auto here = table_.at(booking.row);
        for (auto k = BookingTable::started(here, booking.time.end - 1);
             k > 0 && here[index(k - 1)].reach > booking.time.start; --k) {
            if (here[index(k - 1)].time.end > booking.time.start) {
                meet(here[index(k - 1)].robot);
            }
        }
    }
    for (const Move& move : track.moves) {  // a robot that swaps enters the tail at this instant
        const auto here = table_.at(problem_.vertex_row(robot, move.tail));
        for (auto k = BookingTable::started(here, move.enter);
             k > 0 && here[index(k - 1)].time.start == move.enter; --k) {
            meet(here[index(k - 1)].robot);
        }
    }
    std::sort(met_.begin(), met_.end());
    met_.erase(std::unique(met_.begin(), met_.end()), met_.end());
    return met_;
}

ConstrainedTracks::ConstrainedTracks(const Problem& problem, SharedDistances& distances)
    : problem_(problem),
      no_traffic_(problem),
      held_(problem, no_traffic_.table()),
      search_(problem.roads(), problem.rules()),
      joint_(problem, no_traffic_.table()) {
    problem.refuse_times("conflict-based search");
    for (RobotId robot = 0; robot < problem.n_robots(); ++robot) {
        trips_.emplace_back(distances, true);
    }
}

const ConstrainedTrack* ConstrainedTracks::best(RobotId robot, SetId set,
                                                const StopCondition& is_over) {
    const auto key = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(robot)) << 32) |
                     static_cast<std::uint32_t>(set);
    const auto known = known_.find(key);
    if (known != known_.end()) {
        return known->second;
    }
    const auto constraints = sets_.at(set);
    const auto n_holds = static_cast<std::size_t>(std::count_if(
        constraints.begin(), constraints.end(), [](const auto& one) { return one.is_hold(); }));
    const auto holds = constraints.first(n_holds);  // they come first, by their rows
    BookingTable& table = holds.empty() ? no_traffic_.table() : held_.at(robot, holds);
    const SearchRequest request{trips_[index(robot)].read(robot), table};
    const ConstrainedTrack* track =
        search(robot, constraints.subspan(n_holds), request, table, is_over);
    bytes_ += constraints.size_bytes() + 64;
    known_.emplace(key, track);
    return track;
}

// A price above the greatest cost makes the fewest overlaps the cheapest. Prices cannot be told
// from surcharges, so where there are surcharges no overlap is for sale.
const ConstrainedTrack* ConstrainedTracks::clearest(RobotId robot, SetId set, Tick cost,
                                                    Traffic& traffic,
                                                    const StopCondition& is_over) {
    traffic.exchange(robot, nullptr);
    const Trip& trip = trips_[index(robot)].read(robot);
    const Tick limit = cost / problem_.weight(robot);
    SearchRequest request{trip, traffic.table()};
    if (trip.surcharges.empty()) {
        prices_.assign(static_cast<std::size_t>(problem_.n_robots()), limit + 1);
        request.prices = prices_;
        request.latest = limit;
    } else {
        request.limit = limit;
    }
    int n_questions = 0;
    bool is_stopped = false;
    try {
        return search(robot, sets_.at(set), request, traffic.table(), [&] {
            is_stopped = is_over();
            return is_stopped || ++n_questions > most_questions;
        });
    } catch (const Stopped&) {
        if (is_stopped) {
            throw;
        }
        return nullptr;
    }
}

// Puts constraints into the table and, those of the end of the track, into the request.
SearchRequest ConstrainedTracks::constrained(std::span<const Constraint> constraints,
                                             SearchRequest request, BookingTable& table) const {
    for (const Constraint& one : constraints) {
        if (one.row >= 0) {
            table.insert(one.row, {one.start, one.end}, nobody);
            continue;
        }
        if (one.is_hold()) {
            held_.insert(one, table);
            continue;
        }
        Tick& earliest = one.row == Constraint::completion ? request.ends_from : request.stays_from;
        earliest = std::max(earliest, one.end);
    }
    return request;
}

// The last one first: of equal starts in a row, the table erases the latest.
void ConstrainedTracks::release(std::span<const Constraint> constraints,
                                BookingTable& table) const {
    for (std::size_t k = constraints.size(); k-- > 0;) {
        const Constraint& one = constraints[k];
        if (one.is_hold()) {
            held_.erase(one, table);
        } else if (one.row >= 0) {
            table.erase(one.row, one.start, nobody);
        }
    }
}

JointPlan ConstrainedTracks::together(std::span<const RobotId> robots, std::span<const SetId> sets,
                                      std::span<const Tick> most, std::int64_t most_nodes,
                                      const StopCondition& is_over) {
    std::vector<GroupMember> members;
    for (std::size_t k = 0; k < robots.size(); ++k) {
        members.push_back({.robot = robots[k],
                           .trip = &trips_[index(robots[k])].read(robots[k]),
                           .constraints = sets_.at(sets[k])});
        if (!most.empty() && most[k] < never) {
            members.back().most = most[k] / problem_.weight(robots[k]);
        }
    }
    JointPlan plan;
    plan.end = joint_.run(members, most_nodes, is_over);
    plan.n_states = joint_.n_states();
    plan.bound = plan.end == SearchEnd::proven_none ? never : joint_.bound();
    for (std::size_t k = 0; plan.end == SearchEnd::found && k < robots.size(); ++k) {
        ConstrainedTrack track;
        joint_.track(k, track.visits);
        track.completion = completion(*members[k].trip, track.visits);
        track.cost = track.completion;
        for (std::size_t v = 1; v < track.visits.size(); ++v) {
            track.cost += problem_.surcharge(
                problem_.graph().edge(track.visits[v - 1].vertex, track.visits[v].vertex));
        }
        track.cost *= problem_.weight(robots[k]);
        plan.tracks.push_back(keep(robots[k], std::move(track)));
    }
    return plan;
}

const ConstrainedTrack* ConstrainedTracks::search(RobotId robot,
                                                  std::span<const Constraint> constraints,
                                                  SearchRequest request, BookingTable& table,
                                                  const StopCondition& is_over) {
    ++n_searches_;
    const SearchEnd end = search_.run(constrained(constraints, request, table), is_over);
    release(constraints, table);
    if (end == SearchEnd::stopped) {
        throw Stopped{};
    }
    if (end != SearchEnd::found) {
        return nullptr;
    }
    ConstrainedTrack track;
    search_.track(track.visits);
    // Prices are paid only where there are no surcharges, and are no cost.
    track.completion = search_.completion();
    track.cost =
        problem_.weight(robot) * (request.prices.empty() ? search_.cost() : track.completion);
    return keep(robot, std::move(track));
}

const ConstrainedTrack* ConstrainedTracks::keep(RobotId robot, ConstrainedTrack&& track) {
    book(robot, track);
    bytes_ += sizeof(track) + track.visits.size() * sizeof(Visit) +
              track.bookings.size() * sizeof(RowBooking) + track.moves.size() * sizeof(Move);
    return &tracks_.emplace_back(std::move(track));
}

void ConstrainedTracks::book(RobotId robot, ConstrainedTrack& track) const {
    const auto& visits = track.visits;
    const BookingRules& rules = problem_.rules();
    for (std::size_t k = 0; k < visits.size(); ++k) {
        const Visit& visit = visits[k];
        const Tick approach = rules.books_ahead ? visit.drive : 0;
        const Tick end = k + 1 < visits.size() ? visits[k + 1].enter + rules.headway : never;
        track.bookings.push_back(
            {problem_.vertex_row(robot, visit.vertex), {visit.enter - approach, end}});
        if (k == 0) {
            continue;
        }
        const EdgeId edge = problem_.graph().edge(visits[k - 1].vertex, visit.vertex);
        if (problem_.has_sizes() && problem_.edges_exclude()) {
            track.bookings.push_back({problem_.edge_row(robot, edge),
                                      {visit.enter - visit.drive, visit.enter + rules.headway}});
        }
        if (problem_.may_follow()) {
            track.moves.push_back({visit.enter, edge, visits[k - 1].vertex, visit.vertex});
        }
    }
    std::sort(track.bookings.begin(), track.bookings.end(),
              [](const RowBooking& left, const RowBooking& right) {
                  return std::tuple(left.row, left.time.start) <
                         std::tuple(right.row, right.time.start);
              });
}

}  // namespace rightofway

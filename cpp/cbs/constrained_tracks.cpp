#include "cbs/constrained_tracks.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace rightofway {
namespace {

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

ConstrainedTracks::ConstrainedTracks(const Problem& problem, SharedDistances& distances)
    : problem_(problem), no_traffic_(problem), search_(problem.roads(), problem.rules()) {
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
    const ConstrainedTrack* track = search(robot, set, never, no_traffic_.table(), is_over);
    bytes_ += sets_.at(set).size_bytes() + 64;
    known_.emplace(key, track);
    return track;
}

const ConstrainedTrack* ConstrainedTracks::clear(RobotId robot, SetId set, Tick cost,
                                                 Traffic& traffic, const StopCondition& is_over) {
    traffic.exchange(robot, nullptr);
    return search(robot, set, cost / problem_.weight(robot), traffic.table(), is_over);
}

const ConstrainedTrack* ConstrainedTracks::search(RobotId robot, SetId set, Tick limit,
                                                  BookingTable& table,
                                                  const StopCondition& is_over) {
    ++n_searches_;
    const auto constraints = sets_.at(set);
    for (const Constraint& one : constraints) {
        table.insert(one.row, {one.start, one.end}, nobody);
    }
    SearchRequest request{trips_[index(robot)].read(robot), table};
    request.limit = limit;
    const SearchEnd end = search_.run(request, is_over);
    // The last one first: of equal starts in a row, the table erases the latest.
    for (std::size_t k = constraints.size(); k-- > 0;) {
        table.erase(constraints[k].row, constraints[k].start, nobody);
    }
    if (end == SearchEnd::stopped) {
        throw Stopped{};
    }
    if (end != SearchEnd::found) {
        return nullptr;
    }
    ConstrainedTrack& track = tracks_.emplace_back();
    search_.track(track.visits);
    track.cost = problem_.weight(robot) * search_.cost();
    book(robot, track);
    bytes_ += sizeof(track) + track.visits.size() * sizeof(Visit) +
              track.bookings.size() * sizeof(RowBooking) + track.moves.size() * sizeof(Move);
    return &track;
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

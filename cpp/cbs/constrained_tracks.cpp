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

ConstrainedTracks::ConstrainedTracks(const Problem& problem, SharedDistances& distances)
    : problem_(problem),
      n_rows_(count_rows(problem)),
      table_(n_rows_),
      search_(problem.roads(), problem.rules()) {
    for (RobotId robot = 0; robot < problem.n_robots(); ++robot) {
        trips_.emplace_back(distances, true);
    }
    const Closures& closed = problem.closures();
    for (std::size_t k = 0; k < closed.row.size(); ++k) {
        table_.insert(closed.row[k], {closed.start[k], closed.end[k]}, nobody);
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
    ++n_searches_;
    const auto constraints = sets_.at(set);
    for (const Constraint& one : constraints) {
        table_.insert(one.row, {one.start, one.end}, nobody);
    }
    const Trip& trip = trips_[index(robot)].read(robot);
    const SearchEnd end = search_.run({trip, table_}, is_over);
    // The last one first: of equal starts in a row, the table erases the latest.
    for (std::size_t k = constraints.size(); k-- > 0;) {
        table_.erase(constraints[k].row, constraints[k].start, nobody);
    }
    if (end == SearchEnd::stopped) {
        throw Stopped{};
    }
    const ConstrainedTrack* track = nullptr;
    if (end == SearchEnd::found) {
        ConstrainedTrack& own = tracks_.emplace_back();
        search_.track(own.visits);
        own.cost = problem_.weight(robot) * search_.cost();
        book(robot, own);
        bytes_ += sizeof(own) + own.visits.size() * sizeof(Visit) +
                  own.bookings.size() * sizeof(RowBooking) + own.moves.size() * sizeof(Move);
        track = &own;
    }
    bytes_ += constraints.size() * sizeof(Constraint) + 64;
    known_.emplace(key, track);
    return track;
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

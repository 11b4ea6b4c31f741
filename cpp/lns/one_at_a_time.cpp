#include "lns/one_at_a_time.hpp"

#include <algorithm>
#include <memory>

namespace rightofway {

OneAtATime::OneAtATime(SharedDistances& distances)
    : distances_(distances),
      problem_(distances.problem()),
      bookings_(problem_.n_rows()),
      search_(problem_.roads(), problem_.rules()),
      reader_(distances),
      tracks_(static_cast<std::size_t>(problem_.n_robots())),
      n_served_(tracks_.size(), 0),
      edge_(tracks_.size(), -1) {
    const Closures& closed = problem_.closures();
    for (std::size_t k = 0; k < closed.row.size(); ++k) {
        bookings_.insert(closed.row[k], {closed.start[k], closed.end[k]}, nobody);
    }
    for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
        tracks_[index(robot)].visits.push_back({0, problem_.home(robot), 0});
        hold(robot, true);
    }
}

SearchEnd OneAtATime::run(const StopCondition& is_over) {
    for (bool has_moved = true; has_moved;) {
        has_moved = false;
        for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
            const std::size_t n_ready = count_ready(robot);
            if (is_done(robot) || (n_ready == 0 && n_served_[index(robot)] < n_stages(robot))) {
                continue;
            }
            const SearchEnd end = move(robot, n_ready, is_over);
            if (end == SearchEnd::stopped) {
                return end;
            }
            has_moved |= end == SearchEnd::found;
        }
    }
    for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
        if (!is_done(robot)) {
            return SearchEnd::proven_none;
        }
    }
    return SearchEnd::found;
}

// The stages at vertices, without the one at which the robot rests.
std::size_t OneAtATime::n_stages(RobotId robot) const {
    return index(problem_.first_stage(robot + 1) - problem_.first_stage(robot)) - 1;
}

VertexId OneAtATime::rest_of(RobotId robot) const {
    const VertexId last = problem_.stage_vertex(problem_.first_stage(robot + 1) - 1);
    return last == none ? place(robot) : last;
}

bool OneAtATime::is_done(RobotId robot) const {
    return n_served_[index(robot)] == n_stages(robot) && place(robot) == rest_of(robot);
}

// The number of stages, from the first one not served on, that wait for no stage of other robots.
std::size_t OneAtATime::count_ready(RobotId robot) const {
    const auto has_ended = [&](std::int32_t stage) {
        const RobotId other = problem_.robot_of(stage);
        return index(stage - problem_.first_stage(other)) < n_served_[index(other)];
    };
    std::size_t n = n_served_[index(robot)];
    for (; n < n_stages(robot); ++n) {
        const auto before =
            problem_.stages_before(problem_.first_stage(robot) + static_cast<std::int32_t>(n));
        if (!std::all_of(before.begin(), before.end(), has_ended)) {
            break;
        }
    }
    return n - n_served_[index(robot)];
}

// A robot that ends anywhere does not come back if it cannot.
SearchEnd OneAtATime::move(RobotId robot, std::size_t n_ready, const StopCondition& is_over) {
    const SearchEnd end = move_to(rest_of(robot), robot, n_ready, is_over);
    const bool ends_anywhere = problem_.stage_vertex(problem_.first_stage(robot + 1) - 1) == none;
    return end == SearchEnd::proven_none && ends_anywhere ? move_to(none, robot, n_ready, is_over)
                                                          : end;
}

SearchEnd OneAtATime::move_to(VertexId rest, RobotId robot, std::size_t n_ready,
                              const StopCondition& is_over) {
    const auto table = distances_.to(rest, robot);  // kept while the search runs
    Trip trip = trip_of(robot, n_ready, rest);
    trip.to_stage.push_back(table->view(distances_.scale(robot)));
    hold(robot, false);
    SearchRequest request{trip, bookings_};
    request.rest_price = 1;
    const SearchEnd end = search_.run(request, is_over);
    if (end == SearchEnd::found) {
        search_.track(found_);
        append(robot);
        n_served_[index(robot)] += n_ready;
        now_ = std::max(now_, search_.completion() + problem_.rules().headway);
    }
    hold(robot, true);
    return end;
}

// The trip from the place of a robot past the next stages to its rest. It begins late enough for
// turns that the robot owes for what it did before.
Trip OneAtATime::trip_of(RobotId robot, std::size_t n_ready, VertexId rest_vertex) {
    Trip trip = reader_.read(robot);
    const auto first = static_cast<std::ptrdiff_t>(n_served_[index(robot)]);
    const auto cut = [&](auto& part, const auto& all, auto rest) {
        part.assign(all.begin() + first,
                    all.begin() + first + static_cast<std::ptrdiff_t>(n_ready));
        part.push_back(rest);
    };
    cut(part_.vertex, trip.stage_vertex, rest_vertex);
    cut(part_.work, trip.stage_work, Tick{0});
    cut(part_.turn, trip.stage_turn, Tick{0});
    cut(part_.earliest, trip.times.earliest, Tick{0});
    cut(part_.latest, trip.times.latest, never);
    trip.home = place(robot);
    trip.to_stage.erase(trip.to_stage.begin(), trip.to_stage.begin() + first);
    trip.to_stage.resize(n_ready);
    Tick owed = 0;
    if (edge_[index(robot)] >= 0) {
        for (const std::int32_t ticks : trip.turns.ticks) {
            owed = std::max<Tick>(owed, ticks);
        }
        trip.turns.first = {};
    }
    if (n_served_[index(robot)] > 0) {
        owed += *std::max_element(trip.stage_turn.begin(), trip.stage_turn.end());
    }
    trip.stage_vertex = part_.vertex;
    trip.stage_work = part_.work;
    trip.stage_turn = part_.turn;
    trip.times.cost = {};
    trip.times.earliest = part_.earliest;
    trip.times.latest = part_.latest;
    trip.times.ready = std::max(problem_.ready(robot), now_ + owed);
    return trip;
}

// Adds the visits found, of which the first is the present one.
void OneAtATime::append(RobotId robot) {
    auto& visits = tracks_[index(robot)].visits;
    const Turns turns = problem_.turns(robot);
    for (std::size_t k = 1; k < found_.size(); ++k) {
        const EdgeId edge = problem_.graph().edge(visits.back().vertex, found_[k].vertex);
        found_[k].turn = turns.between(edge_[index(robot)], edge);
        edge_[index(robot)] = edge;
        visits.push_back(found_[k]);
    }
}

// Books the place of a robot at all times, or takes that back: nothing before the present counts.
void OneAtATime::hold(RobotId robot, bool is_held) {
    const std::int32_t row = problem_.vertex_row(robot, place(robot));
    for (const std::int32_t mark : problem_.excluded(row)) {
        if (is_held) {
            bookings_.insert(mark, {0, never}, robot);
        } else {
            bookings_.erase(mark, 0, robot);
        }
    }
}

}  // namespace rightofway

// A scenario in ticks: the roads, what each robot has to do, and the booking rules.
//
// Every kernel is given one problem. It is immutable, borrows its arrays, and is checked once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/graph.hpp"
#include "core/types.hpp"

namespace rightofway {

// How bookings are made of visits; see conflict.hpp.
struct BookingRules {
    Tick headway = 0;
    bool books_ahead = false;  // a vertex is booked from when the robot starts to drive there
    bool rotations = true;     // three or more robots may move round a circle at one instant
};

// Robot r owns stages first_stage[r] .. first_stage[r + 1] - 1, and drives an edge of class c in
// paces[pace_of[r] * n_classes + c] ticks.
struct ProblemArrays {
    std::span<const EdgeId> indptr;
    std::span<const VertexId> heads;
    std::span<const std::int32_t> length_class;
    std::span<const std::int32_t> paces;
    std::span<const std::int32_t> pace_of;
    std::span<const VertexId> home;
    std::span<const std::int32_t> first_stage;
    std::span<const VertexId> stage_vertex;
    std::span<const Tick> stage_work;
    std::span<const Tick> stage_turn;
    std::int32_t n_classes;
};

// What one robot has to do, and how fast it drives. A visit at a stage's vertex serves it by
// lasting for its work and turning; the last visit of all needs no turning.
struct Itinerary {
    VertexId home = 0;
    std::span<const VertexId> stage_vertex;
    std::span<const Tick> stage_work;
    std::span<const Tick> stage_turn;
    std::span<const std::int32_t> pace;  // ticks for an edge of each length class

    std::size_t n_stages() const { return stage_vertex.size(); }

    // The first stage that is left after a visit, if `stage` was the first before it. A visit
    // serves stages as early as it lasts long enough for them, besides the drive that follows. The
    // last stage is served in the last visit only.
    std::size_t stage_after(std::size_t stage, VertexId vertex, Tick spare) const {
        while (stage + 1 < n_stages() && stage_vertex[stage] == vertex &&
               spare >= stage_work[stage] + stage_turn[stage]) {
            spare -= stage_work[stage] + stage_turn[stage];
            ++stage;
        }
        return stage;
    }

    // From this stage on, all stages are at the last vertex, where no more turning is needed.
    std::size_t first_stage_at_end() const {
        std::size_t first = n_stages() - 1;
        while (first > 0 && stage_vertex[first - 1] == stage_vertex.back()) {
            --first;
        }
        return first;
    }
};

class Problem {
  public:
    // Borrows the arrays. Throws std::invalid_argument where they do not fit together.
    Problem(const ProblemArrays& arrays, const BookingRules& rules);

    const Graph& graph() const { return roads_.graph; }
    const Roads& roads() const { return roads_; }
    const BookingRules& rules() const { return rules_; }
    VertexId n_vertices() const { return graph().n_vertices(); }
    RobotId n_robots() const { return static_cast<RobotId>(arrays_.home.size()); }
    std::size_t n_stages() const { return arrays_.stage_vertex.size(); }

    // Stages are numbered across all robots.
    VertexId home(RobotId robot) const { return arrays_.home[robot]; }
    std::int32_t first_stage(RobotId robot) const { return arrays_.first_stage[robot]; }
    bool is_last(RobotId robot, std::int32_t stage) const {
        return stage + 1 == arrays_.first_stage[robot + 1];
    }
    VertexId stage_vertex(std::int32_t stage) const { return arrays_.stage_vertex[stage]; }
    // Work and turning; a last stage needs no turning.
    Tick stage_dwell(std::int32_t stage) const {
        return arrays_.stage_work[stage] + arrays_.stage_turn[stage];
    }
    Itinerary itinerary(RobotId robot) const;

    // Robots of one pace need the same ticks for every edge.
    std::int32_t pace_of(RobotId robot) const { return arrays_.pace_of[robot]; }
    std::span<const std::int32_t> pace(RobotId robot) const {
        const auto n = static_cast<std::size_t>(arrays_.n_classes);
        return arrays_.paces.subspan(static_cast<std::size_t>(pace_of(robot)) * n, n);
    }
    // The ticks of a robot's quickest edge; 1 where there are no edges.
    Tick quickest_edge(RobotId robot) const;

    // The ticks that a robot drives along an edge.
    std::int32_t drive(RobotId robot, EdgeId edge) const {
        return arrays_.paces[pace_of(robot) * arrays_.n_classes + roads_.length_class[edge]];
    }
    // The same from one vertex to another, -1 where there is no edge.
    std::int32_t drive(RobotId robot, VertexId tail, VertexId head) const {
        const EdgeId edge = graph().edge(tail, head);
        return edge < 0 ? -1 : drive(robot, edge);
    }

    // From when a vertex is left to when a robot that drives there for so long can be there.
    Tick gap(Tick drive_ticks) const {
        return rules_.headway + (rules_.books_ahead ? drive_ticks : 0);
    }
    // Whether a vertex can be entered at the instant at which it is left.
    bool may_follow() const { return rules_.headway == 0 && !rules_.books_ahead; }
    bool may_rotate() const { return rules_.rotations && may_follow(); }

  private:
    void check_robots() const;

    ProblemArrays arrays_;
    Roads roads_;
    BookingRules rules_;
};

// One visit of a track. The next visit's `enter` is when it ends.
struct Visit {
    Tick enter;
    VertexId vertex;
    std::int32_t drive;  // ticks of the edge driven in; 0 for the first visit
};

// The visits of all robots, one robot behind the other.
struct Tracks {
    std::vector<VisitId> first_visit;  // robot r owns first_visit[r] .. [r + 1] - 1
    std::vector<VertexId> vertex;
    std::vector<Tick> enter;
};

}  // namespace rightofway

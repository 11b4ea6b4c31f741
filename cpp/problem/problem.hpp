// A scenario in ticks: roadmap, itineraries and paces of the robots, booking rules.
//
// Searches read one `Problem`. It is immutable, borrows its arrays, and is checked once.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "core/excluded_rows.hpp"
#include "core/graph.hpp"
#include "core/types.hpp"

namespace rightofway {

// The rules that turn visits into bookings; see conflict.hpp.
struct BookingRules {
    Tick headway = 0;
    bool books_ahead = false;  // `occupancy: both`: a booking begins with the drive in
    bool rotations = true;     // three or more robots may rotate at one instant
};

// Robot r has stages first_stage[r] .. first_stage[r + 1] - 1 and drives an edge of length class c
// in paces[pace_of[r] * n_classes + c] ticks; -1: the robot is barred from edges of this class.
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
    std::span<const Tick> surcharges = {};  // per length class: added to costs; empty: all 0
    std::span<const Tick> weight = {};      // per robot: of a tick of it; empty: all 1
};

// Fleets with jobs: when stages may be served, how robots begin and end, and what the ends of
// stages cost. Empty for other fleets. The last stage of a robot that ends anywhere is at `none`,
// without work.
struct WorkArrays {
    std::span<const Tick> earliest;  // per stage: the work begins then or later
    std::span<const Tick> latest;    // per stage: the work ends then or before
    std::span<const Tick> ready;     // per robot: it stays at its home until then
    // Robot r turns in first_turn[first_turn_of[r] + k] ticks before it drives along the k-th edge
    // out of its home; in no time if its list is empty.
    std::span<const std::int32_t> first_turn_of;  // R + 1
    std::span<const std::int32_t> first_turn;
    // The work of stage before[k] ends before that of stage after[k] of another robot begins.
    std::span<const std::int32_t> before;
    std::span<const std::int32_t> after;
    // Per stage: what a tick of its end costs, and a tick of its end after `due` costs more; empty:
    // nothing. Then a tick of completion costs the weight of the robot, and costs are not weighted
    // again.
    std::span<const Tick> cost = {};
    std::span<const Tick> late_cost = {};
    std::span<const Tick> due = {};
    VertexId n_places = 0;  // robots that end anywhere end at a vertex below
};

// Which bookings exclude each other. A *row* is a resource as robots of one size class book it: row
// size * (V + E) + resource; resources are the vertices, then the edges. An edge's list leaves out
// what the lists of its ends hold, because both ends are booked for as long as the edge. Points are
// a class of their own, and their lists need no arrays.
struct Resources {
    std::span<const std::int32_t> size_of;  // size class of each robot; empty: all 0
    ExcludedRows lists = {};
};

// Bookings of nobody: row k of the booking table is closed from start[k] to end[k].
struct Closures {
    std::span<const std::int32_t> row;
    std::span<const Tick> start;
    std::span<const Tick> end;
};

// How long robots turn on the spot between two edges that follow each other; empty where turning
// takes no time. The angle from edge e to edge f is of kind kind[offset[e] + f], and robot r turns
// an angle of kind k in ticks[class_of[r] * n_kinds + k] ticks; in no time if class_of[r] is -1.
struct TurnArrays {
    std::span<const std::int64_t> offset;
    std::span<const std::int32_t> kind;
    std::span<const std::int32_t> class_of;
    std::span<const std::int32_t> ticks;
    std::int32_t n_kinds = 0;
};

// Throws std::invalid_argument if turns do not fit a graph or the number of robots.
void require_turns(const Graph& graph, const TurnArrays& turns, std::size_t n_robots);

// The turns of one robot.
struct Turns {
    // Those of robot r; its arrays fit.
    static Turns of(const TurnArrays& turns, RobotId robot);

    std::span<const std::int64_t> offset;
    std::span<const std::int32_t> kind;
    std::span<const std::int32_t> ticks;       // by kind; empty: turning takes no time
    std::span<const std::int32_t> first = {};  // before the first drive, by edge out of the home
    EdgeId first_edge = 0;                     // out of the home

    bool take_time() const { return !ticks.empty(); }
    // Ticks from the heading of one edge to that of the next; `in` is -1 for the first drive, which
    // turns from the initial heading, if the robot has one.
    std::int32_t between(EdgeId in, EdgeId out) const {
        if (ticks.empty()) {
            return 0;
        }
        if (in < 0) {
            return first.empty() ? 0 : first[index(out - first_edge)];
        }
        return ticks[index(kind[index(offset[index(in)] + out)])];
    }
};

// The part of `WorkArrays` that is of the stages of one robot.
struct StageTimes {
    std::span<const Tick> earliest = {};
    std::span<const Tick> latest = {};
    std::span<const Tick> cost = {};
    std::span<const Tick> late_cost = {};
    std::span<const Tick> due = {};
    std::span<const std::int32_t> n_wanting = {};  // per vertex: robots with a stage there
    Tick ready = 0;
    Tick weight = 1;
    VertexId n_places = 0;

    bool are_known() const { return !earliest.empty(); }
    bool cost_ends() const { return !cost.empty(); }
    Tick cost_of(std::size_t stage, Tick end) const {
        return cost[stage] * end + late_cost[stage] * std::max<Tick>(0, end - due[stage]);
    }
};

// The stages of one robot and its pace. A visit serves a stage if it is at the stage's vertex and
// lasts for work plus turn, besides the turn to the next edge and the drive; the last visit of the
// robot needs no turn. Where stages have times, work waits for its earliest begin, and a visit
// turns once, after the last of its stages.
struct Itinerary {
    VertexId home = 0;
    std::span<const VertexId> stage_vertex;
    std::span<const Tick> stage_work;
    std::span<const Tick> stage_turn;
    std::span<const std::int32_t> pace;  // ticks per edge of each length class; -1: barred
    Turns turns = {};
    std::span<const Tick> surcharges = {};  // of each length class; empty: all 0
    StageTimes times = {};

    std::size_t n_stages() const { return stage_vertex.size(); }
    bool ends_anywhere() const { return stage_vertex.back() == none; }
    // Whether the robot completes with its last work, and then drives to some vertex.
    bool completes_before_end() const { return ends_anywhere() && n_stages() > 1; }

    // When the work of a stage ends if it can begin at `now`; never if that is too late.
    Tick end_of(std::size_t stage, Tick now) const {
        if (!times.are_known()) {
            return now + stage_work[stage];
        }
        const Tick end = std::max(now, times.earliest[stage]) + stage_work[stage];
        return end <= times.latest[stage] ? end : never;
    }

    // Whether other robots have stages at a vertex; only where stages have times.
    bool is_wanted(VertexId vertex) const {
        const bool is_own =
            std::find(stage_vertex.begin(), stage_vertex.end(), vertex) != stage_vertex.end();
        return times.n_wanting[index(vertex)] > (is_own ? 1 : 0);
    }

    // The turn after a stage if the next stage is served as soon as possible.
    Tick turn_after(std::size_t stage) const {
        const bool stays =
            times.are_known() && stage + 1 < n_stages() &&
            (stage_vertex[stage + 1] == stage_vertex[stage] || stage_vertex[stage + 1] == none);
        return stays ? 0 : stage_turn[stage];
    }

    // The first stage not served after a visit, where `stage` is the first not served before it.
    // From `until` on, the visit turns to the next edge and drives. A visit serves as many stages
    // as fit into the time before; only the last visit serves the last stage. Where stages have
    // times, `ends` gets the end of each one served, if it is given.
    std::size_t stage_after(std::size_t stage, VertexId vertex, Tick enter, Tick until,
                            std::vector<Tick>* ends = nullptr) const {
        if (times.are_known()) {
            return stage_after_in_time(stage, vertex, enter, until, ends);
        }
        Tick spare = until - enter;
        while (stage + 1 < n_stages() && stage_vertex[stage] == vertex &&
               spare >= stage_work[stage] + stage_turn[stage]) {
            spare -= stage_work[stage] + stage_turn[stage];
            ++stage;
        }
        return stage;
    }

    std::size_t stage_after_in_time(std::size_t stage, VertexId vertex, Tick enter, Tick until,
                                    std::vector<Tick>* ends) const;

    // The first stage of the final run of stages that are all at the last vertex.
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
    // Borrows the arrays. Throws std::invalid_argument if the arrays do not fit together.
    Problem(const ProblemArrays& arrays, const BookingRules& rules, const Resources& resources = {},
            const TurnArrays& turns = {}, const Closures& closures = {},
            const WorkArrays& work = {});

    const Graph& graph() const { return roads_.graph; }
    const Roads& roads() const { return roads_; }
    const BookingRules& rules() const { return rules_; }
    VertexId n_vertices() const { return graph().n_vertices(); }
    RobotId n_robots() const { return static_cast<RobotId>(arrays_.home.size()); }
    std::size_t n_stages() const { return arrays_.stage_vertex.size(); }

    // Stages of all robots share one numbering.
    VertexId home(RobotId robot) const { return arrays_.home[index(robot)]; }
    std::int32_t first_stage(RobotId robot) const { return arrays_.first_stage[index(robot)]; }
    bool is_last(RobotId robot, std::int32_t stage) const {
        return stage + 1 == arrays_.first_stage[index(robot + 1)];
    }
    VertexId stage_vertex(std::int32_t stage) const { return arrays_.stage_vertex[index(stage)]; }
    Tick stage_work(std::int32_t stage) const { return arrays_.stage_work[index(stage)]; }
    Tick stage_turn(std::int32_t stage) const { return arrays_.stage_turn[index(stage)]; }
    // Work time plus turn of a stage; the last visit of a robot needs no turn.
    Tick stage_dwell(std::int32_t stage) const {
        return arrays_.stage_work[index(stage)] + arrays_.stage_turn[index(stage)];
    }
    Itinerary itinerary(RobotId robot) const;

    // Robots of one pace drive each edge in equal ticks.
    std::int32_t pace_of(RobotId robot) const { return arrays_.pace_of[index(robot)]; }
    std::span<const std::int32_t> pace(RobotId robot) const {
        const auto n = static_cast<std::size_t>(arrays_.n_classes);
        return arrays_.paces.subspan(index(pace_of(robot)) * n, n);
    }
    Turns turns(RobotId robot) const;
    // The ticks of a robot's quickest edge, and of its slowest edge; 1 without an edge.
    Tick quickest_edge(RobotId robot) const;
    Tick slowest_edge(RobotId robot) const;
    // Whether some robot is barred from edges of some class.
    bool is_barred() const { return is_barred_; }

    // What an edge adds to costs.
    Tick surcharge(EdgeId edge) const {
        return arrays_.surcharges.empty()
                   ? 0
                   : arrays_.surcharges[index(roads_.length_class[index(edge)])];
    }
    bool has_surcharges() const { return !arrays_.surcharges.empty(); }
    // How much a tick of a robot's completion time and surcharges counts; 1 where ends of stages
    // cost.
    Tick weight(RobotId robot) const {
        return arrays_.weight.empty() || has_costs() ? 1 : arrays_.weight[index(robot)];
    }
    Tick total_weight() const {
        return arrays_.weight.empty() || has_costs()
                   ? n_robots()
                   : std::accumulate(arrays_.weight.begin(), arrays_.weight.end(), Tick{0});
    }

    // Whether stages have times, robots begin with a state or end anywhere, or stages of two robots
    // follow each other.
    bool has_times() const { return !work_.earliest.empty(); }
    // Whether ends of stages cost.
    bool has_costs() const { return !work_.cost.empty(); }
    const WorkArrays& work() const { return work_; }
    Tick ready(RobotId robot) const { return has_times() ? work_.ready[index(robot)] : 0; }
    RobotId robot_of(std::int32_t stage) const;
    // The stages of other robots that end before a stage begins, and that begin after its end.
    std::span<const std::int32_t> stages_before(std::int32_t stage) const {
        return before_.empty() ? std::span<const std::int32_t>{} : before_[index(stage)];
    }
    std::span<const std::int32_t> stages_after(std::int32_t stage) const {
        return after_.empty() ? std::span<const std::int32_t>{} : after_[index(stage)];
    }
    bool has_arcs() const { return !before_.empty(); }
    // Throws std::invalid_argument if stages have times; `method` does not know them.
    void refuse_times(const char* method) const;

    // Whether lists are given: for robots with a size, and zones. Else robots are points.
    bool has_sizes() const { return !lists_.is_identity(); }
    // Whether drives book edges: where lists are given, or an edge is closed.
    bool books_edges() const { return n_rows_ > n_vertices(); }
    const Closures& closures() const { return closures_; }
    // The rows of all size classes; for points without the edges, unless drives book edges.
    std::int32_t n_rows() const { return n_rows_; }
    std::int32_t first_row(RobotId robot) const {
        return size_of_.empty() ? 0 : size_of_[index(robot)] * n_resources();
    }
    std::int32_t vertex_row(RobotId robot, VertexId vertex) const {
        return first_row(robot) + vertex;
    }
    // Only where drives book edges.
    std::int32_t edge_row(RobotId robot, EdgeId edge) const {
        return first_row(robot) + n_vertices() + edge;
    }
    // Whether a drive along some edge may exclude robots from more than its ends do. If not, no
    // list of excluded rows has a row of an edge.
    bool edges_exclude() const { return edges_exclude_; }
    // Vertices, and edges after them.
    std::int32_t n_resources() const {
        return n_vertices() + static_cast<std::int32_t>(arrays_.heads.size());
    }
    // The rows from which a booking of a row excludes other robots.
    std::span<const std::int32_t> excluded(const std::int32_t& row) const { return lists_.of(row); }
    std::span<const std::int32_t> excluded(std::int32_t&&) const = delete;

    // The ticks of a robot's drive along an edge, -1 if it is barred.
    std::int32_t drive(RobotId robot, EdgeId edge) const {
        return arrays_
            .paces[index(pace_of(robot) * arrays_.n_classes + roads_.length_class[index(edge)])];
    }
    // The ticks of the drive from tail to head, -1 if no edge between them is open to the robot.
    std::int32_t drive(RobotId robot, VertexId tail, VertexId head) const {
        const EdgeId edge = graph().edge(tail, head);
        return edge < 0 ? -1 : drive(robot, edge);
    }

    // Whether an edge from tail to head, which exists, is open to the robot.
    bool may_drive(RobotId robot, VertexId tail, VertexId head) const {
        return !is_barred_ || drive(robot, tail, head) >= 0;
    }

    // How long before its enter a visit books its vertex, after a drive.
    Tick approach(Tick drive_ticks) const { return rules_.books_ahead ? drive_ticks : 0; }
    // The least ticks from the leave of one robot to the enter of the next robot after its drive.
    Tick gap(Tick drive_ticks) const { return rules_.headway + approach(drive_ticks); }
    // Whether a robot can enter a vertex at the instant when another robot leaves it.
    bool may_follow() const { return rules_.headway == 0 && !rules_.books_ahead; }
    bool may_rotate() const { return rules_.rotations && may_follow(); }
    // Whether all robots move in steps of one tick: each drive takes a tick, and nothing else takes
    // time. Then a state of the fleet is the vertex and the stage of each robot.
    bool moves_in_steps() const;

  private:
    void check_robots() const;
    void check_resources();
    void check_closures();
    void check_work();
    void check_ends_anywhere() const;
    void count_wanting();

    ProblemArrays arrays_;
    Roads roads_;
    BookingRules rules_;
    std::span<const std::int32_t> size_of_;
    ExcludedRows lists_;
    TurnArrays turns_;
    Closures closures_;
    WorkArrays work_;
    std::vector<std::vector<std::int32_t>> before_;  // by stage; empty without arcs
    std::vector<std::vector<std::int32_t>> after_;
    std::vector<std::int32_t> n_wanting_;  // by vertex; empty without times
    std::int32_t n_rows_;
    bool edges_exclude_ = false;
    bool is_barred_ = false;
};

// One visit of a track. The visit ends at the `enter` of the next visit.
struct Visit {
    Tick enter;
    VertexId vertex;
    std::int32_t drive;     // ticks of the drive in; 0 for the first visit
    std::int32_t turn = 0;  // ticks of the turn on the spot before that drive
};

// The visits of all robots, concatenated by robot.
struct Tracks {
    std::vector<VisitId> first_visit;  // robot r has first_visit[r] .. [r + 1] - 1
    std::vector<VertexId> vertex;
    std::vector<Tick> enter;
};

}  // namespace rightofway

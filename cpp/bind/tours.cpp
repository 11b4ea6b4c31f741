#include <nanobind/stl/tuple.h>

#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "lns/fleet_search.hpp"
#include "tours/routed_moves.hpp"
#include "tours/tour_search.hpp"

namespace rightofway::bind {
namespace {

constexpr auto tour_robots_doc = R"(The robots of a tour problem, one entry each.

Parameters
----------
travel, battery : int32[R]
    Kind of travel; kind of battery, -1: none.
start, end : int32[R]
    Where it is at `ready`, and where it has to rest; end -1: at its last stop.
ready : int64[R]
    When its tour begins. [ticks]
capacity, load : int32[R]
    The largest load, and what is on board at `ready`.
soc : int64[R]
    The energy of the battery at `ready`.
weight : int64[R]
    Of its completion in the flowtime.)";

constexpr auto tour_jobs_doc = R"(The jobs of a tour problem: what to do, one entry for each stop.

Parameters
----------
first_stop : int32[J + 1]
    Job ``j`` has the stops ``first_stop[j] .. first_stop[j + 1] - 1``, in this order.
place : int32[S]
    Where.
work : int64[S]
    How long. [ticks]
load : int32[S]
    The change of the load.
earliest, latest : int64[S]
    Begin not before; end not after, `NEVER`: at any time. [ticks])";

constexpr auto tour_rules_doc = R"(The jobs of a tour problem: who may do them, and what they cost.

Parameters
----------
weight, release, due : int64[J]
    The service of a job costs its weight for each tick from `release` to its end, and more for ticks
    past `due` (`NEVER`: none). [ticks]
begun_by : int32[J]
    The robot that has begun it, -1: none. These jobs are served before all others.
first_robot, robots : int32[J + 1], int32[n]
    The robots that may and can do a job.
first_after, after : int32[J + 1], int32[n]
    The jobs that end before a job begins.)";

constexpr auto tour_batteries_doc = R"(Kinds of batteries, in whole numbers over one denominator.

Parameters
----------
full, on, work, charge, reserve : int64[B]
    Capacity; use per tick until the robot rests, and per tick of work; gain per tick of a charge;
    what has to be left.
table : int32[B]
    The table of a kind.
drive : int64[T * P * P]
    Use of a drive between two places, apart from `on`, for each table.
to_charging : int64[B * P]
    Least use from a place to a charging place; more than `full` without a way.
first_charging, charging : int32[B + 1], int32[n]
    The charging places of a kind.)";

constexpr auto tour_problem_doc = R"(Jobs and robots for which tours are wanted.

Parameters
----------
n_places : int
    P.
ticks : int32[K * P * P]
    Ticks of drives from place to place, for each kind of travel; -1: no way.
robots, jobs, rules, batteries
    The rest.
objective : TourObjective
    What is minimized after the weight of unserved jobs.
unit, late : int
    Cost of a tick of service, and what a tick past `due` costs more.

Raises
------
ValueError
    For arrays that do not fit.
KernelLimit
    If costs might not fit 64 bits.)";

constexpr auto tour_search_doc = R"(Search for tours; the best ones can be read between calls.

They depend on the seed and the steps alone. Ctrl-C leaves the best tours as they were.

Parameters
----------
problem : TourProblem
    Jobs and robots.
seed : int
    For all that is drawn.)";

constexpr auto tour_start_doc = R"(Insert jobs as they are in these tours, where that is feasible.

Parameters
----------
first : int32[R + 1]
    Robot ``r`` has the stops ``first[r] .. first[r + 1] - 1``.
stops : int32[n]
    Indices of stops of all jobs.)";

constexpr auto tour_construct_doc =
    R"(Insert unserved jobs by regret; return whether that was done in time.

Parameters
----------
time_limit : float or None
    When to stop. [s])";

constexpr auto tour_improve_doc =
    R"(Do steps of large neighbourhood search; return how many were done.

Parameters
----------
n_steps : int
    The most steps.
time_limit : float or None
    When to stop. [s])";

constexpr auto tour_tours_doc = R"(Return the best tours: stops and charges.

Returns
-------
tuple of (int32[R + 1], int32[N], int32[N], int64[N], int64[N])
    The items of each robot; the stop of each (-1: a charge); its place, its begin and its ticks.)";

constexpr auto tour_unserved_doc =
    R"(Return the jobs without a tour and the reasons, as `UnservedReason`.

Returns
-------
tuple of (int32[n], int32[n])
    In the order of jobs.)";

constexpr auto tour_compare_doc =
    R"(Return the objective with a job at its best place in the best tour of each robot.

The job is in no other tour, and the jobs that come after it are in none.

Parameters
----------
job : int
    The job.

Returns
-------
int64[R + 1]
    `NEVER` where the job does not fit; the last is the objective without the job.)";

constexpr auto tour_cost_doc = R"(Return what the best tours cost; compared from left to right.

Returns
-------
tuple of (int, int, int, int)
    Begun jobs without a tour, the weight of other unserved jobs, the objective, the flowtime.)";

constexpr auto routed_moves_doc =
    R"(Local search over tours and routes together: moves of few jobs, judged by planned cost.

The best tours of the search become those of the moves that are accepted.

Parameters
----------
fleet : FleetSearch
    All robots have tracks; its problem has times, but no arcs.
tours : TourSearch
    Its best tours are those of the tracks.
vertex_of : int32[P]
    Of each place.
turn_of : int64[R]
    After a stop. [ticks]
stops : int32[S]
    The stop of each stage of the problem; a charge or the last stage is -1.
ends, completions : int64[S], int64[R]
    When the work of each stage ends, and when each robot completes. [ticks]
cost, late_cost : int64[J]
    What a tick of the end of each job costs in searches, also after `due`; empty for objectives
    without service.
seed : int
    For all that is drawn.

Raises
------
ValueError
    If the arrays do not fit.)";

constexpr auto moves_run_doc =
    R"(Try moves until the end of a cycle of annealing, and return how many.

Parameters
----------
n_moves, most_gains : int
    The most moves, and gains.
time_limit : float or None
    When to stop; at once for 0 or less. [s])";

constexpr auto moves_tracks_doc = R"(Return the tracks of the best plan.

Returns
-------
tuple of (int32[R + 1], int32[N], int64[N])
    Where the visits of each robot begin; their vertices; when they begin. [ticks])";

constexpr auto moves_items_doc = R"(Return the items of the tours that have changed.

Returns
-------
tuple of (int32[n], int32[n + 1], int32[N], int32[N], int64[N])
    The robots; where the items of each begin; the stop of each (-1: a charge), its vertex and its
    ticks.)";

// Copies of arrays would be made by the problem anyway: these objects keep the arrays.
struct BoundTourRobots {
    ArrayIn<std::int32_t> travel;
    ArrayIn<std::int32_t> battery;
    ArrayIn<std::int32_t> start;
    ArrayIn<std::int32_t> end;
    ArrayIn<Tick> ready;
    ArrayIn<std::int32_t> capacity;
    ArrayIn<std::int32_t> load;
    ArrayIn<std::int64_t> soc;
    ArrayIn<std::int64_t> weight;
};

struct BoundTourJobs {
    ArrayIn<std::int32_t> first_stop;
    ArrayIn<std::int32_t> place;
    ArrayIn<Tick> work;
    ArrayIn<std::int32_t> load;
    ArrayIn<Tick> earliest;
    ArrayIn<Tick> latest;
};

struct BoundTourRules {
    ArrayIn<std::int64_t> weight;
    ArrayIn<Tick> release;
    ArrayIn<Tick> due;
    ArrayIn<std::int32_t> begun_by;
    ArrayIn<std::int32_t> first_robot;
    ArrayIn<std::int32_t> robots;
    ArrayIn<std::int32_t> first_after;
    ArrayIn<std::int32_t> after;
};

struct BoundTourBatteries {
    ArrayIn<std::int64_t> full;
    ArrayIn<std::int64_t> on;
    ArrayIn<std::int64_t> work;
    ArrayIn<std::int64_t> charge;
    ArrayIn<std::int64_t> reserve;
    ArrayIn<std::int32_t> table;
    ArrayIn<std::int64_t> drive;
    ArrayIn<std::int64_t> to_charging;
    ArrayIn<std::int32_t> first_charging;
    ArrayIn<std::int32_t> charging;
};

void init_tour_problem(TourProblem* self, std::int32_t n_places, const ArrayIn<std::int32_t>& ticks,
                       const BoundTourRobots& robots, const BoundTourJobs& jobs,
                       const BoundTourRules& rules, const BoundTourBatteries& batteries,
                       TourObjective objective, std::int64_t unit, std::int64_t late) {
    new (self) TourProblem(
        {n_places, view(ticks)},
        {view(robots.travel), view(robots.battery), view(robots.start), view(robots.end),
         view(robots.ready), view(robots.capacity), view(robots.load), view(robots.soc),
         view(robots.weight)},
        {view(jobs.first_stop), view(jobs.place), view(jobs.work), view(jobs.load),
         view(jobs.earliest), view(jobs.latest), view(rules.weight), view(rules.release),
         view(rules.due), view(rules.begun_by), view(rules.first_robot), view(rules.robots),
         view(rules.first_after), view(rules.after)},
        {view(batteries.full), view(batteries.on), view(batteries.work), view(batteries.charge),
         view(batteries.reserve), view(batteries.table), view(batteries.drive),
         view(batteries.to_charging), view(batteries.first_charging), view(batteries.charging)},
        objective, unit, late);
}

using TourItems = std::tuple<ArrayOut<std::int32_t>, ArrayOut<std::int32_t>, ArrayOut<std::int32_t>,
                             ArrayOut<Tick>, ArrayOut<Tick>>;
using MovedItems = std::tuple<ArrayOut<std::int32_t>, ArrayOut<std::int32_t>,
                              ArrayOut<std::int32_t>, ArrayOut<VertexId>, ArrayOut<Tick>>;

TourItems list_items(const TourSearch& self, const TourProblem& problem) {
    std::vector<std::int32_t> first{0};
    std::vector<std::int32_t> stops;
    std::vector<std::int32_t> places;
    std::vector<Tick> begins;
    std::vector<Tick> ticks;
    for (std::size_t r = 0; r < problem.n_robots(); ++r) {
        const Tour& tour = self.best().tour(static_cast<RobotId>(r));
        const TourTimes& times = tour.times();
        auto charge = times.charges.begin();
        for (std::size_t k = 0; k <= tour.size(); ++k) {
            for (; charge != times.charges.end() && index(charge->gap) == k; ++charge) {
                stops.push_back(none);
                places.push_back(charge->place);
                begins.push_back(charge->begin);
                ticks.push_back(charge->ticks);
            }
            if (k < tour.size()) {
                stops.push_back(tour.stops()[k]);
                places.push_back(problem.stop(tour.stops()[k]).place);
                begins.push_back(times.begin[k]);
                ticks.push_back(times.end[k] - times.begin[k]);
            }
        }
        first.push_back(static_cast<std::int32_t>(stops.size()));
    }
    return {to_numpy(std::move(first)), to_numpy(std::move(stops)), to_numpy(std::move(places)),
            to_numpy(std::move(begins)), to_numpy(std::move(ticks))};
}

std::tuple<ArrayOut<std::int32_t>, ArrayOut<std::int32_t>> list_unserved(TourSearch& self,
                                                                         std::size_t n_jobs) {
    std::vector<std::int32_t> jobs;
    std::vector<std::int32_t> reasons;
    for (std::int32_t job = 0; index(job) < n_jobs; ++job) {
        if (!self.best().serves(job)) {
            jobs.push_back(job);
            reasons.push_back(static_cast<std::int32_t>(self.explain(job)));
        }
    }
    return {to_numpy(std::move(jobs)), to_numpy(std::move(reasons))};
}

ArrayOut<std::int64_t> compare_robots(TourSearch& self, std::int32_t job) {
    const std::vector<std::int32_t> jobs{job};
    require_ids("job", jobs, static_cast<std::int32_t>(self.problem().n_jobs()));
    std::vector<std::int64_t> values;
    for (const auto& value : self.compare_robots(job)) {
        values.push_back(value.value_or(never));
    }
    return to_numpy(std::move(values));
}

void init_moves(RoutedMoves* self, const FleetSearch& fleet, TourSearch& tours,
                const ArrayIn<VertexId>& vertex_of, const ArrayIn<Tick>& turn_of,
                const ArrayIn<std::int32_t>& stops, const ArrayIn<Tick>& ends,
                const ArrayIn<Tick>& completions, const ArrayIn<Tick>& cost,
                const ArrayIn<Tick>& late_cost, std::uint64_t seed) {
    new (self) RoutedMoves(fleet, tours,
                           {view(vertex_of), view(turn_of), view(stops), view(ends),
                            view(completions), view(cost), view(late_cost)},
                           seed);
}

MovedItems list_moved(const RoutedMoves& self, std::size_t n_robots) {
    std::vector<std::int32_t> robots;
    std::vector<std::int32_t> first{0};
    std::vector<std::int32_t> stops;
    std::vector<VertexId> vertices;
    std::vector<Tick> ticks;
    for (std::size_t r = 0; r < n_robots; ++r) {
        const auto robot = static_cast<RobotId>(r);
        if (!self.has_changed(robot)) {
            continue;
        }
        const RoutedMoves::Items items = self.items(robot);
        robots.push_back(robot);
        stops.insert(stops.end(), items.stops.begin(), items.stops.end());
        vertices.insert(vertices.end(), items.vertices.begin(), items.vertices.end());
        ticks.insert(ticks.end(), items.ticks.begin(), items.ticks.end());
        first.push_back(static_cast<std::int32_t>(stops.size()));
    }
    return {to_numpy(std::move(robots)), to_numpy(std::move(first)), to_numpy(std::move(stops)),
            to_numpy(std::move(vertices)), to_numpy(std::move(ticks))};
}

void bind_routed_moves(nb::module_& module) {
    nb::class_<RoutedMoves>(module, "RoutedMoves", routed_moves_doc)
        .def("__init__", &init_moves, nb::arg("fleet"), nb::arg("tours"), array("vertex_of"),
             array("turn_of"), array("stops"), array("ends"), array("completions"), array("cost"),
             array("late_cost"), nb::arg("seed"), nb::keep_alive<1, 2>(), nb::keep_alive<1, 3>())
        .def(
            "run",
            [](RoutedMoves& self, std::int64_t n_moves, std::int64_t most_gains,
               std::optional<double> time_limit) {
                const Deadline deadline(time_limit);
                const nb::gil_scoped_release released;
                const std::int64_t done = self.run(n_moves, most_gains, deadline);
                self.finish();
                return done;
            },
            nb::arg("n_moves"), nb::arg("most_gains"), nb::arg("time_limit").none() = nb::none(),
            moves_run_doc)
        .def_prop_ro("n_gains", &RoutedMoves::n_gains, "How many moves have made the plan better.")
        .def(
            "tracks",
            [](const RoutedMoves& self) {
                Tracks all = self.tracks();
                return std::tuple(to_numpy(std::move(all.first_visit)),
                                  to_numpy(std::move(all.vertex)), to_numpy(std::move(all.enter)));
            },
            moves_tracks_doc)
        .def(
            "items", [](const RoutedMoves& self) { return list_moved(self, self.n_robots()); },
            moves_items_doc);
}

void bind_tour_input(nb::module_& module) {
    using Ids = ArrayIn<std::int32_t>;
    using Wholes = ArrayIn<std::int64_t>;
    nb::class_<BoundTourRobots>(module, "TourRobots", tour_robots_doc)
        .def(nb::init<Ids, Ids, Ids, Ids, Wholes, Ids, Ids, Wholes, Wholes>(), array("travel"),
             array("battery"), array("start"), array("end"), array("ready"), array("capacity"),
             array("load"), array("soc"), array("weight"));
    nb::class_<BoundTourJobs>(module, "TourJobs", tour_jobs_doc)
        .def(nb::init<Ids, Ids, Wholes, Ids, Wholes, Wholes>(), array("first_stop"), array("place"),
             array("work"), array("load"), array("earliest"), array("latest"));
    nb::class_<BoundTourRules>(module, "TourRules", tour_rules_doc)
        .def(nb::init<Wholes, Wholes, Wholes, Ids, Ids, Ids, Ids, Ids>(), array("weight"),
             array("release"), array("due"), array("begun_by"), array("first_robot"),
             array("robots"), array("first_after"), array("after"));
    nb::class_<BoundTourBatteries>(module, "TourBatteries", tour_batteries_doc)
        .def(nb::init<Wholes, Wholes, Wholes, Wholes, Wholes, Ids, Wholes, Wholes, Ids, Ids>(),
             array("full"), array("on"), array("work"), array("charge"), array("reserve"),
             array("table"), array("drive"), array("to_charging"), array("first_charging"),
             array("charging"));
}

}  // namespace

void bind_tours(nb::module_& module) {
    nb::enum_<TourObjective>(module, "TourObjective", "What tours minimize.")
        .value("service", TourObjective::service, "Service times and lateness by weights of jobs.")
        .value("flowtime", TourObjective::flowtime, "The flowtime by weights of robots.")
        .value("makespan", TourObjective::makespan, "The makespan; on ties the flowtime.")
        .value("both", TourObjective::both, "Makespan plus completion, summed by weights.");
    nb::enum_<UnservedReason>(module, "UnservedReason", "Why no tour serves a job.",
                              nb::is_arithmetic())
        .value("robot", UnservedReason::robot, "No robot may or can carry it.")
        .value("way", UnservedReason::way, "No robot has a way to its stops.")
        .value("latest", UnservedReason::latest, "No robot can be in time, even alone.")
        .value("battery", UnservedReason::battery, "No battery lasts.")
        .value("after", UnservedReason::after, "A job before it is unserved.")
        .value("not_found", UnservedReason::not_found, "The search has found no place for it.");
    bind_tour_input(module);
    nb::class_<TourProblem>(module, "TourProblem", tour_problem_doc)
        .def("__init__", &init_tour_problem, nb::arg("n_places"), array("ticks"), nb::arg("robots"),
             nb::arg("jobs"), nb::arg("rules"), nb::arg("batteries"), nb::arg("objective"),
             nb::arg("unit"), nb::arg("late"))
        .def_prop_ro("n_jobs", &TourProblem::n_jobs, "The number of jobs.");
    nb::class_<TourSearch>(module, "TourSearch", tour_search_doc)
        .def(nb::init<const TourProblem&, std::uint64_t>(), nb::arg("problem"), nb::arg("seed"),
             nb::keep_alive<1, 2>())
        .def(
            "start",
            [](TourSearch& self, const ArrayIn<std::int32_t>& first,
               const ArrayIn<std::int32_t>& stops) {
                const nb::gil_scoped_release released;
                self.start(view(first), view(stops));
            },
            array("first"), array("stops"), tour_start_doc)
        .def(
            "construct",
            [](TourSearch& self, std::optional<double> time_limit) {
                const Deadline deadline(time_limit);
                const nb::gil_scoped_release released;
                return self.construct(deadline);
            },
            nb::arg("time_limit").none() = nb::none(), tour_construct_doc)
        .def(
            "improve",
            [](TourSearch& self, std::int64_t n_steps, std::optional<double> time_limit) {
                const Deadline deadline(time_limit);
                const nb::gil_scoped_release released;
                return self.improve(n_steps, deadline);
            },
            nb::arg("n_steps"), nb::arg("time_limit").none() = nb::none(), tour_improve_doc)
        .def(
            "tours", [](const TourSearch& self) { return list_items(self, self.problem()); },
            tour_tours_doc)
        .def(
            "unserved",
            [](TourSearch& self) { return list_unserved(self, self.problem().n_jobs()); },
            tour_unserved_doc)
        .def("compare_robots", &compare_robots, nb::arg("job"), tour_compare_doc)
        .def_prop_ro(
            "cost",
            [](const TourSearch& self) {
                const TourCost cost = self.best().cost();
                return std::tuple(cost.n_missing, cost.unserved, cost.value, cost.flowtime);
            },
            tour_cost_doc);
    bind_routed_moves(module);
}

}  // namespace rightofway::bind

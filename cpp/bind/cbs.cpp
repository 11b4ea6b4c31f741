#include "cbs/cbs.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "cbs/fewest_actions.hpp"
#include "core/reject.hpp"
#include "distances/shared_distances.hpp"
#include "lns/fleet_search.hpp"

namespace rightofway::bind {
namespace {

constexpr auto cbs_doc = R"(Conflict-based search for a plan of least cost, with its proof.

Parameters
----------
problem : Problem
    What the fleet has to do.
cardinal : bool
    Whether conflicts that cost both robots something are resolved first.
bypass : bool
    Whether tracks of equal cost with fewer conflicts replace others without a split.
clear : bool
    Whether tracks with the fewest conflicts are looked for.
targets : bool
    Whether conflicts with robots that have reached their ends are resolved as such.
disjoint : bool
    Whether one child of a conflict holds a robot to where it is, and the other keeps it away.
pairs : bool
    Whether nodes are split by the completion times of pairs that lose to each other.
pair_nodes : int
    Nodes at most to solve each pair of robots, whose losses raise the bounds of nodes; 0: none.
joint_states : int
    Joint states at most, and again for each fifty nodes, for all pairs that need more nodes; and for
    each fifty nodes for a whole fleet of few robots. 0: no such search.
factor : int
    A plan that costs at most this factor times the bound is enough, 1 or more. [millionths]
latest : int
    No robot completes later, NEVER for no limit; only without surcharges. [ticks])";

constexpr auto run_search_doc = R"(Search on; the search can be continued.

Parameters
----------
upper : int
    The cost of a plan that is known, NEVER for none: nothing of this cost or more is looked for.
    The same in each call. [ticks]
enough : int
    Stop as soon as the bound is this or more. [ticks]
most_nodes : int
    Stop after this number of nodes.
most_bytes : int
    Stop where nodes and tracks take more memory, about. [bytes]
time_limit : float or None
    When to stop; at once for 0 or less. [s]

Returns
-------
tuple of (int, int)
    How it ended (0: a plan within the factor, 1: proven that none costs less than `upper`, 2: stopped),
    and the proven bound, NEVER where no plan exists. [ticks])";

constexpr auto together_doc = R"(Search the joint states of some robots, alone on the roads.

Parameters
----------
robots : int32[K]
    Different robots.
most_states : int
    Stop after this number of states.
time_limit : float or None
    When to stop; at once for 0 or less. [s]

Returns
-------
tuple of (int, int, int32[K + 1], int32[N], int64[N])
    How it ended, as for `run`; the proven bound of the sum of their costs, NEVER where no plan
    exists in which none of them completes later than `latest` [ticks]; and the tracks of a plan of
    that cost, as of `tracks`, of no robot where the search did not find one.)";

constexpr auto actions_doc =
    R"(Take tracks of no higher cost with which robots wait and drive less often.

Parameters
----------
problem : Problem
    What the fleet has to do.
first_visit, vertices, enter : int32[R + 1], int32[N], int64[N]
    Which visits each robot has, and where and when they begin; they keep the rules. [ticks]
waits : int64[R]
    How many visits of each robot last longer than it needs.
latest : int
    No robot completes later, NEVER for no limit. [ticks]
most_states : int
    End each search after this number of states.
time_limit : float or None
    When to stop; at once for 0 or less. [s]

Returns
-------
tuple of (bool, int32[R + 1], int32[N], int64[N])
    Whether it is proven that no plan of no higher cost has fewer drives and waits; the tracks.)";

constexpr auto tracks_doc = R"(Return the tracks of the plan found, of no robot before.

Returns
-------
tuple of (int32[R + 1], int32[N], int64[N])
    Which visits each robot has, and where and when they begin. [ticks])";

Tracks join(const std::vector<const ConstrainedTrack*>& of_robots) {
    Tracks tracks{{0}, {}, {}};
    for (const ConstrainedTrack* track : of_robots) {
        for (const Visit& visit : track->visits) {
            tracks.vertex.push_back(visit.vertex);
            tracks.enter.push_back(visit.enter);
        }
        tracks.first_visit.push_back(static_cast<VisitId>(tracks.vertex.size()));
    }
    return tracks;
}

class ConflictBasedSearch {
  public:
    ConflictBasedSearch(const Problem& problem, const CbsOptions& options)
        : problem_(problem),
          distances_(problem),
          tracks_(problem, distances_),
          losses_(tracks_, options),
          latest_(options.latest),
          tree_(tracks_, all(problem), options, options.pair_nodes > 0 ? &losses_ : nullptr) {}

    SearchEnd run(Tick upper, Tick enough, std::int64_t most_nodes, std::size_t most_bytes,
                  const Deadline& deadline) {
        const StopCondition is_over = [&] {
            return tracks_.bytes() + tree_.bytes() > most_bytes || deadline();
        };
        try {
            if (!has_started_) {
                const std::vector<SetId> sets(static_cast<std::size_t>(problem_.n_robots()),
                                              ConstraintSets::empty);
                if (!tree_.start(sets, is_over)) {
                    return SearchEnd::proven_none;
                }
                has_started_ = true;
            }
            return tree_.run(upper, enough, most_nodes, is_over);
        } catch (const Stopped&) {
            return SearchEnd::stopped;
        }
    }

    JointPlan together(const std::vector<RobotId>& robots, std::int64_t most_states,
                       const Deadline& deadline) {
        const std::vector<SetId> sets(robots.size(), ConstraintSets::empty);
        std::vector<Tick> most;
        for (std::size_t k = 0; k < robots.size() && latest_ < never; ++k) {
            most.push_back(problem_.weight(robots[k]) * latest_);
        }
        try {
            return tracks_.together(robots, sets, most, most_states, [&] { return deadline(); });
        } catch (const Stopped&) {
            return {};
        }
    }

    const Problem& problem() const { return problem_; }
    Tick bound() const { return tree_.bound(); }
    std::int64_t n_nodes() const { return tree_.n_nodes(); }
    std::int64_t n_searches() const { return tracks_.n_searches(); }

    Tracks tracks() const { return join(tree_.tracks()); }

  private:
    static std::vector<RobotId> all(const Problem& problem) {
        std::vector<RobotId> robots;
        for (RobotId robot = 0; robot < problem.n_robots(); ++robot) {
            robots.push_back(robot);
        }
        return robots;
    }

    const Problem& problem_;
    SharedDistances distances_;
    ConstrainedTracks tracks_;
    PairLosses losses_;
    Tick latest_;
    ConflictTree tree_;
    bool has_started_ = false;
};

std::tuple<int, Tick> run(ConflictBasedSearch& self, Tick upper, Tick enough,
                          std::int64_t most_nodes, std::int64_t most_bytes,
                          std::optional<double> time_limit) {
    require_range("upper", upper, 0, never);
    require_range("enough", enough, 0, never);
    require_range("most_nodes", most_nodes, 0, never);
    require_range("most_bytes", most_bytes, 0, never);
    const Deadline deadline(time_limit);
    const nb::gil_scoped_release released;
    const SearchEnd end =
        self.run(upper, enough, most_nodes, static_cast<std::size_t>(most_bytes), deadline);
    return {static_cast<int>(end), self.bound()};
}

using TracksOut = std::tuple<ArrayOut<VisitId>, ArrayOut<VertexId>, ArrayOut<Tick>>;

TracksOut to_arrays(Tracks&& tracks) {
    return {to_numpy(std::move(tracks.first_visit)), to_numpy(std::move(tracks.vertex)),
            to_numpy(std::move(tracks.enter))};
}

using Together = std::tuple<int, Tick, ArrayOut<VisitId>, ArrayOut<VertexId>, ArrayOut<Tick>>;

Together together(ConflictBasedSearch& self, const ArrayIn<RobotId>& robots,
                  std::int64_t most_states, std::optional<double> time_limit) {
    require_ids("robots", view(robots), self.problem().n_robots());
    std::vector<RobotId> group;
    for (const RobotId robot : view(robots)) {
        if (std::find(group.begin(), group.end(), robot) != group.end()) {
            reject_entry("robots", group.size(), robot, "is given twice");
        }
        group.push_back(robot);
    }
    require_range("most_states", most_states, 0, never);
    const Deadline deadline(time_limit);
    JointPlan plan;
    {
        const nb::gil_scoped_release released;
        plan = self.together(group, most_states, deadline);
    }
    return std::tuple_cat(std::tuple(static_cast<int>(plan.end), plan.bound),
                          to_arrays(join(plan.tracks)));
}

using FewerActions = std::tuple<bool, ArrayOut<VisitId>, ArrayOut<VertexId>, ArrayOut<Tick>>;

FewerActions fewest_actions(const Problem& problem, const ArrayIn<std::int32_t>& first_visit,
                            const ArrayIn<VertexId>& vertices, const ArrayIn<Tick>& enter,
                            const ArrayIn<Tick>& waits, Tick latest, std::int64_t most_states,
                            std::optional<double> time_limit) {
    problem.refuse_times("fewest_actions");
    const auto n_robots = static_cast<std::size_t>(problem.n_robots());
    require_length("waits", waits.size(), n_robots);
    require_ranges("waits", view(waits), 0, never);
    require_range("latest", latest, 0, never);
    require_range("most_states", most_states, 0, never);
    const Deadline deadline(time_limit);
    bool is_fewest = false;
    Tracks tracks;
    {
        const nb::gil_scoped_release released;
        FleetSearch given(problem, 0, 1);  // knows how to check tracks
        given.start({view(first_visit), view(vertices), view(enter)});
        FleetPlan plan = given.plan();
        for (RobotId robot = 0; robot < problem.n_robots(); ++robot) {
            if (!plan.has_track(robot)) {
                reject("robot", robot, "has an empty track");
            }
        }
        SharedDistances distances(problem);
        std::vector<Tick> counts(waits.data(), waits.data() + n_robots);
        is_fewest = take_fewest_actions(distances, plan, counts, latest, most_states,
                                        [&] { return deadline(); });
        tracks = plan.tracks();
    }
    return std::tuple_cat(std::tuple(is_fewest), to_arrays(std::move(tracks)));
}

}  // namespace

void bind_cbs(nb::module_& module) {
    module.def("fewest_actions", &fewest_actions, nb::arg("problem"), array("first_visit"),
               array("vertices"), array("enter"), array("waits"), nb::arg("latest"),
               nb::arg("most_states"), nb::arg("time_limit").none(), actions_doc);
    nb::class_<ConflictBasedSearch>(module, "ConflictBasedSearch", cbs_doc)
        .def(
            "__init__",
            [](ConflictBasedSearch* self, const Problem& problem, bool cardinal, bool bypass,
               bool clear, bool targets, bool disjoint, bool pairs, std::int64_t pair_nodes,
               std::int64_t joint_states, std::int64_t factor, Tick latest) {
                require_range("pair_nodes", pair_nodes, 0, never);
                require_range("joint_states", joint_states, 0, never);
                require_range("factor", factor, 1'000'000, Tick{1} << 40);
                if (latest < 0 || (latest >= Tick{1} << 40 && latest != never)) {
                    reject("latest", latest, "is negative or too late");
                }
                if (latest != never && problem.has_surcharges()) {
                    throw std::invalid_argument("latest: costs have surcharges");
                }
                new (self)
                    ConflictBasedSearch(problem, {cardinal, bypass, clear, targets, disjoint, pairs,
                                                  pair_nodes, joint_states, factor, latest});
            },
            nb::arg("problem"), nb::arg("cardinal"), nb::arg("bypass"), nb::arg("clear"),
            nb::arg("targets"), nb::arg("disjoint"), nb::arg("pairs"), nb::arg("pair_nodes"),
            nb::arg("joint_states"), nb::arg("factor"), nb::arg("latest"), nb::keep_alive<1, 2>())
        .def("run", &run, nb::arg("upper"), nb::arg("enough"), nb::arg("most_nodes"),
             nb::arg("most_bytes"), nb::arg("time_limit").none(), run_search_doc)
        .def("search_together", &together, array("robots"), nb::arg("most_states"),
             nb::arg("time_limit").none(), together_doc)
        .def(
            "tracks", [](const ConflictBasedSearch& self) { return to_arrays(self.tracks()); },
            tracks_doc)
        .def_prop_ro("n_nodes", &ConflictBasedSearch::n_nodes, "The number of nodes expanded.")
        .def_prop_ro("n_searches", &ConflictBasedSearch::n_searches,
                     "The number of searches for the track of one robot.");
}

}  // namespace rightofway::bind

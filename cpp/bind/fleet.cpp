#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <thread>
#include <tuple>
#include <vector>

#include "bindings.hpp"
#include "core/reject.hpp"
#include "lns/population.hpp"
#include "lns/prioritized.hpp"

namespace rightofway::bind {
namespace {

constexpr auto class_doc = R"(The tracks of a whole fleet: finding first ones, and better ones.

The seed decides all that is drawn; what `improve` finds does not depend on ``n_threads``. Robots
without a track are left where they are by `tracks`: an empty one. Ctrl-C leaves a plan as good as
before.)";

constexpr auto alone_doc =
    R"(Return the least completion of each robot without the others, int64[R]. [ticks]

-1 for a robot that cannot get to a stage; None if time ran out.)";

constexpr auto start_doc =
    R"(Take over tracks: where each robot's visits begin, int32[R + 1], their vertices and enters.

A robot may have none: an empty track. ValueError if the others are no tracks of these trips, or
overlap.)";

constexpr auto prioritize_doc =
    R"(Give the robots tracks one after another, in this order; return whether all have one now.

Gives up after ``n_searches`` or the time limit; after ``with_net`` seconds instead, once there is
a plan made in haste. `go_on` may change a False.)";

constexpr auto restore_doc =
    R"(Give robots these tracks, as for `start`, where that costs no more; return how many have theirs.

Every robot has a track, and the tracks given keep the rules. `improve` starts afresh.)";

constexpr auto repair_doc =
    R"(Give tracks to robots that have none, in this order; return whether all have one now.

Robots that have a track keep it, unless they are in the way: they lose it, and queue again.)";

constexpr auto go_on_doc = R"(Continue `prioritize`; ``n_searches`` counts since its beginning.)";

constexpr auto improve_doc =
    R"(Replace tracks by better ones, a few robots at a time; return how many times that was done.

Every robot has a track. A plan that is stuck becomes one of several, which are crossed with each
other. Ends when nothing can be better, after ``n_tasks``, after ``patience`` tasks in a row without
a gain, at once after the time limit, and after ``pause`` seconds at the next point that does not
depend on clocks.)";

constexpr auto retime_doc =
    R"(Have all robots as early as the order of visits at every vertex allows; `improve` starts afresh.)";

using TrackArrays = std::tuple<ArrayOut<std::int32_t>, ArrayOut<VertexId>, ArrayOut<Tick>>;

struct GivenTracks {
    std::span<const std::int32_t> first_visit;
    std::span<const VertexId> vertices;
    std::span<const Tick> enter;
};

class FleetSearch {
  public:
    FleetSearch(const Problem& problem, std::uint64_t seed, std::size_t n_threads)
        : problem_(problem),
          distances_(problem),
          plan_(problem),
          seed_(seed),
          n_threads_(n_threads) {}

    // Empty if there was no time.
    const std::vector<Tick>& alone(const StopCondition& deadline) {
        if (alone_.empty()) {
            std::vector<Tick> alone(static_cast<std::size_t>(problem_.n_robots()));
            for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
                if (robot % 64 == 0 && deadline()) {
                    return alone_;
                }
                alone[static_cast<std::size_t>(robot)] = distances_.alone(robot);
            }
            alone_ = std::move(alone);
            bound_ = std::accumulate(alone_.begin(), alone_.end(), Tick{0});
        }
        return alone_;
    }

    void take_alone(std::span<const Tick> alone) { distances_.take_alone(alone); }

    bool prioritize(std::span<const RobotId> order, std::int64_t n_searches,
                    const StopCondition& deadline, const StopCondition& with_net) {
        clear();
        in_turn_.emplace(distances_, plan_, order);
        return go_on(n_searches, deadline, with_net);
    }

    bool repair(std::span<const RobotId> order, std::int64_t n_searches,
                const StopCondition& deadline) {
        Prioritized planner(distances_, plan_);
        planner.start(order);
        return planner.run(n_searches, deadline) == SearchEnd::found;
    }

    bool go_on(std::int64_t n_searches, const StopCondition& deadline,
               const StopCondition& with_net) {
        if (!in_turn_ || !in_turn_->run(n_searches, n_threads_ > 1, deadline, with_net)) {
            return false;
        }
        in_turn_.reset();
        return true;
    }

    void start(const GivenTracks& given) {
        clear();
        for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
            if (given.first_visit[robot] == given.first_visit[robot + 1]) {
                continue;
            }
            TimedTrack track = track_of(robot, given);
            if (track.cost < 0 || !plan_.fits(robot, track)) {
                clear();
                reject("robot", robot, "has a track that breaks the rules");
            }
            plan_.exchange(robot, track);
        }
    }

    // The given tracks do not conflict with each other. So a robot can have its track again if all
    // robots in the way of it have theirs, and those in the way of these, and so on.
    std::int64_t restore(const GivenTracks& given) {
        const auto n_robots = static_cast<std::size_t>(problem_.n_robots());
        std::vector<TimedTrack> old;
        for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
            old.push_back(track_of(robot, given));
        }
        std::int64_t n_restored = 0;
        std::vector<std::uint8_t> is_restored(n_robots, 0);
        for (bool has_changed = true; has_changed;) {
            has_changed = false;
            for (RobotId first = 0; first < problem_.n_robots(); ++first) {
                if (is_restored[static_cast<std::size_t>(first)] != 0) {
                    continue;
                }
                const std::vector<RobotId> group = in_the_way_of_each_other(first, old);
                Tick gain = 0;
                for (const RobotId robot : group) {
                    gain += plan_.track(robot).cost - old[static_cast<std::size_t>(robot)].cost;
                }
                if (gain < 0) {
                    continue;
                }
                for (const RobotId robot : group) {
                    plan_.exchange(robot, old[static_cast<std::size_t>(robot)]);
                    is_restored[static_cast<std::size_t>(robot)] = 1;
                }
                n_restored += static_cast<std::int64_t>(group.size());
                has_changed = true;
            }
        }
        improvement_.reset();
        return n_restored;
    }

    std::int64_t improve(std::int64_t n_tasks, std::int64_t patience, const StopCondition& deadline,
                         const StopCondition& pause) {
        if (alone(deadline).empty()) {
            return 0;
        }
        if (!improvement_) {
            improvement_.emplace(distances_, plan_, alone_, seed_, n_threads_);
        }
        const std::int64_t before = improvement_->n_tasks();
        improvement_->run(n_tasks, patience, deadline,
                          [&] { return plan_.cost() == bound_ || pause(); });
        return improvement_->n_tasks() - before;
    }

    void retime() {
        improvement_.reset();
        plan_.retime();
    }

    TrackArrays tracks() const {
        Tracks all = plan_.tracks();
        return {to_numpy(std::move(all.first_visit)), to_numpy(std::move(all.vertex)),
                to_numpy(std::move(all.enter))};
    }

    Tick cost() const { return plan_.cost(); }
    std::int64_t n_idle() const { return improvement_ ? improvement_->n_idle() : 0; }
    std::int64_t n_expanded() const { return improvement_ ? improvement_->n_expanded() : 0; }

  private:
    // A robot, and all that have to give way for it to have its track of `old`.
    std::vector<RobotId> in_the_way_of_each_other(RobotId first,
                                                  std::span<const TimedTrack> old) const {
        std::vector<RobotId> group{first};
        std::vector<RobotId> met;
        for (std::size_t k = 0; k < group.size(); ++k) {
            plan_.in_the_way(group[k], old[static_cast<std::size_t>(group[k])], met);
            for (const RobotId other : met) {
                if (std::find(group.begin(), group.end(), other) == group.end()) {
                    group.push_back(other);
                }
            }
        }
        return group;
    }

    // Its cost is below 0 if it misses a stage.
    TimedTrack track_of(RobotId robot, const GivenTracks& given) const {
        const Turns turns = problem_.turns(robot);
        EdgeId before = -1;
        TimedTrack track;
        for (auto k = static_cast<std::size_t>(given.first_visit[robot]);
             k < static_cast<std::size_t>(given.first_visit[robot + 1]); ++k) {
            if (track.visits.empty()) {
                track.visits.push_back({given.enter[k], given.vertices[k], 0});
                continue;
            }
            const VertexId tail = given.vertices[k - 1];
            const EdgeId edge = problem_.graph().edge(tail, given.vertices[k]);
            if (edge < 0) {
                reject_entry("vertices", k, given.vertices[k], "is not next to the one before");
            }
            track.visits.push_back({given.enter[k], given.vertices[k], problem_.drive(robot, edge),
                                    turns.between(before, edge)});
            before = edge;
        }
        const Tick done = completion(problem_.itinerary(robot), track.visits);
        track.cost = done < 0 ? done : done + plan_.surcharges(track.visits);
        return track;
    }

    void clear() {
        in_turn_.reset();
        improvement_.reset();
        plan_ = FleetPlan(problem_);
    }

    const Problem& problem_;
    SharedDistances distances_;
    FleetPlan plan_;
    std::uint64_t seed_;
    std::size_t n_threads_;
    std::vector<Tick> alone_;
    Tick bound_ = 0;
    std::optional<PrioritizedPortfolio> in_turn_;
    std::optional<AnytimeLns> improvement_;
};

void init(FleetSearch* self, const Problem& problem, std::uint64_t seed, std::size_t n_threads,
          const std::optional<ArrayIn<Tick>>& alone) {
    new (self) FleetSearch(problem, seed, n_threads);
    if (alone) {
        self->take_alone(view(*alone));
    }
}

}  // namespace

void bind_fleet(nb::module_& module) {
    nb::class_<FleetSearch>(module, "FleetSearch", class_doc)
        .def("__init__", &init, nb::arg("problem"), nb::arg("seed"), nb::arg("n_threads"),
             nb::arg("alone").none() = nb::none(), nb::keep_alive<1, 2>())
        .def(
            "alone",
            [](FleetSearch& self,
               std::optional<double> time_limit) -> std::optional<ArrayOut<Tick>> {
                const Deadline deadline(time_limit);
                const std::vector<Tick>* alone = nullptr;
                {
                    const nb::gil_scoped_release released;
                    alone = &self.alone(deadline);
                }
                if (alone->empty()) {
                    return std::nullopt;
                }
                return to_numpy(std::span<const Tick>(*alone));
            },
            nb::arg("time_limit").none() = nb::none(), alone_doc)
        .def(
            "start",
            [](FleetSearch& self, const ArrayIn<std::int32_t>& first_visit,
               const ArrayIn<VertexId>& vertices, const ArrayIn<Tick>& enter) {
                const nb::gil_scoped_release released;
                self.start({view(first_visit), view(vertices), view(enter)});
            },
            array("first_visit"), array("vertices"), array("enter"), start_doc)
        .def(
            "restore",
            [](FleetSearch& self, const ArrayIn<std::int32_t>& first_visit,
               const ArrayIn<VertexId>& vertices, const ArrayIn<Tick>& enter) {
                const nb::gil_scoped_release released;
                return self.restore({view(first_visit), view(vertices), view(enter)});
            },
            array("first_visit"), array("vertices"), array("enter"), restore_doc)
        .def(
            "prioritize",
            [](FleetSearch& self, const ArrayIn<RobotId>& order, std::int64_t n_searches,
               std::optional<double> time_limit, std::optional<double> with_net) {
                const Deadline deadline(time_limit);
                const Deadline deadline_with_net(with_net);
                const nb::gil_scoped_release released;
                return self.prioritize(view(order), n_searches, deadline, deadline_with_net);
            },
            array("order"), nb::arg("n_searches"), nb::arg("time_limit").none(),
            nb::arg("with_net").none(), prioritize_doc)
        .def(
            "repair",
            [](FleetSearch& self, const ArrayIn<RobotId>& order, std::int64_t n_searches,
               std::optional<double> time_limit) {
                const Deadline deadline(time_limit);
                const nb::gil_scoped_release released;
                return self.repair(view(order), n_searches, deadline);
            },
            array("order"), nb::arg("n_searches"), nb::arg("time_limit").none(), repair_doc)
        .def(
            "go_on",
            [](FleetSearch& self, std::int64_t n_searches, std::optional<double> time_limit) {
                const Deadline deadline(time_limit);
                const nb::gil_scoped_release released;
                return self.go_on(n_searches, deadline, deadline);
            },
            nb::arg("n_searches"), nb::arg("time_limit").none(), go_on_doc)
        .def(
            "improve",
            [](FleetSearch& self, std::int64_t n_tasks, std::int64_t patience,
               std::optional<double> time_limit, std::optional<double> pause) {
                const Deadline deadline(time_limit);
                const Deadline due(pause);
                const nb::gil_scoped_release released;
                return self.improve(n_tasks, patience, deadline, due);
            },
            nb::arg("n_tasks"), nb::arg("patience"), nb::arg("time_limit").none(),
            nb::arg("pause").none(), improve_doc)
        .def("retime", &FleetSearch::retime, nb::call_guard<nb::gil_scoped_release>(), retime_doc)
        .def("tracks", &FleetSearch::tracks,
             "Return where each robot's visits begin, int32[R + 1], their vertices and enters.")
        .def_prop_ro("cost", &FleetSearch::cost, "The sum of completions and surcharges. [ticks]")
        .def_prop_ro("n_idle", &FleetSearch::n_idle, "How many times in a row brought no gain.")
        .def_prop_ro("n_expanded", &FleetSearch::n_expanded, "States expanded by `improve`.");
}

}  // namespace rightofway::bind

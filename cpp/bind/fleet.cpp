#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <optional>
#include <thread>
#include <tuple>
#include <vector>

#include "bindings.hpp"
#include "core/poll.hpp"
#include "core/reject.hpp"
#include "lns/anytime_lns.hpp"
#include "lns/prioritized.hpp"
#include "lns/prioritized_portfolio.hpp"

namespace rightofway::bind {
namespace {

constexpr auto class_doc = R"(The tracks of a whole fleet: finding first ones, and better ones.

The seed decides all that is drawn; what `improve` finds does not depend on ``n_threads``. Robots
without a track are left where they are by `tracks`: an empty one. Ctrl-C leaves a plan as good as
before.

Parameters
----------
problem : Problem
    What the fleet has to do.
seed : int
    For all that is drawn.
n_threads : int
    Threads of `prioritize` and `improve`, 1 to 1024.
alone : int64[R] or None
    What `alone` returned for the same trips. [ticks])";

constexpr auto alone_doc =
    R"(Return the least completion of each robot without the others, int64[R]. [ticks]

-1 for a robot that cannot get to a stage; None if time ran out.

Parameters
----------
time_limit : float or None
    When to stop; at once for 0 or less. [s])";

constexpr auto start_doc =
    R"(Take over tracks. A robot may have none: an empty track.

Parameters
----------
first_visit : int32[R + 1]
    Robot ``r`` has the visits ``first_visit[r] .. first_visit[r + 1] - 1``.
vertices, enter : int32[N], int64[N]
    Where and when each visit begins. [ticks]

Raises
------
ValueError
    If the others are no tracks of these trips, or overlap.)";

constexpr auto prioritize_doc =
    R"(Give the robots tracks one after another, in this order; return whether all have one now.

`resume` may change a False.

Parameters
----------
order : int32[R]
    Every robot once.
n_searches : int
    The most searches before it gives up.
time_limit : float or None
    When to stop; at once for 0 or less. [s]
with_fallback : float or None
    When to stop instead once the hasty attempt has a plan. [s])";

constexpr auto restore_doc =
    R"(Give robots these tracks where that costs no more; return how many have theirs.

Every robot has a track. `improve` starts afresh.

Parameters
----------
first_visit : int32[R + 1]
    Robot ``r`` has the visits ``first_visit[r] .. first_visit[r + 1] - 1``.
vertices, enter : int32[N], int64[N]
    Where and when each visit begins. [ticks] None is empty.)";

constexpr auto repair_doc =
    R"(Give tracks to robots that have none, in this order; return whether all have one now.

Robots that have a track keep it, unless they are in the way: they lose it, and queue again.

Parameters
----------
order : int32[n]
    All robots without a track, each once.
n_searches : int
    The most searches before it gives up.
time_limit : float or None
    When to stop; at once for 0 or less. [s])";

constexpr auto resume_doc = R"(Continue a `prioritize` that returned False.

Parameters
----------
n_searches : int
    The most searches since its beginning.
time_limit : float or None
    When to stop; at once for 0 or less. [s])";

constexpr auto improve_doc =
    R"(Replace tracks by better ones, a few robots at a time; return how many times that was done.

Every robot has a track. A plan that is stuck becomes one of several, which are crossed with each
other. Ends when nothing can be better, too.

Parameters
----------
n_tasks : int
    The number of neighbourhoods to replan.
patience : int
    The most of them in a row without a gain.
time_limit : float or None
    When to stop at once. [s]
pause : float or None
    When to stop at the next point that does not depend on clocks. [s])";

constexpr auto retime_doc =
    R"(Have all robots as early as the order of visits at every vertex allows; `improve` starts afresh.)";

// Upper limit of a sum of times over a fleet.
constexpr Tick longest_sum = Tick{1} << 60;
constexpr std::size_t most_threads = 1024;
constexpr auto between_questions = std::chrono::milliseconds(5);

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

    // Null if there was no time.
    const std::vector<Tick>* alone(const StopCondition& deadline) {
        if (!is_alone_known_) {
            std::vector<Tick> alone(static_cast<std::size_t>(problem_.n_robots()));
            auto asked = std::chrono::steady_clock::now();
            for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
                const auto now = std::chrono::steady_clock::now();
                if (robot == 0 || now - asked > between_questions) {
                    asked = now;
                    if (deadline()) {
                        return nullptr;
                    }
                }
                alone[index(robot)] = distances_.alone(robot);
            }
            alone_ = std::move(alone);
            bound_ = 0;
            for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
                bound_ += problem_.weight(robot) * alone_[index(robot)];
            }
            is_alone_known_ = true;
        }
        return &alone_;
    }

    void take_alone(std::span<const Tick> alone) {
        require_ranges("alone", alone, -1, latest());
        distances_.take_alone(alone);
    }

    bool prioritize(std::span<const RobotId> order, std::int64_t n_searches,
                    const StopCondition& deadline, const StopCondition& with_fallback) {
        require_count("n_searches", n_searches);
        require_length("order", order.size(), n_robots());
        require_each_once(order);
        clear();
        portfolio_.emplace(distances_, plan_, order);
        return resume(n_searches, deadline, with_fallback);
    }

    bool repair(std::span<const RobotId> order, std::int64_t n_searches,
                const StopCondition& deadline) {
        require_count("n_searches", n_searches);
        require_each_once(order);
        for (std::size_t k = 0; k < order.size(); ++k) {
            if (plan_.has_track(order[k])) {
                reject_entry("order", k, order[k], "is a robot that has a track");
            }
        }
        const auto is_left_out = [&](RobotId robot) {
            return !plan_.has_track(robot) &&
                   std::find(order.begin(), order.end(), robot) == order.end();
        };
        for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
            if (is_left_out(robot)) {
                reject("order", robot, "is a robot without a track, and left out");
            }
        }
        drop_searches();
        Prioritized planner(distances_, plan_);
        planner.start(order);
        return planner.run(n_searches, deadline) == SearchEnd::found;
    }

    bool resume(std::int64_t n_searches, const StopCondition& deadline,
                const StopCondition& with_fallback) {
        require_count("n_searches", n_searches);
        if (!portfolio_) {
            throw std::invalid_argument(
                "resume: there is no attempt to continue (prioritize first)");
        }
        if (!portfolio_->run(n_searches, n_threads_ > 1, deadline, with_fallback)) {
            return false;
        }
        portfolio_.reset();
        return true;
    }

    void start(const GivenTracks& given) {
        require_tracks(given);
        clear();
        for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
            if (given.first_visit[index(robot)] == given.first_visit[index(robot + 1)]) {
                continue;
            }
            TimedTrack track = track_of(robot, given);
            if (!plan_.fits(robot, track)) {
                clear();
                reject("robot", robot,
                       "has a track that breaks the rules: it overlaps another one");
            }
            plan_.exchange(robot, track);
        }
    }

    // The given tracks do not conflict with each other. So a robot can have its track again if all
    // robots in the way of it have theirs, and those in the way of these, and so on.
    std::int64_t restore(const GivenTracks& given, const StopCondition& interrupt) {
        require_tracks(given);
        require_all_tracks("restore");
        improvement_.reset();
        Poll poll(interrupt);
        std::vector<TimedTrack> old;
        FleetPlan together(problem_);
        for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
            if (given.first_visit[index(robot)] == given.first_visit[index(robot + 1)]) {
                reject("robot", robot, "has an empty track");
            }
            old.push_back(track_of(robot, given));
            if (!together.fits(robot, old.back())) {
                reject("robot", robot,
                       "has a track that breaks the rules: it overlaps another one");
            }
            TimedTrack same = old.back();
            together.exchange(robot, same);
        }
        std::int64_t n_restored = 0;
        std::vector<std::uint8_t> is_restored(n_robots(), 0);
        for (bool has_changed = true; has_changed;) {
            has_changed = false;
            for (RobotId first = 0; first < problem_.n_robots(); ++first) {
                if (is_restored[index(first)] != 0) {
                    continue;
                }
                const std::vector<RobotId> group = find_conflict_closure(first, old, poll);
                Tick gain = 0;
                for (const RobotId robot : group) {
                    gain +=
                        problem_.weight(robot) * (plan_.track(robot).cost - old[index(robot)].cost);
                }
                if (gain < 0) {
                    continue;
                }
                for (const RobotId robot : group) {
                    plan_.exchange(robot, old[index(robot)]);
                    is_restored[index(robot)] = 1;
                }
                n_restored += static_cast<std::int64_t>(group.size());
                has_changed = true;
            }
        }
        return n_restored;
    }

    std::int64_t improve(std::int64_t n_tasks, std::int64_t patience, const StopCondition& deadline,
                         const StopCondition& pause) {
        require_count("n_tasks", n_tasks);
        require_count("patience", patience);
        require_all_tracks("improve");
        if (problem_.n_robots() == 0 || alone(deadline) == nullptr) {
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

    void retime(const StopCondition& interrupt) {
        require_all_tracks("retime");
        improvement_.reset();
        plan_.retime(interrupt);
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
    std::size_t n_robots() const { return static_cast<std::size_t>(problem_.n_robots()); }

    // The latest time of a robot, so that no sum over the fleet overflows.
    Tick latest() const { return longest_sum / std::max(problem_.n_robots(), 1); }

    static void require_count(const char* name, std::int64_t count) {
        if (count < 0) {
            reject(name, count, "is negative");
        }
    }

    void require_each_once(std::span<const RobotId> order) const {
        require_ids("order", order, problem_.n_robots());
        std::vector<std::uint8_t> is_listed(n_robots(), 0);
        for (std::size_t k = 0; k < order.size(); ++k) {
            if (is_listed[index(order[k])]++ != 0) {
                reject_entry("order", k, order[k], "is there twice");
            }
        }
    }

    void require_tracks(const GivenTracks& given) const {
        require_length("first_visit", given.first_visit.size(), n_robots() + 1);
        require_lists("first_visit", given.first_visit, given.vertices.size(), "visits");
        require_length("enter", given.enter.size(), given.vertices.size());
        require_ids("vertices", given.vertices, problem_.n_vertices());
        require_ranges("enter", given.enter, 0, latest());
    }

    void require_all_tracks(const char* what) const {
        for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
            if (!plan_.has_track(robot)) {
                reject(what, robot,
                       "is a robot without a track (start, prioritize or repair first)");
            }
        }
    }

    // A robot, and all that have to give way for it to have its track of `old`.
    std::vector<RobotId> find_conflict_closure(RobotId first, std::span<const TimedTrack> old,
                                               Poll& poll) const {
        std::vector<RobotId> group{first};
        std::vector<RobotId> conflicting;
        for (std::size_t k = 0; k < group.size(); ++k) {
            poll();
            plan_.find_conflicting(group[k], old[index(group[k])], conflicting);
            for (const RobotId other : conflicting) {
                if (std::find(group.begin(), group.end(), other) == group.end()) {
                    group.push_back(other);
                }
            }
        }
        return group;
    }

    // A track of a robot that has visits. Throws unless it leads from its home at tick 0 through
    // its stages, no faster than it drives.
    TimedTrack track_of(RobotId robot, const GivenTracks& given) const {
        const Turns turns = problem_.turns(robot);
        EdgeId before = -1;
        TimedTrack track;
        const auto first = index(given.first_visit[index(robot)]);
        const auto end = index(given.first_visit[index(robot + 1)]);
        if (given.vertices[first] != problem_.home(robot)) {
            reject_entry("vertices", first, given.vertices[first],
                         "is not the home of robot " + std::to_string(robot) + ", " +
                             std::to_string(problem_.home(robot)));
        }
        if (given.enter[first] != 0) {
            reject_entry("enter", first, given.enter[first], "must be 0 on a first visit");
        }
        track.visits.push_back({0, given.vertices[first], 0});
        for (std::size_t k = first + 1; k < end; ++k) {
            const VertexId tail = given.vertices[k - 1];
            const EdgeId edge = problem_.graph().edge(tail, given.vertices[k]);
            if (edge < 0) {
                reject_entry("vertices", k, given.vertices[k], "is not next to the one before");
            }
            const std::int32_t drive = problem_.drive(robot, edge);
            if (drive == barred) {
                reject_entry(
                    "vertices", k, given.vertices[k],
                    "is entered along an edge that is barred to robot " + std::to_string(robot));
            }
            const std::int32_t turn = turns.between(before, edge);
            if (given.enter[k] - given.enter[k - 1] < Tick{turn} + drive) {
                reject_entry("enter", k, given.enter[k],
                             "is sooner than robot " + std::to_string(robot) +
                                 " can turn and drive there, " +
                                 std::to_string(Tick{turn} + drive) +
                                 " ticks after the visit before");
            }
            track.visits.push_back({given.enter[k], given.vertices[k], drive, turn});
            before = edge;
        }
        const Tick done = completion(problem_.itinerary(robot), track.visits);
        if (done < 0) {
            reject("robot", robot, "has a track that breaks the rules: it misses a stage");
        }
        track.cost = done + plan_.surcharges(track.visits);
        return track;
    }

    // Searches that continue from the present plan.
    void drop_searches() {
        portfolio_.reset();
        improvement_.reset();
    }

    void clear() {
        drop_searches();
        plan_ = FleetPlan(problem_);
    }

    const Problem& problem_;
    SharedDistances distances_;
    FleetPlan plan_;
    std::uint64_t seed_;
    std::size_t n_threads_;
    std::vector<Tick> alone_;
    bool is_alone_known_ = false;
    Tick bound_ = 0;
    std::optional<PrioritizedPortfolio> portfolio_;
    std::optional<AnytimeLns> improvement_;
};

void init(FleetSearch* self, const Problem& problem, std::uint64_t seed, std::size_t n_threads,
          const std::optional<ArrayIn<Tick>>& alone) {
    if (n_threads < 1 || n_threads > most_threads) {
        reject("n_threads", static_cast<std::int64_t>(std::min(n_threads, std::size_t{1} << 62)),
               "is not in 1.." + std::to_string(most_threads));
    }
    new (self) FleetSearch(problem, seed, n_threads);
    if (alone) {
        try {
            self->take_alone(view(*alone));
        } catch (...) {
            self->~FleetSearch();
            throw;
        }
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
                    alone = self.alone(deadline);
                }
                if (alone == nullptr) {
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
                const Deadline interrupt(std::nullopt);
                const nb::gil_scoped_release released;
                return self.restore({view(first_visit), view(vertices), view(enter)}, interrupt);
            },
            array("first_visit"), array("vertices"), array("enter"), restore_doc)
        .def(
            "prioritize",
            [](FleetSearch& self, const ArrayIn<RobotId>& order, std::int64_t n_searches,
               std::optional<double> time_limit, std::optional<double> with_fallback) {
                const Deadline deadline(time_limit);
                const Deadline deadline_with_fallback(with_fallback, "with_fallback");
                const nb::gil_scoped_release released;
                return self.prioritize(view(order), n_searches, deadline, deadline_with_fallback);
            },
            array("order"), nb::arg("n_searches"), nb::arg("time_limit").none(),
            nb::arg("with_fallback").none(), prioritize_doc)
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
            "resume",
            [](FleetSearch& self, std::int64_t n_searches, std::optional<double> time_limit) {
                const Deadline deadline(time_limit);
                const nb::gil_scoped_release released;
                return self.resume(n_searches, deadline, deadline);
            },
            nb::arg("n_searches"), nb::arg("time_limit").none(), resume_doc)
        .def(
            "improve",
            [](FleetSearch& self, std::int64_t n_tasks, std::int64_t patience,
               std::optional<double> time_limit, std::optional<double> pause) {
                const Deadline deadline(time_limit);
                const Deadline due(pause, "pause");
                const nb::gil_scoped_release released;
                return self.improve(n_tasks, patience, deadline, due);
            },
            nb::arg("n_tasks"), nb::arg("patience"), nb::arg("time_limit").none(),
            nb::arg("pause").none(), improve_doc)
        .def(
            "retime",
            [](FleetSearch& self) {
                const Deadline interrupt(std::nullopt);
                const nb::gil_scoped_release released;
                self.retime(interrupt);
            },
            retime_doc)
        .def("tracks", &FleetSearch::tracks,
             R"(Return the tracks of all robots.

Returns
-------
tuple of (int32[R + 1], int32[N], int64[N])
    Which visits each robot has, and where and when they begin. [ticks])")
        .def_prop_ro("cost", &FleetSearch::cost, "The sum of completions and surcharges. [ticks]")
        .def_prop_ro("n_idle", &FleetSearch::n_idle, "How many times in a row brought no gain.")
        .def_prop_ro("n_expanded", &FleetSearch::n_expanded, "States expanded by `improve`.");
}

}  // namespace rightofway::bind

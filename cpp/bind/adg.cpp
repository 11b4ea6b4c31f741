#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include "execution/runs.hpp"
#include "objects.hpp"

namespace rightofway::bind {
namespace {

constexpr auto adg_doc = R"(A plan that is executed with delays.

Parameters
----------
rules : BookingRules
    How visits are booked.
routes : Routes
    The visits.
order : Order
    When visits begin by the plan, and what each waits for.
delays : DelayModel
    What the robots may meet.
rows : VisitRows or None
    Where robots have sizes: what the visits book.
closures : VisitClosures or None
    When the places of visits are closed.
works : VisitWorks or None
    The works of visits, of a plan with jobs.)";

constexpr auto works_doc = R"(The works of visits, of a plan with jobs.

Parameters
----------
first_work : int32[N + 1]
    Visit ``x`` has the works ``first_work[x] .. first_work[x + 1] - 1``, in order.
ticks : int64[W]
    The least duration of each, a part of the dwell of its visit. [ticks]
earliest, planned : int64[W]
    When each begins at the earliest, and by the plan. [ticks]
first_before, before : int32[W + 1], int32[M]
    Work ``k`` begins when the works ``before[first_before[k]:first_before[k + 1]]`` have ended.
ends_with_work : int32[R]
    1 for robots that complete with their last work, 0 for those that complete in their last visit.

Raises
------
ValueError
    From the graph that they are given to, if they do not fit it.)";

constexpr auto order_doc = R"(The order of the visits of a plan.

Parameters
----------
planned : int64[N]
    When each visit begins by the plan. [ticks]
first_right, rights : int32[N + 1], int32[M]
    Visit ``x`` starts when the visits ``rights[first_right[x]:first_right[x + 1]]`` have ended.
since : int64[N]
    When the rights of way of each visit were given; it begins no sooner. [ticks])";

constexpr auto delays_doc = R"(The delays that a fleet may meet.

Parameters
----------
pace : float64[R]
    The factor of all durations of each robot, 1 as planned.
kind : int32[D]
    0 exponential, 1 uniform, 2 normal, 3 stops, 4 breaks.
a, b : float64[D]
    Mean and nothing; bounds; mean and deviation, all as parts of a visit's time; chance and
    ticks; chance and nothing.
first_stoppage : int32[R + 1]
    Robot ``r`` has the stoppages ``first_stoppage[r] .. first_stoppage[r + 1] - 1``.
stoppage_tick, stoppage_ticks : int64[S]
    When each stoppage of every run begins, rising, and how long it lasts; ``NEVER`` for ever.)";

constexpr auto runs_doc = R"(Run the plan many times by right of way, and by the clock.

Parameters
----------
seed : int
    For the delays.
first, count : int
    Runs ``first`` to ``first + count - 1``; each depends on its number and the seed alone.
time_limit : float or None
    When to stop; at once for 0 or less. [s]

Returns
-------
completion, is_broken : int64[K, R], uint8[K, R]
    When each robot completes by right of way, ``NEVER`` if it does not; whether it stands still
    for ever. [ticks]
by_right_of_way, by_clock : int64[K, 4]
    Pairs of visits that overlap, pairs that overlap only by the headway, swaps, and the tick of the
    earliest of these, ``NEVER`` without any.
own, of_others : int64[N]
    Ticks of lateness that began at each visit: of its own robot, of others.
between : int64[P, 3]
    Robot, another, and the ticks that the first is late because of the other.
is_caught : uint8[K, R]
    Whether each robot books something while it is closed.)";

constexpr auto sample_doc =
    R"(Return the delays of one run.

Parameters
----------
seed, run : int
    As for `runs`.

Returns
-------
dwell, drive : int64[N], int64[N]
    The real duration of each visit without the drive after it, and of the drive into it. [ticks]
first_stoppage, stoppage_tick, stoppage_ticks : int32[R + 1], int64[S], int64[S]
    Stoppages as the class takes them.)";

constexpr auto execute_doc =
    R"(Run the plan once by the clock or by right of way, with given delays.

Parameters
----------
dwell, drive, first_stoppage, stoppage_tick, stoppage_ticks : ndarray
    The delays, as `delay_sample` returns them.
clock : bool
    Whether robots go by the clock, instead of by right of way.

Returns
-------
enter, start : int64[N], int64[N]
    When each visit begins, and when its booking begins. [ticks]
completion, is_broken : int64[R], uint8[R]
    When each robot completes; whether it stands still for ever. [ticks]
collisions : int64[4]
    As `runs` counts them.
is_caught : uint8[R]
    Whether each robot books something while it is closed.
begin, end : int64[W]
    When each work begins and ends. [ticks])";

constexpr std::size_t most_runs = std::size_t{1} << 31;

std::vector<Stoppage> stoppages_of(const ArrayIn<Tick>& tick, const ArrayIn<Tick>& ticks) {
    require_length("stoppage_ticks", ticks.size(), tick.size());
    std::vector<Stoppage> stoppages;
    for (std::size_t k = 0; k < tick.size(); ++k) {
        stoppages.push_back({view(tick)[k], view(ticks)[k]});
    }
    return stoppages;
}

DelaySample sample_of(const ActionDependencyGraph& plan, const ArrayIn<Tick>& dwell,
                      const ArrayIn<Tick>& drive, const ArrayIn<std::int32_t>& first,
                      const ArrayIn<Tick>& tick, const ArrayIn<Tick>& ticks) {
    const auto n_visits = static_cast<std::size_t>(plan.n_visits());
    require_length("dwell", dwell.size(), n_visits);
    require_length("drive", drive.size(), n_visits);
    require_ranges("dwell", view(dwell), 0, longest_duration);
    require_ranges("drive", view(drive), 0, longest_duration);
    DelaySample out;
    out.dwell.assign(view(dwell).begin(), view(dwell).end());
    out.drive.assign(view(drive).begin(), view(drive).end());
    out.first_stoppage.assign(view(first).begin(), view(first).end());
    out.stoppages = stoppages_of(tick, ticks);
    require_stoppages(out.first_stoppage, static_cast<std::size_t>(plan.n_robots()), out.stoppages);
    return out;
}

std::vector<Tick> as_row(const ConflictCount& count) {
    return {count.vertex, count.headway, count.swap, count.first};
}

TableOut<Tick> as_table(const std::vector<ConflictCount>& counts) {
    std::vector<Tick> values;
    for (const ConflictCount& count : counts) {
        const std::vector<Tick> row = as_row(count);
        values.insert(values.end(), row.begin(), row.end());
    }
    return hand_over<TableOut<Tick>>(std::move(values), {counts.size(), 4});
}

TableOut<Tick> as_table(const std::unordered_map<std::int64_t, Tick>& between, RobotId n_robots) {
    std::vector<std::pair<std::int64_t, Tick>> rows(between.begin(), between.end());
    std::sort(rows.begin(), rows.end());
    std::vector<Tick> values;
    for (const auto& [pair, ticks] : rows) {
        values.insert(values.end(), {pair / n_robots, pair % n_robots, ticks});
    }
    return hand_over<TableOut<Tick>>(std::move(values), {rows.size(), 3});
}

class BoundAdg {
  public:
    BoundAdg(const AdgArrays& arrays, std::span<const double> pace, std::vector<Delay> delays,
             std::vector<std::int32_t> first_stoppage, std::vector<Stoppage> stoppages)
        : plan_(arrays),
          delays_(plan_, pace, std::move(delays), std::move(first_stoppage), std::move(stoppages)),
          runs_(plan_, delays_),
          timetable_(plan_),
          conflicts_(plan_) {}
    BoundAdg(const BoundAdg&) = delete;
    BoundAdg& operator=(const BoundAdg&) = delete;

    auto runs(std::uint64_t seed, std::uint64_t first, std::size_t count,
              std::optional<double> time_limit) {
        const Deadline deadline(time_limit);
        if (count > most_runs) {
            throw std::invalid_argument("count: " + std::to_string(count) + " is above " +
                                        std::to_string(most_runs));
        }
        LatenessSources sources(plan_);
        RunBatch out;
        {
            const nb::gil_scoped_release released;
            out = runs_.run(seed, first, count, sources, deadline);
        }
        const std::size_t done = out.by_clock.size();
        const auto n_robots = static_cast<std::size_t>(plan_.n_robots());
        return std::tuple(
            hand_over<TableOut<Tick>>(std::move(out.completion), {done, n_robots}),
            hand_over<TableOut<std::uint8_t>>(std::move(out.is_broken), {done, n_robots}),
            as_table(out.by_right_of_way), as_table(out.by_clock),
            to_numpy(std::vector<Tick>(sources.own())),
            to_numpy(std::vector<Tick>(sources.of_others())),
            as_table(sources.between(), plan_.n_robots()),
            hand_over<TableOut<std::uint8_t>>(std::move(out.is_caught), {done, n_robots}));
    }

    auto sample(std::uint64_t seed, std::uint64_t run) const {
        DelaySample out;
        delays_.draw(seed, run, out);
        std::vector<Tick> tick;
        std::vector<Tick> ticks;
        for (const Stoppage& stoppage : out.stoppages) {
            tick.push_back(stoppage.tick);
            ticks.push_back(stoppage.ticks);
        }
        return std::tuple(to_numpy(std::move(out.dwell)), to_numpy(std::move(out.drive)),
                          to_numpy(std::move(out.first_stoppage)), to_numpy(std::move(tick)),
                          to_numpy(std::move(ticks)));
    }

    auto execute(const ArrayIn<Tick>& dwell, const ArrayIn<Tick>& drive,
                 const ArrayIn<std::int32_t>& first, const ArrayIn<Tick>& tick,
                 const ArrayIn<Tick>& ticks, bool clock) {
        const DelaySample sample = sample_of(plan_, dwell, drive, first, tick, ticks);
        const Deadline interrupt(std::nullopt);
        ActualTimes times;
        ConflictCount count;
        {
            const nb::gil_scoped_release released;
            if (clock) {
                by_clock(plan_, sample, times);
            } else {
                timetable_.by_right_of_way(sample, times, interrupt);
            }
            count = conflicts_.count(times);
        }
        return std::tuple(to_numpy(std::move(times.enter)), to_numpy(std::move(times.start)),
                          to_numpy(std::move(times.completion)),
                          to_numpy(std::move(times.is_broken)), to_numpy(as_row(count)),
                          to_numpy(std::move(times.is_caught)), to_numpy(std::move(times.begin)),
                          to_numpy(std::move(times.end)));
    }

    auto planned_completions() const {
        std::vector<Tick> ticks;
        for (RobotId r = 0; r < plan_.n_robots(); ++r) {
            ticks.push_back(plan_.planned_completion(r));
        }
        return to_numpy(std::move(ticks));
    }

    auto deadlocked() const { return to_numpy(timetable_.deadlocked()); }

  private:
    ActionDependencyGraph plan_;
    Delays delays_;
    ExecutionRuns runs_;
    ExecutionTimetable timetable_;
    ExecutedConflicts conflicts_;
};

struct BoundOrder {
    Ticks planned;
    Ints first_right;
    Ints rights;
    Ticks since;
};

struct BoundDelays {
    ArrayIn<double> pace;
    Ints kind;
    ArrayIn<double> a;
    ArrayIn<double> b;
    Ints first_stoppage;
    Ticks stoppage_tick;
    Ticks stoppage_ticks;

    std::vector<Delay> delays() const {
        require_length("a", a.size(), kind.size());
        require_length("b", b.size(), kind.size());
        require_ids("kind", view(kind), 5);
        std::vector<Delay> delays;
        for (std::size_t k = 0; k < kind.size(); ++k) {
            delays.push_back({static_cast<DelayKind>(view(kind)[k]), view(a)[k], view(b)[k]});
        }
        return delays;
    }
};

void init_adg(BoundAdg* self, const BookingRules& rules, const BoundRoutes& routes,
              const BoundOrder& order, const BoundDelays& model, const BoundVisitRows* rows,
              const BoundVisitClosures* closures, const BoundVisitWorks* works) {
    require_length("since", order.since.size(), routes.vertex.size());
    const auto first = view(model.first_stoppage);
    new (self) BoundAdg(
        {view(routes.first_visit), view(routes.vertex), view(order.planned), view(routes.dwell),
         view(routes.drive), view(order.first_right), view(order.rights), rules.headway,
         rules.books_ahead, view(order.since), BoundVisitRows::rows(rows),
         BoundVisitClosures::closures(closures, routes), BoundVisitWorks::works(works)},
        view(model.pace), model.delays(), {first.begin(), first.end()},
        stoppages_of(model.stoppage_tick, model.stoppage_ticks));
}

}  // namespace

void bind_adg(nb::module_& module) {
    nb::class_<BoundOrder>(module, "Order", order_doc)
        .def(nb::init<Ticks, Ints, Ints, Ticks>(), array("planned"), array("first_right"),
             array("rights"), array("since"));
    nb::class_<BoundDelays>(module, "DelayModel", delays_doc)
        .def(
            nb::init<ArrayIn<double>, Ints, ArrayIn<double>, ArrayIn<double>, Ints, Ticks, Ticks>(),
            array("pace"), array("kind"), array("a"), array("b"), array("first_stoppage"),
            array("stoppage_tick"), array("stoppage_ticks"));
    nb::class_<BoundVisitWorks>(module, "VisitWorks", works_doc)
        .def(nb::init<Ints, Ticks, Ticks, Ticks, Ints, Ints, Ints>(), array("first_work"),
             array("ticks"), array("earliest"), array("planned"), array("first_before"),
             array("before"), array("ends_with_work"));
    nb::class_<BoundAdg>(module, "ActionDependencyGraph", adg_doc)
        .def("__init__", &init_adg, nb::arg("rules"), nb::arg("routes"), nb::arg("order"),
             nb::arg("delays"), nb::arg("rows").none() = nb::none(),
             nb::arg("closures").none() = nb::none(), nb::arg("works").none() = nb::none())
        .def("runs", &BoundAdg::runs, nb::arg("seed"), nb::arg("first"), nb::arg("count"),
             nb::arg("time_limit").none(), runs_doc)
        .def("delay_sample", &BoundAdg::sample, nb::arg("seed"), nb::arg("run"), sample_doc)
        .def("execute", &BoundAdg::execute, array("dwell"), array("drive"), array("first_stoppage"),
             array("stoppage_tick"), array("stoppage_ticks"), nb::arg("clock"), execute_doc)
        .def("planned_completions", &BoundAdg::planned_completions,
             "Return when each robot completes by the plan, int64[R]. [ticks]")
        .def("deadlocked", &BoundAdg::deadlocked,
             "Return the robots that can never complete because they wait for each other, "
             "int32[K].");
}

}  // namespace rightofway::bind

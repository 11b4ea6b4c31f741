#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include "bindings.hpp"
#include "core/reject.hpp"
#include "execution/runs.hpp"

namespace rightofway::bind {
namespace {

constexpr auto class_doc = R"(A plan that is executed with delays.

Parameters
----------
first_visit : int32[R + 1]
    Robot ``r`` owns visits ``first_visit[r] .. first_visit[r + 1] - 1``, at least one.
vertex, planned : int32[N], int64[N]
    The vertex of each visit, and when it begins by the plan. [ticks]
dwell, drive : int64[N]
    The least duration of each visit without the drive after it, and the drive into it. [ticks]
before : int32[N]
    The visit that goes directly before at the same vertex, -1 for none.
since : int64[N]
    When the right of way of each visit was given; it begins no sooner. [ticks]
headway : int
    Ticks from one robot's leave to the next one's enter, or start to drive there.
books_ahead : bool
    Whether a robot books a vertex from when it starts to drive there.
pace : float64[R]
    The factor of all durations of each robot, 1 as planned.
delay_kind : int32[D]
    0 exponential, 1 uniform, 2 normal, 3 stops, 4 breaks.
delay_a, delay_b : float64[D]
    Mean and nothing; bounds; mean and deviation, all as parts of a visit's time; chance and
    ticks; chance and nothing.
first_stoppage : int32[R + 1]
    Robot ``r`` has the stoppages ``first_stoppage[r] .. first_stoppage[r + 1] - 1``.
stoppage_tick, stoppage_ticks : int64[S]
    When each stoppage of every run begins, rising, and how long it lasts; ``NEVER`` for ever.
first_right, rights : int32[N + 1], int32[M] or None
    Where robots have sizes: visit ``x`` starts when the visits ``rights[first_right[x]] ..`` have
    ended; ``before`` is then -1.
vertex_row, edge_row, first_excluded, excluded : int32 or None
    Where robots have sizes: as ``PrecedenceGraph`` takes them.
first_closed, closed_from, closed_until : int32[2 N + 1], int64[K], int64[K] or None
    When the places of visits are closed: as ``PrecedenceGraph`` takes them. [ticks])";

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
    Whether each robot books something while it is closed.)";

// Of a stay or a drive, however late: the sum of two stays below `never`.
constexpr Tick longest = Tick{1} << 60;

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
    require_ranges("dwell", view(dwell), 0, longest);
    require_ranges("drive", view(drive), 0, longest);
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
                          to_numpy(std::move(times.is_caught)));
    }

    auto deadlocked() const { return to_numpy(timetable_.deadlocked()); }

  private:
    ActionDependencyGraph plan_;
    Delays delays_;
    ExecutionRuns runs_;
    ExecutionTimetable timetable_;
    ExecutedConflicts conflicts_;
};

void init(BoundAdg* self, const ArrayIn<VisitId>& first_visit, const ArrayIn<VertexId>& vertex,
          const ArrayIn<Tick>& planned, const ArrayIn<Tick>& dwell, const ArrayIn<Tick>& drive,
          const ArrayIn<VisitId>& before, const ArrayIn<Tick>& since, Tick headway,
          bool books_ahead, const ArrayIn<double>& pace, const ArrayIn<std::int32_t>& delay_kind,
          const ArrayIn<double>& delay_a, const ArrayIn<double>& delay_b,
          const ArrayIn<std::int32_t>& first_stoppage, const ArrayIn<Tick>& stoppage_tick,
          const ArrayIn<Tick>& stoppage_ticks,
          const std::optional<ArrayIn<std::int32_t>>& first_right,
          const std::optional<ArrayIn<VisitId>>& rights,
          const std::optional<ArrayIn<std::int32_t>>& vertex_row,
          const std::optional<ArrayIn<std::int32_t>>& edge_row,
          const std::optional<ArrayIn<std::int32_t>>& first_excluded,
          const std::optional<ArrayIn<std::int32_t>>& excluded,
          const std::optional<ArrayIn<std::int32_t>>& first_closed,
          const std::optional<ArrayIn<Tick>>& closed_from,
          const std::optional<ArrayIn<Tick>>& closed_until) {
    are_given("first_right, rights, vertex_row, edge_row, first_excluded, excluded", first_right,
              rights, vertex_row, edge_row, first_excluded, excluded);
    are_given("first_closed, closed_from, closed_until", first_closed, closed_from, closed_until);
    require_not_empty("first_excluded", first_excluded);
    require_not_empty("first_closed", first_closed);
    require_length("since", since.size(), vertex.size());
    require_length("delay_a", delay_a.size(), delay_kind.size());
    require_length("delay_b", delay_b.size(), delay_kind.size());
    std::vector<Delay> delays;
    require_ids("delay_kind", view(delay_kind), 5);
    for (std::size_t k = 0; k < delay_kind.size(); ++k) {
        delays.push_back(
            {static_cast<DelayKind>(view(delay_kind)[k]), view(delay_a)[k], view(delay_b)[k]});
    }
    const auto first = view(first_stoppage);
    new (self) BoundAdg({view(first_visit),
                         view(vertex),
                         view(planned),
                         view(dwell),
                         view(drive),
                         view(before),
                         headway,
                         books_ahead,
                         view(since),
                         view_or_empty(first_right),
                         view_or_empty(rights),
                         {view_or_empty(vertex_row), view_or_empty(edge_row),
                          view_or_empty(first_excluded), view_or_empty(excluded)},
                         {view_or_empty(first_closed), view_or_empty(closed_from),
                          view_or_empty(closed_until), view(drive)}},
                        view(pace), std::move(delays), {first.begin(), first.end()},
                        stoppages_of(stoppage_tick, stoppage_ticks));
}

}  // namespace

void bind_adg(nb::module_& module) {
    nb::class_<BoundAdg>(module, "ActionDependencyGraph", class_doc)
        .def("__init__", &init, array("first_visit"), array("vertex"), array("planned"),
             array("dwell"), array("drive"), array("before"), array("since"), nb::arg("headway"),
             nb::arg("books_ahead"), array("pace"), array("delay_kind"), array("delay_a"),
             array("delay_b"), array("first_stoppage"), array("stoppage_tick"),
             array("stoppage_ticks"), array("first_right").none() = nb::none(),
             array("rights").none() = nb::none(), array("vertex_row").none() = nb::none(),
             array("edge_row").none() = nb::none(), array("first_excluded").none() = nb::none(),
             array("excluded").none() = nb::none(), array("first_closed").none() = nb::none(),
             array("closed_from").none() = nb::none(), array("closed_until").none() = nb::none())
        .def("runs", &BoundAdg::runs, nb::arg("seed"), nb::arg("first"), nb::arg("count"),
             nb::arg("time_limit").none(), runs_doc)
        .def("delay_sample", &BoundAdg::sample, nb::arg("seed"), nb::arg("run"), sample_doc)
        .def("execute", &BoundAdg::execute, array("dwell"), array("drive"), array("first_stoppage"),
             array("stoppage_tick"), array("stoppage_ticks"), nb::arg("clock"), execute_doc)
        .def("deadlocked", &BoundAdg::deadlocked,
             "Return the robots that can never complete because they wait for each other.");
}

}  // namespace rightofway::bind

#include "precedence/timed_event_graph.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include <optional>
#include <tuple>
#include <utility>

#include "bindings.hpp"

namespace rightofway::bind {
namespace {

constexpr auto circuit_doc =
    R"(Find the circuit with the largest mean: the cycle time of events that repeat.

Parameters
----------
n_nodes : int
    The number of events in a period, N.
tail, head : int32[M], int32[M]
    The arcs.
length : int64[M]
    How long after its tail the head of each comes at least, not negative. [ticks]
height : int32[M]
    How many periods later; may be negative.
time_limit : float or None
    When to stop; at once for 0 or less. [s]

Returns
-------
tuple of (int, int, int32[n]) or None
    Length and height of the largest ratio in lowest terms, and the arcs of a circuit that has it,
    in order; 0, 1 and no arcs if every circuit has length 0. Height 0 if the events of the
    circuit wait for each other for ever. None if time ran out. ValueError if all lengths times all
    heights is beyond 2^58.)";

constexpr auto times_doc =
    R"(Return the least times that keep all arcs every ``period / parts`` ticks, int64[N].

At least 0. [1 / parts ticks] None if the period is less than the cycle time, or time ran out.

Parameters
----------
n_nodes, tail, head, length, height : int, int32[M], int32[M], int64[M], int32[M]
    The events and arcs, as for `critical_circuit`.
period, parts : int, int
    The events come again every ``period / parts`` ticks; ``parts`` is above 0.
time_limit : float or None
    When to stop; at once for 0 or less. [s])";

using Circuit = std::tuple<Tick, std::int64_t, ArrayOut<std::int32_t>>;

TimedEventGraph arcs_of(std::int32_t n_nodes, const ArrayIn<std::int32_t>& tail,
                        const ArrayIn<std::int32_t>& head, const ArrayIn<Tick>& length,
                        const ArrayIn<std::int32_t>& height) {
    const TimedEventGraph arcs{n_nodes, view(tail), view(head), view(length), view(height)};
    require_event_arcs(arcs);
    return arcs;
}

std::optional<Circuit> find_critical_circuit(std::int32_t n_nodes,
                                             const ArrayIn<std::int32_t>& tail,
                                             const ArrayIn<std::int32_t>& head,
                                             const ArrayIn<Tick>& length,
                                             const ArrayIn<std::int32_t>& height,
                                             std::optional<double> time_limit) {
    const TimedEventGraph arcs = arcs_of(n_nodes, tail, head, length, height);
    const Deadline deadline(time_limit);
    std::optional<CriticalCircuit> found;
    {
        const nb::gil_scoped_release released;
        found = critical_circuit(arcs, deadline);
    }
    if (!found) {
        return std::nullopt;
    }
    return Circuit{found->length, found->height, to_numpy(std::move(found->arcs))};
}

std::optional<ArrayOut<Tick>> find_earliest_times(
    std::int32_t n_nodes, const ArrayIn<std::int32_t>& tail, const ArrayIn<std::int32_t>& head,
    const ArrayIn<Tick>& length, const ArrayIn<std::int32_t>& height, Tick period,
    std::int64_t parts, std::optional<double> time_limit) {
    const TimedEventGraph arcs = arcs_of(n_nodes, tail, head, length, height);
    const Deadline deadline(time_limit);
    std::optional<std::vector<Tick>> found;
    {
        const nb::gil_scoped_release released;
        found = earliest_times(arcs, period, parts, deadline);
    }
    if (!found) {
        return std::nullopt;
    }
    return to_numpy(std::move(*found));
}

}  // namespace

void bind_timed_event_graph(nb::module_& module) {
    module.def("critical_circuit", &find_critical_circuit, nb::arg("n_nodes"), array("tail"),
               array("head"), array("length"), array("height"), nb::arg("time_limit").none(),
               circuit_doc);
    module.def("earliest_times", &find_earliest_times, nb::arg("n_nodes"), array("tail"),
               array("head"), array("length"), array("height"), nb::arg("period"), nb::arg("parts"),
               nb::arg("time_limit").none(), times_doc);
}

}  // namespace rightofway::bind

#include <nanobind/stl/optional.h>

#include <optional>

#include "bindings.hpp"
#include "bounds/price_ascent.hpp"
#include "core/reject.hpp"

namespace rightofway::bind {
namespace {

constexpr auto bounds_doc = R"(A lower bound of all plans, raised step by step by prices of places.

Parameters
----------
problem : Problem
    What the fleet has to do; every robot can reach its places.)";

constexpr auto run_ascent_doc = R"(Take more steps; more can follow.

Parameters
----------
steps : int
    The number of steps at most.
time_limit : float or None
    When to stop; at once for 0 or less. [s])";

}  // namespace

void bind_bounds(nb::module_& module) {
    nb::class_<PriceAscent>(module, "PriceAscent", bounds_doc)
        .def(nb::init<const Problem&>(), nb::arg("problem"), nb::keep_alive<1, 2>())
        .def(
            "run",
            [](PriceAscent& self, std::int64_t steps, std::optional<double> time_limit) {
                require_range("steps", steps, 0, never);
                const Deadline deadline(time_limit);
                const nb::gil_scoped_release released;
                self.run(steps, [&] { return deadline(); });
            },
            nb::arg("steps"), nb::arg("time_limit").none(), run_ascent_doc)
        .def_prop_ro("bound", &PriceAscent::bound, "No plan costs less. [ticks]")
        .def_prop_ro("n_steps", &PriceAscent::n_steps, "The number of steps taken.")
        .def_prop_ro("is_over", &PriceAscent::is_over, "Whether more steps change nothing.");
}

}  // namespace rightofway::bind

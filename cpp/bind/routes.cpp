#include "objects.hpp"

namespace rightofway::bind {
namespace {

constexpr auto routes_doc = R"(Fixed visits of robots, robot by robot.

Parameters
----------
first_visit : int32[R + 1]
    Robot ``r`` owns visits ``first_visit[r] .. first_visit[r + 1] - 1``, at least one.
vertex : int32[N]
    The vertex of each visit; consecutive visits of a robot are at different vertices.
dwell, drive : int64[N]
    The least duration of each visit without the drive after it, and the drive into it. [ticks]

Raises
------
ValueError
    If the durations do not fit; names the array, the index and the value.)";

constexpr auto rows_doc = R"(What visits book, where robots have sizes.

Parameters
----------
lists : ExcludedRows
    The rows that each row excludes.
vertex, edge : int32[N]
    The row that each visit books at its vertex, and along the edge driven out of it; -1 for the
    edge of last visits.)";

constexpr auto visit_closures_doc = R"(When the places of visits are closed.

Parameters
----------
first : int32[2 N + 1]
    The vertex of visit ``x`` has the entries ``first[2 x] .. first[2 x + 1] - 1``, the edge driven
    into it those from ``first[2 x + 1]`` on.
start, end : int64[K]
    When each entry is closed. [ticks])";

}  // namespace

void bind_routes(nb::module_& module) {
    nb::class_<BoundRoutes>(module, "Routes", routes_doc)
        .def(
            "__init__",
            [](BoundRoutes* self, const Ints& first_visit, const Ints& vertex, const Ticks& dwell,
               const Ticks& drive) {
                const BoundRoutes routes{first_visit, vertex, dwell, drive};
                routes.check();
                new (self) BoundRoutes(routes);
            },
            array("first_visit"), array("vertex"), array("dwell"), array("drive"));
    nb::class_<BoundVisitRows>(module, "VisitRows", rows_doc)
        .def(nb::init<BoundExcludedRows, Ints, Ints>(), nb::arg("lists"), array("vertex"),
             array("edge"));
    nb::class_<BoundVisitClosures>(module, "VisitClosures", visit_closures_doc)
        .def(nb::init<Ints, Ticks, Ticks>(), array("first"), array("start"), array("end"));
}

}  // namespace rightofway::bind

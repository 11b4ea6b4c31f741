#include <exception>
#include <stdexcept>

#include "bindings.hpp"
#include "core/types.hpp"

namespace {

namespace nb = nanobind;

constexpr const char* compiler() {
#if defined(__clang__)
    return "Clang " __clang_version__;
#elif defined(__GNUC__)
    return "GCC " __VERSION__;
#elif defined(_MSC_VER)
    return "MSVC";
#else
    return "unknown";
#endif
}

// What integers cannot hold is a fault of the input wherever a kernel finds it.
void raise_kernel_limits() {
    nb::register_exception_translator([](const std::exception_ptr& error, void*) {
        try {
            std::rethrow_exception(error);
        } catch (const std::overflow_error& limit) {
            const nb::object kind = nb::module_::import_("rightofway.errors").attr("KernelLimit");
            PyErr_SetObject(kind.ptr(), kind.attr("at")("", limit.what()).ptr());
        }
    });
}

}  // namespace

NB_MODULE(_core, module) {
    raise_kernel_limits();
    module.doc() =
        "The native kernels: arrays and integers in, arrays and integers out.\n\n"
        "ValueError names the array, the index and the value that do not fit. ``time_limit`` [s]\n"
        "stops a search; long calls release the GIL and obey Ctrl-C. All are deterministic.\n\n"
        "``CONFLICT_CAP`` is the most that one conflict counts, also if it never ends;\n"
        "``NEVER`` is the end of a booking that never ends. [ticks]";
    module.attr("CONFLICT_CAP") = rightofway::conflict_cap;
    module.attr("NEVER") = rightofway::never;
    module.def("compiler", &compiler, "Return the name and version of what compiled this module.");
    rightofway::bind::bind_problem(module);
    rightofway::bind::bind_routes(module);
    rightofway::bind::bind_periodic_bookings(module);
    rightofway::bind::bind_distances(module);
    rightofway::bind::bind_simulator(module);
    rightofway::bind::bind_timed_event_graph(module);
    rightofway::bind::bind_lacam(module);
    rightofway::bind::bind_fleet(module);
    rightofway::bind::bind_bounds(module);
    rightofway::bind::bind_cbs(module);
    rightofway::bind::bind_adg(module);
    rightofway::bind::bind_graph(module);
    rightofway::bind::bind_sipp(module);
    rightofway::bind::bind_tours(module);
}

// What the files of the binding share: how arrays come in and go out, and who binds what.
//
// Arrays come in as they are (right type, contiguous, on the CPU; read-only will do): a silent
// conversion would hide a copy, or wrap a number that does not fit. Arrays that go out are new.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace rightofway::bind {

namespace nb = nanobind;

template <class T>
using ArrayIn = nb::ndarray<const T, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
template <class T>
using ArrayOut = nb::ndarray<nb::numpy, T, nb::ndim<1>>;
template <class T>
using PairsOut = nb::ndarray<nb::numpy, T, nb::shape<-1, 2>>;
template <class T>
using TableOut = nb::ndarray<nb::numpy, T, nb::ndim<2>>;

// An argument that is an array and is not converted.
inline auto array(const char* name) { return nb::arg(name).noconvert(); }

template <class T>
std::span<const T> view(const ArrayIn<T>& array) {
    return {array.data(), array.size()};
}

template <class T>
std::span<const T> view_or_empty(const std::optional<ArrayIn<T>>& array) {
    return array ? view(*array) : std::span<const T>{};
}

// Hands the vector's memory over to Python, which frees it with the last array that uses it.
template <class Out, class T>
Out hand_over(std::vector<T>&& values, std::initializer_list<std::size_t> shape) {
    auto owned = std::make_unique<std::vector<T>>(std::move(values));
    T* data = owned->data();
    nb::capsule owner(owned.get(),
                      [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
    owned.release();
    return Out(data, shape, owner);
}

template <class T>
ArrayOut<T> to_numpy(std::vector<T>&& values) {
    const std::size_t size = values.size();
    return hand_over<ArrayOut<T>>(std::move(values), {size});
}

template <class T>
ArrayOut<T> to_numpy(std::span<const T> values) {
    return to_numpy(std::vector<T>(values.begin(), values.end()));
}

// Throws unless arrays that go together are all given, or none of them.
template <class... Arrays>
bool are_given(const char* names, const Arrays&... arrays) {
    const std::size_t n_given = (std::size_t{arrays.has_value()} + ...);
    if (n_given != 0 && n_given != sizeof...(arrays)) {
        throw std::invalid_argument(std::string(names) + ": " + std::to_string(n_given) + " of " +
                                    std::to_string(sizeof...(arrays)) +
                                    " arrays are given (give all, or none)");
    }
    return n_given != 0;
}

// Throws if an array that is given has no entry, because the kernels take that for none given.
template <class T>
void require_not_empty(const char* name, const std::optional<ArrayIn<T>>& array) {
    if (array && array->size() == 0) {
        throw std::invalid_argument(std::string(name) +
                                    ": its length is 0, but must be at least 1");
    }
}

// What long searches are asked now and then: is the time over, has the user had enough?
class Deadline {
  public:
    // Some seconds from now: at once for 0 or less; never without a limit, or beyond 30 years.
    explicit Deadline(std::optional<double> seconds, const char* name = "time_limit") {
        if (!seconds || *seconds > endless) {
            return;
        }
        if (std::isnan(*seconds)) {
            throw std::invalid_argument(std::string(name) + ": nan is no number of seconds");
        }
        at_ = *seconds <= 0 ? Clock::time_point::min()
                            : Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                 std::chrono::duration<double>(*seconds));
    }

    // Asked while the GIL is released: takes it to look for Ctrl-C.
    bool operator()() const {
        const nanobind::gil_scoped_acquire acquired;
        if (PyErr_CheckSignals() != 0) {
            throw nanobind::python_error();
        }
        return at_ && Clock::now() >= *at_;
    }

  private:
    static constexpr double endless = 1e9;
    using Clock = std::chrono::steady_clock;
    std::optional<Clock::time_point> at_;
};

void bind_periodic_bookings(nb::module_& module);
void bind_distances(nb::module_& module);
void bind_simulator(nb::module_& module);
void bind_timed_event_graph(nb::module_& module);
void bind_lacam(nb::module_& module);
void bind_problem(nb::module_& module);
void bind_fleet(nb::module_& module);
void bind_bounds(nb::module_& module);
void bind_cbs(nb::module_& module);
void bind_adg(nb::module_& module);
void bind_graph(nb::module_& module);
void bind_routes(nb::module_& module);
void bind_sipp(nb::module_& module);
void bind_tours(nb::module_& module);

}  // namespace rightofway::bind

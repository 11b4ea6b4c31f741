// What the files of the binding share: how arrays come in and go out, and who binds what.
//
// Arrays come in as they are (right type, contiguous, on the CPU; read-only will do): a silent
// conversion would hide a copy, or wrap a number that does not fit. Arrays that go out are new.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
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

// What long searches are asked now and then: is the time over, has the user had enough?
class Deadline {
  public:
    // So many seconds from now; never, without.
    explicit Deadline(std::optional<double> seconds) {
        if (seconds) {
            at_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                     std::chrono::duration<double>(*seconds));
        }
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
void bind_adg(nb::module_& module);
void bind_graph(nb::module_& module);
void bind_sipp(nb::module_& module);

}  // namespace rightofway::bind

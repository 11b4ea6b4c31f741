#include "rightofway/booking_table.hpp"

#include <algorithm>
#include <string>

#include "rightofway/reject.hpp"

namespace rightofway {
namespace {

std::size_t checked_count(VertexId n_vertices) {
    if (n_vertices < 0) {
        reject("n_vertices", n_vertices, "is negative");
    }
    return static_cast<std::size_t>(n_vertices);
}

bool ends_by(const BookedBy& booking, Tick time) { return booking.time.end <= time; }

}  // namespace

BookingTable::BookingTable(VertexId n_vertices) : at_(checked_count(n_vertices)) {}

void BookingTable::book(VertexId vertex, const Booking& time, RobotId robot) {
    require_id("vertex", vertex, n_vertices());
    if (robot < 0) {
        reject("robot", robot, "is negative");
    }
    if (time.is_empty()) {
        reject("end", time.end, "is not after start, " + std::to_string(time.start));
    }
    auto& here = at_[vertex];
    const auto first = std::lower_bound(here.begin(), here.end(), time.start, ends_by);
    Booking whole = time;
    auto last = first;
    for (; last != here.end() && last->time.start < time.end; ++last) {
        if (last->robot != robot) {
            reject("start", time.start,
                   "overlaps a booking of vertex " + std::to_string(vertex) + " by robot " +
                       std::to_string(last->robot));
        }
        whole.start = std::min(whole.start, last->time.start);
        whole.end = std::max(whole.end, last->time.end);
    }
    here.insert(here.erase(first, last), {whole, robot});
    if (of_.size() <= static_cast<std::size_t>(robot)) {
        of_.resize(static_cast<std::size_t>(robot) + 1);
    }
    of_[robot].push_back(vertex);
}

void BookingTable::release(RobotId robot) {
    if (robot < 0 || static_cast<std::size_t>(robot) >= of_.size()) {
        return;
    }
    for (const VertexId vertex : of_[robot]) {
        std::erase_if(at_[vertex], [robot](const BookedBy& b) { return b.robot == robot; });
    }
    of_[robot].clear();
}

Gap BookingTable::gap(VertexId vertex, std::int32_t k) const {
    const auto& here = at_[vertex];
    Gap gap{-infinity, infinity, -1, -1};
    if (k > 0) {
        gap.start = here[k - 1].time.end;
        gap.before = here[k - 1].robot;
    }
    if (static_cast<std::size_t>(k) < here.size()) {
        gap.end = here[k].time.start;
        gap.after = here[k].robot;
    }
    return gap;
}

std::int32_t BookingTable::first_gap_after(VertexId vertex, Tick time) const {
    const auto& here = at_[vertex];
    const auto next = std::upper_bound(here.begin(), here.end(), time,
                                       [](Tick t, const BookedBy& b) { return t < b.time.start; });
    return static_cast<std::int32_t>(next - here.begin());
}

}  // namespace rightofway

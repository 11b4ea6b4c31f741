#include "search/booking_table.hpp"

#include <algorithm>
#include <string>

#include "core/reject.hpp"

namespace rightofway {
namespace {

constexpr std::int32_t most_rows = 1 << 26;  // that many take 0.8 GB

std::size_t checked_count(std::int32_t n_rows) {
    require_range("n_vertices", n_rows, 0, most_rows);
    return static_cast<std::size_t>(n_rows);
}

constexpr std::int32_t smallest_class = 2;

void require_interval(const Booking& time) {
    require_range("start", time.start, -never, never);
    require_range("end", time.end, -never, never);
    if (time.is_empty()) {
        reject("end", time.end, "is not after start, " + std::to_string(time.start));
    }
}

// The first booking of another robot that overlaps `time`, or nullptr.
const BookedBy* overlapping(std::span<const BookedBy> here, const Booking& time, RobotId robot) {
    const BookedBy* found = nullptr;
    BookingTable::any_overlap(here, time, [&](const BookedBy& one) {
        found = one.robot != robot ? &one : found;
        return false;
    });
    return found;
}

}  // namespace

BookingTable::BookingTable(std::int32_t n_rows) : rows_(checked_count(n_rows)) {}

void BookingTable::book(std::int32_t row, const Booking& time, RobotId robot) {
    require_id("vertex", row, n_rows());
    if (robot < 0) {
        reject("robot", robot, "is negative");
    }
    require_interval(time);
    if (const BookedBy* other = overlapping(at(row), time, robot)) {
        reject("start", time.start,
               "overlaps a booking of vertex " + std::to_string(row) + " by robot " +
                   std::to_string(other->robot));
    }
    insert(row, time, robot);
}

void BookingTable::mark(std::int32_t row, const Booking& time, RobotId robot) {
    require_id("row", row, n_rows());
    if (robot < nobody) {
        reject("robot", robot, "is no robot, and not -1 for nobody");
    }
    require_interval(time);
    insert(row, time, robot);
}

void BookingTable::insert(std::int32_t row, const Booking& time, RobotId robot) {
    has_closures_ |= robot == nobody;
    Row& one = rows_[index(row)];
    if (one.size_class < 0 || one.size == (std::int32_t{1} << one.size_class)) {
        grow(one);
    }
    BookedBy* here = pool_.data() + one.first;
    std::int32_t k = one.size++;
    for (; k > 0 && here[k - 1].time.start > time.start; --k) {
        here[k] = here[k - 1];
        here[k].reach = std::max(here[k].reach, time.end);
    }
    here[k] = {time, k > 0 ? std::max(here[k - 1].reach, time.end) : time.end, robot};
}

void BookingTable::erase(std::int32_t row, Tick start, RobotId robot) {
    Row& one = rows_[index(row)];
    BookedBy* here = pool_.data() + one.first;
    std::int32_t k = started(at(row), start) - 1;
    while (k >= 0 && here[k].time.start == start && here[k].robot != robot) {
        --k;
    }
    if (k < 0 || here[k].time.start != start) {
        return;
    }
    Tick reach = k > 0 ? here[k - 1].reach : -never;
    --one.size;
    for (; k < one.size; ++k) {
        here[k] = here[k + 1];
        reach = here[k].reach = std::max(reach, here[k].time.end);
    }
}

void BookingTable::grow(Row& row) {
    const std::int32_t wanted = row.size_class < 0 ? smallest_class : row.size_class + 1;
    auto& unused = unused_[index(wanted)];
    std::uint32_t place = static_cast<std::uint32_t>(pool_.size());
    if (unused.empty()) {
        pool_.resize(pool_.size() + (std::size_t{1} << wanted));
    } else {
        place = unused.back();
        unused.pop_back();
    }
    std::copy_n(pool_.begin() + row.first, row.size, pool_.begin() + place);
    if (row.size_class >= 0) {
        unused_[index(row.size_class)].push_back(row.first);
    }
    row.first = place;
    row.size_class = wanted;
}

}  // namespace rightofway

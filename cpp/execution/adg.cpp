#include "execution/adg.hpp"

#include <string>

#include "core/reject.hpp"

namespace rightofway {
namespace {

// Upper limit of a duration in ticks: the sum over 2^31 visits stays below `never`.
constexpr Tick longest = Tick{1} << 31;

void check_ticks(const std::string& name, const std::vector<Tick>& ticks, Tick most) {
    for (std::size_t x = 0; x < ticks.size(); ++x) {
        if (ticks[x] < 0 || ticks[x] >= most) {
            reject_entry(name, x, ticks[x], "is not in 0.." + std::to_string(most - 1));
        }
    }
}

}  // namespace

ActionDependencyGraph::ActionDependencyGraph(const AdgArrays& arrays)
    : first_visit_(arrays.first_visit.begin(), arrays.first_visit.end()),
      vertex_(arrays.vertex.begin(), arrays.vertex.end()),
      planned_(arrays.planned.begin(), arrays.planned.end()),
      dwell_(arrays.dwell.begin(), arrays.dwell.end()),
      drive_(arrays.drive.begin(), arrays.drive.end()),
      since_(arrays.since.begin(), arrays.since.end()),
      first_right_(arrays.first_right.begin(), arrays.first_right.end()),
      rights_(arrays.rights.begin(), arrays.rights.end()),
      headway_(arrays.headway),
      books_ahead_(arrays.books_ahead) {
    require_length("planned", planned_.size(), vertex_.size());
    require_length("dwell", dwell_.size(), vertex_.size());
    require_length("drive", drive_.size(), vertex_.size());
    if (!since_.empty()) {
        require_length("since", since_.size(), vertex_.size());
    }
    number_robots();
    incompatible_ = IncompatibleVisits(robot_, arrays.rows);
    closures_ = VisitClosures(arrays.closures, vertex_.size());
    check();
    works_ = VisitWorks(arrays.works, dwell_, static_cast<std::size_t>(n_robots()));
}

WorkId ActionDependencyGraph::completing_work(RobotId robot) const {
    const WorkId end = works_.end_of(last_of(robot));
    const bool ends = works_.ends_with_work(robot) && end > works_.first_of(first_of(robot));
    return ends ? end - 1 : none;
}

Tick ActionDependencyGraph::planned_completion(RobotId robot) const {
    const VisitId last = last_of(robot);
    if (const WorkId work = completing_work(robot); work != none) {
        return works_.planned(work) + works_.ticks(work);
    }
    const WorkId work = works_.end_of(last) - 1;
    return work < works_.first_of(last) ? planned(last) + dwell(last)
                                        : works_.planned(work) + works_.ticks(work) + turn(last);
}

void ActionDependencyGraph::number_robots() {
    require_lists("first_visit", first_visit_, vertex_.size(), "visits", 1);
    robot_.resize(vertex_.size());
    for (RobotId r = 0; r < n_robots(); ++r) {
        for (VisitId x = first_of(r); x <= last_of(r); ++x) {
            robot_[index(x)] = r;
        }
    }
}

void ActionDependencyGraph::check() const {
    check_ticks("planned", planned_, never);
    check_ticks("dwell", dwell_, longest);
    check_ticks("drive", drive_, longest);
    check_ticks("since", since_, never);
    if (headway_ < 0 || headway_ >= longest) {
        reject("headway", headway_, "is not in 0.." + std::to_string(longest - 1));
    }
    check_rights();
    if (has_sizes() && !books_ahead_) {
        throw std::invalid_argument("books_ahead: robots with sizes book ahead");
    }
}

void ActionDependencyGraph::check_rights() const {
    require_length("first_right", first_right_.size(), vertex_.size() + 1);
    require_lists("first_right", first_right_, rights_.size(), "rights");
    require_ids("rights", rights_, n_visits());
    for (VisitId x = 0; x < n_visits() && !has_sizes(); ++x) {
        for (const VisitId& other : before(x)) {
            if (vertex_[index(other)] != vertex_[index(x)] || is_first(x)) {
                reject_entry("rights", static_cast<std::size_t>(&other - rights_.data()), other,
                             "is at another vertex, or before a first visit");
            }
        }
    }
}

}  // namespace rightofway

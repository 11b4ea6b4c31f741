#include "execution/executed_conflicts.hpp"

#include <algorithm>
#include <map>
#include <span>
#include <utility>

namespace rightofway {
namespace {

// Fast on nearly sorted visits.
template <class Key>
void insertion_sort(std::span<VisitId> visits, Key&& key) {
    for (std::size_t k = 1; k < visits.size(); ++k) {
        const VisitId visit = visits[k];
        const auto its_key = key(visit);
        std::size_t at = k;
        for (; at > 0 && key(visits[at - 1]) > its_key; --at) {
            visits[at] = visits[at - 1];
        }
        visits[at] = visit;
    }
}

}  // namespace

ExecutedConflicts::ExecutedConflicts(const ActionDependencyGraph& plan) : plan_(plan) {
    if (plan.has_sizes()) {
        return;
    }
    const auto gather = [this](auto&& by_place, Groups& groups) {
        for (auto& [place, visits] : by_place) {
            const RobotId robot = plan_.robot(visits.front());
            if (std::all_of(visits.begin(), visits.end(),
                            [&](VisitId x) { return plan_.robot(x) == robot; })) {
                continue;
            }
            std::stable_sort(visits.begin(), visits.end(), [this](VisitId left, VisitId right) {
                return plan_.planned(left) < plan_.planned(right);
            });
            groups.visit.insert(groups.visit.end(), visits.begin(), visits.end());
            groups.first.push_back(groups.visit.size());
        }
    };
    std::map<VertexId, std::vector<VisitId>> by_vertex;
    std::map<std::pair<VertexId, VertexId>, std::vector<VisitId>> by_edge;
    for (VisitId x = 0; x < plan_.n_visits(); ++x) {
        by_vertex[plan_.vertex(x)].push_back(x);
        if (!plan_.is_first(x)) {
            by_edge[std::minmax({plan_.vertex(x - 1), plan_.vertex(x)})].push_back(x);
        }
    }
    gather(by_vertex, at_vertex_);
    gather(by_edge, on_edge_);
}

ConflictCount ExecutedConflicts::count(const ActualTimes& times) {
    ConflictCount found;
    if (plan_.has_sizes()) {
        count_incompatible(times, found);
    }
    for (std::size_t group = 0; group + 1 < at_vertex_.first.size(); ++group) {
        count_at_vertex(group, times, found);
    }
    for (std::size_t group = 0; group + 1 < on_edge_.first.size(); ++group) {
        count_on_edge(group, times, found);
    }
    return found;
}

// All incompatible visits book ahead: a swap is an overlap of bookings.
void ExecutedConflicts::count_incompatible(const ActualTimes& times, ConflictCount& found) const {
    const auto starts = [&](VisitId x) {
        return BookingStarts{times.start[index(x)],
                             plan_.is_last(x) ? never : times.start[index(x + 1)]};
    };
    const Tick headway = plan_.headway();
    for (VisitId one = 0; one < plan_.n_visits(); ++one) {
        for (const IncompatibleVisit& other : plan_.incompatible(one)) {
            if (other.visit < one) {
                continue;
            }
            const Tick begin = other.bookings.begin(starts(one), starts(other.visit));
            const Tick end = std::min(leave(one, times), leave(other.visit, times));
            if (begin < never && begin < end + headway) {
                ++(begin < end ? found.vertex : found.headway);
                found.first = std::min(found.first, begin);
            }
        }
    }
}

void ExecutedConflicts::count_at_vertex(std::size_t group, const ActualTimes& times,
                                        ConflictCount& found) {
    const std::span<VisitId> visits{&at_vertex_.visit[at_vertex_.first[group]],
                                    at_vertex_.first[group + 1] - at_vertex_.first[group]};
    insertion_sort(visits, [&](VisitId x) { return times.start[index(x)]; });
    for (std::size_t k = 0; k < visits.size(); ++k) {
        const VisitId one = visits[k];
        const Tick left = leave(one, times);
        for (std::size_t m = k + 1; m < visits.size(); ++m) {
            const VisitId other = visits[m];
            const Tick start = times.start[index(other)];
            if (start >= never || start >= left + plan_.headway()) {
                break;
            }
            const bool lasts = times.start[index(one)] < left + plan_.headway() &&
                               start < leave(other, times) + plan_.headway();
            if (lasts && plan_.robot(one) != plan_.robot(other)) {
                ++(start < left ? found.vertex : found.headway);
                found.first = std::min(found.first, start);
            }
        }
    }
}

void ExecutedConflicts::count_on_edge(std::size_t group, const ActualTimes& times,
                                      ConflictCount& found) {
    const std::span<VisitId> visits{&on_edge_.visit[on_edge_.first[group]],
                                    on_edge_.first[group + 1] - on_edge_.first[group]};
    insertion_sort(visits, [&](VisitId x) { return times.enter[index(x)]; });
    for (std::size_t k = 0; k < visits.size(); ++k) {
        const Tick instant = times.enter[index(visits[k])];
        for (std::size_t m = k + 1; m < visits.size(); ++m) {
            const VisitId one = visits[k];
            const VisitId other = visits[m];
            if (instant >= never || times.enter[index(other)] != instant) {
                break;
            }
            if (plan_.robot(one) != plan_.robot(other) &&
                plan_.vertex(one) != plan_.vertex(other)) {
                ++found.swap;
                found.first = std::min(found.first, instant);
            }
        }
    }
}

}  // namespace rightofway

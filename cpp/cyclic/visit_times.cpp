#include "cyclic/visit_times.hpp"

#include <algorithm>

namespace rightofway {

VisitTimes::VisitTimes(const CyclicRoutes& routes)
    : routes_(routes), lines_(static_cast<std::size_t>(routes.n_robots())) {
    for (RobotId r = 0; r < routes.n_robots(); ++r) {
        add(r, 0);
    }
}

Tick VisitTimes::enter(CyclicVisit visit) const {
    const Line& line = lines_[index(visit.robot)];
    const auto next = std::upper_bound(line.late.begin(), line.late.end(), visit.number);
    const Tick waited =
        next == line.late.begin() ? 0 : line.waited[index(next - line.late.begin() - 1)];
    return routes_.unimpeded_enter(visit) + waited;
}

void VisitTimes::add(RobotId robot, Tick enter) {
    Line& line = lines_[index(robot)];
    const CyclicVisit visit{robot, line.n_started++};
    const Tick waited = enter - line.free;
    if (waited > (line.waited.empty() ? 0 : line.waited.back())) {
        line.late.push_back(visit.number);
        line.waited.push_back(waited);
    }
    line.free += routes_.least(visit);
}

void VisitTimes::truncate(RobotId robot, std::int32_t n_started) {
    Line& line = lines_[index(robot)];
    line.n_started = n_started;
    line.free = routes_.unimpeded_enter({robot, n_started});
    const auto kept = std::lower_bound(line.late.begin(), line.late.end(), n_started);
    line.waited.resize(static_cast<std::size_t>(kept - line.late.begin()));
    line.late.erase(kept, line.late.end());
}

}  // namespace rightofway

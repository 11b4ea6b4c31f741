#include "execution/lateness.hpp"

#include <algorithm>

namespace rightofway {

LatenessSources::LatenessSources(const ActionDependencyGraph& plan)
    : plan_(plan),
      own_(static_cast<std::size_t>(plan.n_visits()), 0),
      of_others_(static_cast<std::size_t>(plan.n_visits()), 0) {}

void LatenessSources::add(const ActualTimes& times) {
    const auto late = [&](VisitId x) {
        return std::max<Tick>(times.enter[x] - plan_.planned(x), 0);
    };
    for (RobotId r = 0; r < plan_.n_robots(); ++r) {
        if (times.completion[r] >= never) {
            continue;
        }
        VisitId x = plan_.last_of(r);
        VisitId to_blame = x;
        Tick left = times.completion[r] - plan_.planned_completion(r);
        while (left > 0) {
            const Tick before = std::min(late(x), left);
            charge(r, to_blame, left - before);
            left = before;
            to_blame = times.to_blame[x];
            x = times.cause[x];
        }
    }
}

void LatenessSources::charge(RobotId robot, VisitId to_blame, Tick ticks) {
    const RobotId other = plan_.robot(to_blame);
    if (ticks == 0) {
        return;
    }
    if (other == robot) {
        own_[to_blame] += ticks;
        return;
    }
    of_others_[to_blame] += ticks;
    between_[static_cast<std::int64_t>(robot) * plan_.n_robots() + other] += ticks;
}

}  // namespace rightofway

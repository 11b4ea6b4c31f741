// All times of the past, by the few visits that were late.
//
// A visit begins when it would if nobody was ever in the way, plus all that its robot has waited.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/types.hpp"
#include "cyclic/cyclic_routes.hpp"

namespace rightofway {

class VisitTimes {
  public:
    explicit VisitTimes(const CyclicRoutes& routes);

    std::int32_t n_begun(RobotId robot) const { return lines_[robot].n_begun; }
    Tick enter(CyclicVisit visit) const;  // of a visit that has begun

    void add(RobotId robot, Tick enter);  // of the next visit
    void cut(RobotId robot, std::int32_t n_begun);

    // The visits that were late, and how much their robots had waited by then.
    std::span<const std::int32_t> late(RobotId robot) const { return lines_[robot].late; }
    std::span<const Tick> waited(RobotId robot) const { return lines_[robot].waited; }

  private:
    struct Line {
        std::int32_t n_begun = 0;
        Tick free = 0;  // when the next visit would begin
        std::vector<std::int32_t> late;
        std::vector<Tick> waited;
    };

    const CyclicRoutes& routes_;
    std::vector<Line> lines_;
};

}  // namespace rightofway

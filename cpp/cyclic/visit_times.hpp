// The enters of all past visits, stored by the few visits that had to wait.
//
// A visit's enter is that of a robot that never waits, plus all ticks that its robot has waited.
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

    std::int32_t n_started(RobotId robot) const { return lines_[robot].n_started; }
    Tick enter(CyclicVisit visit) const;  // of a visit that has started

    void add(RobotId robot, Tick enter);  // of the next visit
    void truncate(RobotId robot, std::int32_t n_started);

    // The visits that had to wait, and the ticks that the robot had waited by then in all.
    std::span<const std::int32_t> late(RobotId robot) const { return lines_[robot].late; }
    std::span<const Tick> waited(RobotId robot) const { return lines_[robot].waited; }

  private:
    struct Line {
        std::int32_t n_started = 0;
        Tick free = 0;  // the next visit's enter without any wait
        std::vector<std::int32_t> late;
        std::vector<Tick> waited;
    };

    const CyclicRoutes& routes_;
    std::vector<Line> lines_;
};

}  // namespace rightofway

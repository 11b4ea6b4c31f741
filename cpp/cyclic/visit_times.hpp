// The enters of all past visits, stored as the waits only: an enter is the unimpeded enter plus all
// ticks that the robot has waited.
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

    std::int32_t n_started(RobotId robot) const { return lines_[index(robot)].n_started; }
    Tick enter(CyclicVisit visit) const;  // of a visit that has started

    void add(RobotId robot, Tick enter);  // of the next visit
    void truncate(RobotId robot, std::int32_t n_started);

    // The visits with a wait, and the total ticks of waiting of the robot up to each of them.
    std::span<const std::int32_t> late(RobotId robot) const { return lines_[index(robot)].late; }
    std::span<const Tick> waited(RobotId robot) const { return lines_[index(robot)].waited; }

  private:
    struct Line {
        std::int32_t n_started = 0;
        Tick free = 0;  // unimpeded enter of the next visit
        std::vector<std::int32_t> late;
        std::vector<Tick> waited;
    };

    const CyclicRoutes& routes_;
    std::vector<Line> lines_;
};

}  // namespace rightofway

// Jobs and robots on a line of places, a tick apart: the problems of the tests of tours.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <vector>

#include "tours/tour_problem.hpp"

namespace rightofway {

struct LineStop {
    std::int32_t place;
    Tick work = 0;
    std::int32_t load = 0;
    Tick earliest = 0;
    Tick latest = never;
};

struct LineJob {
    std::vector<LineStop> stops;
    Tick due = never;
    std::vector<std::int32_t> after = {};
    RobotId begun_by = nobody;
};

struct LineRobot {
    std::int32_t start = 0;
    std::int32_t end = -1;
    std::int32_t capacity = 1;
    std::int64_t soc = -1;  // -1: no battery
};

// Batteries of 20 that lose 1 per place and gain 4 per tick, with a reserve of 2, at place 0.
inline std::unique_ptr<TourProblem> make_line(const std::vector<LineJob>& jobs,
                                              const std::vector<LineRobot>& robots,
                                              TourObjective objective) {
    constexpr std::int32_t n = 21;
    std::vector<std::int32_t> ticks;
    std::vector<std::int64_t> drains;
    std::vector<std::int64_t> to_charging;
    for (std::int32_t from = 0; from < n; ++from) {
        to_charging.push_back(from);
        for (std::int32_t to = 0; to < n; ++to) {
            ticks.push_back(std::abs(from - to));
            drains.push_back(std::abs(from - to));
        }
    }
    std::vector<std::int32_t> battery;
    std::vector<std::int32_t> start;
    std::vector<std::int32_t> end;
    std::vector<std::int32_t> capacity;
    std::vector<std::int64_t> soc;
    for (const LineRobot& robot : robots) {
        battery.push_back(robot.soc < 0 ? -1 : 0);
        start.push_back(robot.start);
        end.push_back(robot.end);
        capacity.push_back(robot.capacity);
        soc.push_back(robot.soc < 0 ? 0 : robot.soc);
    }
    const std::vector<std::int32_t> zeros(robots.size(), 0);
    const std::vector<std::int64_t> no_ticks(robots.size(), 0);
    const std::vector<std::int64_t> ones(robots.size(), 1);
    std::vector<std::int32_t> first_stop{0};
    std::vector<std::int32_t> place;
    std::vector<Tick> work;
    std::vector<std::int32_t> load;
    std::vector<Tick> earliest;
    std::vector<Tick> latest;
    std::vector<Tick> release;
    std::vector<Tick> due;
    std::vector<std::int32_t> begun_by;
    std::vector<std::int32_t> first_robot{0};
    std::vector<std::int32_t> allowed;
    std::vector<std::int32_t> first_after{0};
    std::vector<std::int32_t> after;
    for (const LineJob& job : jobs) {
        for (const LineStop& stop : job.stops) {
            place.push_back(stop.place);
            work.push_back(stop.work);
            load.push_back(stop.load);
            earliest.push_back(stop.earliest);
            latest.push_back(stop.latest);
        }
        first_stop.push_back(static_cast<std::int32_t>(place.size()));
        release.push_back(job.stops.front().earliest);
        due.push_back(job.due);
        begun_by.push_back(job.begun_by);
        for (RobotId robot = 0; index(robot) < robots.size(); ++robot) {
            if (job.begun_by == nobody || job.begun_by == robot) {
                allowed.push_back(robot);
            }
        }
        first_robot.push_back(static_cast<std::int32_t>(allowed.size()));
        after.insert(after.end(), job.after.begin(), job.after.end());
        first_after.push_back(static_cast<std::int32_t>(after.size()));
    }
    const std::vector<std::int64_t> weights(jobs.size(), 1);
    const std::vector<std::int64_t> full{20};
    const std::vector<std::int32_t> tables{0};
    const std::vector<std::int64_t> none_used{0};
    const std::vector<std::int64_t> charge{4};
    const std::vector<std::int64_t> reserve{2};
    const std::vector<std::int32_t> first_charging{0, 1};
    const std::vector<std::int32_t> charging{0};
    return std::make_unique<TourProblem>(
        TravelArrays{n, ticks},
        TourRobotArrays{zeros, battery, start, end, no_ticks, capacity, zeros, soc, ones},
        TourJobArrays{first_stop, place, work, load, earliest, latest, weights, release, due,
                      begun_by, first_robot, allowed, first_after, after},
        BatteryArrays{full, none_used, none_used, charge, reserve, tables, drains, to_charging,
                      first_charging, charging},
        objective, 1, 10);
}

}  // namespace rightofway

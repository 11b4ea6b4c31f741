// Who may do which job, how long drives take, and the objective: the input of the search for tours.
//
// Places are numbered 0 .. P - 1. Robots of one kind share a table of travel ticks; batteries of
// one kind share their numbers, a table of energies and the charging places. All energies are whole
// numbers over one denominator.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/types.hpp"

namespace rightofway {

enum class TourObjective : std::int32_t { service, flowtime, makespan, both };

// Ticks of drives between places, for each kind of travel P * P entries; -1 where no way exists.
struct TravelArrays {
    std::int32_t n_places = 0;
    std::span<const std::int32_t> ticks;
};

// One entry for each robot.
struct TourRobotArrays {
    std::span<const std::int32_t> travel;   // kind of travel
    std::span<const std::int32_t> battery;  // kind of battery, -1: none
    std::span<const std::int32_t> start;
    std::span<const std::int32_t> end;  // -1: it rests at its last stop
    std::span<const Tick> ready;
    std::span<const std::int32_t> capacity;
    std::span<const std::int32_t> load;  // on board at `ready`
    std::span<const std::int64_t> soc;   // at `ready`
    std::span<const std::int64_t> weight;
};

struct TourJobArrays {
    std::span<const std::int32_t> first_stop;  // job j has the stops first_stop[j] .. [j + 1] - 1
    std::span<const std::int32_t> place;
    std::span<const Tick> work;
    std::span<const std::int32_t> load;
    std::span<const Tick> earliest;
    std::span<const Tick> latest;  // of the end of work; `never`: none
    std::span<const std::int64_t> weight;
    std::span<const Tick> release;           // the service time counts from here
    std::span<const Tick> due;               // `never`: none
    std::span<const std::int32_t> begun_by;  // the robot that has begun it, -1: none
    std::span<const std::int32_t> first_robot;
    std::span<const std::int32_t> robots;  // those that may and can do it
    std::span<const std::int32_t> first_after;
    std::span<const std::int32_t> after;  // jobs that end before it begins
};

// One entry for each kind of battery. Kinds that differ in their charging places alone share a
// table of drives: where each robot charges only at home, a table for each kind would fill the
// memory.
struct BatteryArrays {
    std::span<const std::int64_t> full;
    std::span<const std::int64_t> on;
    std::span<const std::int64_t> work;
    std::span<const std::int64_t> charge;  // per tick
    std::span<const std::int64_t> reserve;
    std::span<const std::int32_t> table;        // of its drives
    std::span<const std::int64_t> drive;        // P * P for each table, of the quickest way
    std::span<const std::int64_t> to_charging;  // P for each kind, least; above full: no way
    std::span<const std::int32_t> first_charging;
    std::span<const std::int32_t> charging;
};

struct TourStop {
    std::int32_t job;
    std::int32_t place;
    std::int32_t load;
    bool is_first;
    bool is_last;
    Tick work;
    Tick earliest;
    Tick latest;
};

struct TourJob {
    std::int32_t first_stop;
    std::int32_t n_stops;
    std::int64_t weight;
    Tick release;
    Tick due;
    RobotId begun_by;
    std::vector<RobotId> robots;
    std::vector<std::int32_t> after;
    std::vector<std::int32_t> before;  // the jobs that come after it
};

struct TourBattery {
    std::int64_t full;
    std::int64_t on;
    std::int64_t work;
    std::int64_t charge;
    std::int64_t reserve;
    std::span<const std::int64_t> drive;
    std::span<const std::int64_t> to_charging;
    std::span<const std::int32_t> charging;
};

struct TourRobot {
    std::span<const std::int32_t> ticks;  // P * P
    std::int32_t battery;
    std::int32_t start;
    std::int32_t end;
    Tick ready;
    std::int32_t capacity;
    std::int32_t load;
    std::int64_t soc;
    std::int64_t weight;
};

// What tours are compared by: the first number that differs decides.
struct TourCost {
    std::int64_t n_missing = 0;  // begun jobs that are in no tour
    std::int64_t unserved = 0;   // weights of the other jobs in no tour
    std::int64_t value = 0;      // the objective
    std::int64_t flowtime = 0;   // with weights of robots

    auto operator<=>(const TourCost&) const = default;
};

class TourProblem {
  public:
    // Copies all arrays. Throws std::invalid_argument with array, index and value, and
    // std::overflow_error where costs might not fit 64 bits. A tick of service costs `unit` per
    // weight, a tick past `due` costs `late` more.
    TourProblem(const TravelArrays& travel, const TourRobotArrays& robots,
                const TourJobArrays& jobs, const BatteryArrays& batteries, TourObjective objective,
                std::int64_t unit, std::int64_t late);
    TourProblem(const TourProblem&) = delete;
    TourProblem& operator=(const TourProblem&) = delete;

    std::int32_t n_places() const { return n_places_; }
    std::size_t n_jobs() const { return jobs_.size(); }
    std::size_t n_robots() const { return robots_.size(); }
    TourObjective objective() const { return objective_; }
    bool has_after() const { return has_after_; }
    std::int64_t robot_weights() const { return robot_weights_; }
    // What a tick of the makespan counts in a sum with the flowtime: it decides, but the search
    // still sees which tours are short.
    double makespan_weight() const {
        const auto weights = static_cast<double>(robot_weights_);
        return objective_ == TourObjective::makespan ? 20 * weights : weights;
    }
    Tick horizon() const { return horizon_; }  // no tour that waits only where it must ends later

    const TourStop& stop(std::int32_t stop) const { return stops_[index(stop)]; }
    const TourJob& job(std::int32_t job) const { return jobs_[index(job)]; }
    const TourRobot& robot(RobotId robot) const { return robots_[index(robot)]; }
    const TourBattery& battery(std::int32_t kind) const { return batteries_[index(kind)]; }
    std::span<const TourStop> stops_of(const TourJob& job) const {
        return {stops_.data() + job.first_stop, index(job.n_stops)};
    }

    // The ticks of a drive; far beyond the horizon where no way exists.
    Tick drive(const TourRobot& robot, std::int32_t from, std::int32_t to) const {
        const std::int32_t ticks = robot.ticks[index(from) * index(n_places_) + index(to)];
        return ticks < 0 ? no_way : ticks;
    }
    std::int64_t drain(const TourBattery& battery, std::int32_t from, std::int32_t to) const {
        return battery.drive[index(from) * index(n_places_) + index(to)];
    }
    bool may_do(RobotId robot, std::int32_t job) const {
        return may_do_[index(job) * robots_.size() + index(robot)] != 0;
    }

    // The cost of a job that ends at this tick under `service`, and of one more tick.
    std::int64_t service(const TourJob& job, Tick end) const {
        const Tick late = end > job.due ? end - job.due : 0;
        return job.weight * (unit_ * (end - job.release) + late_ * late);
    }
    std::int64_t service_slope(const TourJob& job, Tick end) const {
        return job.weight * (end >= job.due ? unit_ + late_ : unit_);
    }

    static constexpr Tick no_way = Tick{1} << 50;

  private:
    void take_robots(const TourRobotArrays& robots, std::size_t n_kinds);
    void take_jobs(const TourJobArrays& jobs);
    void take_batteries(const BatteryArrays& batteries);
    void bound_costs();

    std::int32_t n_places_;
    TourObjective objective_;
    std::int64_t unit_;
    std::int64_t late_;
    std::vector<std::int32_t> ticks_;
    std::vector<std::int64_t> drains_;
    std::vector<std::int64_t> to_charging_;
    std::vector<std::int32_t> charging_;
    std::vector<TourStop> stops_;
    std::vector<TourJob> jobs_;
    std::vector<TourRobot> robots_;
    std::vector<TourBattery> batteries_;
    std::vector<std::uint8_t> may_do_;
    std::int64_t robot_weights_ = 0;
    Tick horizon_ = 0;
    bool has_after_ = false;
};

}  // namespace rightofway

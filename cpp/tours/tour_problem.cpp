#include "tours/tour_problem.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "core/reject.hpp"

namespace rightofway {
namespace {

constexpr Tick latest_tick = Tick{1} << 40;
constexpr std::int64_t most_energy = std::int64_t{1} << 55;

void require_kinds(const char* name, std::span<const std::int32_t> kinds, std::size_t count,
                   std::int32_t least) {
    require_ranges(name, kinds, least, static_cast<std::int64_t>(count) - 1);
}

void require_ticks(const char* name, std::span<const Tick> ticks, std::size_t length) {
    require_length(name, ticks.size(), length);
    require_ranges(name, ticks, 0, latest_tick);
}

// Ticks, or `never`.
void require_limits(const char* name, std::span<const Tick> ticks, std::size_t length) {
    require_length(name, ticks.size(), length);
    for (std::size_t k = 0; k < ticks.size(); ++k) {
        if (ticks[k] != never) {
            require_range(std::string(name) + "[" + std::to_string(k) + "]", ticks[k], 0,
                          latest_tick);
        }
    }
}

// Throws if jobs wait for each other in a circle.
void require_order(std::span<const TourJob> jobs) {
    std::vector<std::size_t> n_open(jobs.size());
    std::vector<std::size_t> ready;
    for (std::size_t j = 0; j < jobs.size(); ++j) {
        n_open[j] = jobs[j].after.size();
        if (n_open[j] == 0) {
            ready.push_back(j);
        }
    }
    for (std::size_t k = 0; k < ready.size(); ++k) {
        for (const std::int32_t later : jobs[ready[k]].before) {
            if (--n_open[index(later)] == 0) {
                ready.push_back(index(later));
            }
        }
    }
    if (ready.size() != jobs.size()) {
        throw std::invalid_argument("after: jobs wait for each other in a circle");
    }
}

}  // namespace

TourProblem::TourProblem(const TravelArrays& travel, const TourRobotArrays& robots,
                         const TourJobArrays& jobs, const BatteryArrays& batteries,
                         TourObjective objective, std::int64_t unit, std::int64_t late)
    : n_places_(travel.n_places),
      objective_(objective),
      unit_(unit),
      late_(late),
      ticks_(travel.ticks.begin(), travel.ticks.end()) {
    require_range("n_places", travel.n_places, 1, 1 << 20);
    require_range("unit", unit, 1, most_energy);
    require_range("late", late, 0, most_energy);
    const std::size_t pairs = index(n_places_) * index(n_places_);
    if (ticks_.empty() || ticks_.size() % pairs != 0) {
        throw std::invalid_argument("ticks: its length is " + std::to_string(ticks_.size()) +
                                    ", but must be a multiple of " + std::to_string(pairs));
    }
    require_ranges("ticks", std::span<const std::int32_t>(ticks_), -1, never);
    take_batteries(batteries);
    take_robots(robots, ticks_.size() / pairs);
    take_jobs(jobs);
    bound_costs();
}

void TourProblem::take_batteries(const BatteryArrays& given) {
    const std::size_t n = given.full.size();
    const std::size_t places = index(n_places_);
    for (const auto& [name, values] : {std::pair{"full", given.full},
                                       {"on", given.on},
                                       {"battery_work", given.work},
                                       {"charge", given.charge},
                                       {"reserve", given.reserve}}) {
        require_length(name, values.size(), n);
        require_ranges(name, values, 0, most_energy);
    }
    const std::size_t pairs = places * places;
    const std::size_t n_tables = pairs == 0 ? 0 : given.drive.size() / pairs;
    require_length("drive", given.drive.size(), n_tables * pairs);
    require_length("table", given.table.size(), n);
    require_kinds("table", given.table, n_tables, 0);
    require_ranges("drive", given.drive, 0, most_energy);
    require_length("to_charging", given.to_charging.size(), n * places);
    require_ranges("to_charging", given.to_charging, 0, most_energy);
    require_length("first_charging", given.first_charging.size(), n + 1);
    require_lists("first_charging", given.first_charging, given.charging.size());
    require_ids("charging", given.charging, n_places_);
    drains_.assign(given.drive.begin(), given.drive.end());
    to_charging_.assign(given.to_charging.begin(), given.to_charging.end());
    charging_.assign(given.charging.begin(), given.charging.end());
    for (std::size_t k = 0; k < n; ++k) {
        const auto first = index(given.first_charging[k]);
        batteries_.push_back(
            {given.full[k], given.on[k], given.work[k], given.charge[k], given.reserve[k],
             std::span<const std::int64_t>(drains_).subspan(index(given.table[k]) * pairs, pairs),
             std::span<const std::int64_t>(to_charging_).subspan(k * places, places),
             std::span<const std::int32_t>(charging_).subspan(
                 first, index(given.first_charging[k + 1]) - first)});
    }
}

void TourProblem::take_robots(const TourRobotArrays& given, std::size_t n_kinds) {
    const std::size_t n = given.travel.size();
    require_range("robots", static_cast<std::int64_t>(n), 1, 1 << 20);
    require_kinds("travel", given.travel, n_kinds, 0);
    for (const auto& [name, values] : {std::pair{"battery", given.battery},
                                       {"start", given.start},
                                       {"end", given.end},
                                       {"capacity", given.capacity},
                                       {"robot_load", given.load}}) {
        require_length(name, values.size(), n);
    }
    require_kinds("battery", given.battery, batteries_.size(), -1);
    require_ids("start", given.start, n_places_);
    require_ranges("end", given.end, -1, n_places_ - 1);
    require_ticks("ready", given.ready, n);
    require_ranges("capacity", given.capacity, 0, 1 << 30);
    require_ranges("robot_load", given.load, 0, 1 << 30);
    require_length("soc", given.soc.size(), n);
    require_ranges("soc", given.soc, 0, most_energy);
    require_length("robot_weight", given.weight.size(), n);
    require_ranges("robot_weight", given.weight, 0, most_energy);
    const std::size_t pairs = index(n_places_) * index(n_places_);
    for (std::size_t r = 0; r < n; ++r) {
        robots_.push_back(
            {std::span<const std::int32_t>(ticks_).subspan(index(given.travel[r]) * pairs, pairs),
             given.battery[r], given.start[r], given.end[r], given.ready[r], given.capacity[r],
             given.load[r], given.soc[r], given.weight[r]});
    }
}

void TourProblem::take_jobs(const TourJobArrays& given) {
    const std::size_t n = given.weight.size();
    const std::size_t n_stops = given.place.size();
    require_length("first_stop", given.first_stop.size(), n + 1);
    require_lists("first_stop", given.first_stop, n_stops, "stops", 1);
    require_ids("place", given.place, n_places_);
    require_ticks("work", given.work, n_stops);
    require_length("load", given.load.size(), n_stops);
    require_ranges("load", given.load, -(1 << 30), 1 << 30);
    require_ticks("earliest", given.earliest, n_stops);
    require_limits("latest", given.latest, n_stops);
    require_ranges("weight", given.weight, 1, most_energy);
    require_ticks("release", given.release, n);
    require_limits("due", given.due, n);
    const auto n_robots = static_cast<std::int64_t>(robots_.size());
    require_length("begun_by", given.begun_by.size(), n);
    require_ranges("begun_by", given.begun_by, -1, n_robots - 1);
    require_length("first_robot", given.first_robot.size(), n + 1);
    require_lists("first_robot", given.first_robot, given.robots.size());
    require_ids("robots", given.robots, n_robots);
    require_length("first_after", given.first_after.size(), n + 1);
    require_lists("first_after", given.first_after, given.after.size());
    require_ids("after", given.after, static_cast<std::int64_t>(n));
    may_do_.assign(n * robots_.size(), 0);
    for (std::size_t j = 0; j < n; ++j) {
        const auto robots = given.robots.subspan(
            index(given.first_robot[j]), index(given.first_robot[j + 1] - given.first_robot[j]));
        const auto after = given.after.subspan(
            index(given.first_after[j]), index(given.first_after[j + 1] - given.first_after[j]));
        for (const RobotId robot : robots) {
            may_do_[j * robots_.size() + index(robot)] = 1;
        }
        has_after_ = has_after_ || !after.empty();
        const std::int32_t first = given.first_stop[j];
        const std::int32_t last = given.first_stop[j + 1] - 1;
        for (std::int32_t s = first; s <= last; ++s) {
            const std::size_t k = index(s);
            stops_.push_back({static_cast<std::int32_t>(j), given.place[k], given.load[k],
                              s == first, s == last, given.work[k], given.earliest[k],
                              given.latest[k]});
        }
        jobs_.push_back({first,
                         last - first + 1,
                         given.weight[j],
                         given.release[j],
                         given.due[j],
                         given.begun_by[j],
                         {robots.begin(), robots.end()},
                         {after.begin(), after.end()},
                         {}});
    }
    for (std::size_t j = 0; j < n; ++j) {
        for (const std::int32_t earlier : jobs_[j].after) {
            jobs_[index(earlier)].before.push_back(static_cast<std::int32_t>(j));
        }
    }
    require_order(jobs_);
}

// Computes the horizon: all robots are ready, all stops are open, then everything in a row. With
// batteries each drive may lead over two charges.
void TourProblem::bound_costs() {
    const double longest = *std::max_element(ticks_.begin(), ticks_.end());
    double end = 0;
    for (const TourRobot& robot : robots_) {
        end = std::max(end, static_cast<double>(robot.ready));
        robot_weights_ += robot.weight;
    }
    for (const TourStop& stop : stops_) {
        end = std::max(end, static_cast<double>(stop.earliest));
    }
    double per_leg = longest;
    for (const TourBattery& battery : batteries_) {
        if (battery.charge > 0) {
            const double ticks =
                static_cast<double>(battery.full) / static_cast<double>(battery.charge) + 1;
            per_leg = std::max(per_leg, 3 * longest + 2 * ticks);
        }
    }
    end += per_leg * static_cast<double>(stops_.size() + 1);
    double weights = 0;
    for (const TourStop& stop : stops_) {
        end += static_cast<double>(stop.work);
    }
    for (const TourJob& job : jobs_) {
        weights += static_cast<double>(job.weight);
    }
    const double service = weights * (static_cast<double>(unit_) + static_cast<double>(late_));
    const double robots = 2 * static_cast<double>(robot_weights_);
    if (end >= 0x1p49 || end * std::max(service, robots) >= 0x1p61) {
        throw std::overflow_error(
            "costs of tours might not fit 64 bits (choose a coarser tick or simpler weights)");
    }
    horizon_ = static_cast<Tick>(end) + 1;
}

}  // namespace rightofway

#include "lns/lns.hpp"

#include <algorithm>

namespace rightofway {
namespace {

// Tasks per round: many, so that threads seldom wait; fewer in small fleets, where results of tasks
// would conflict.
constexpr std::size_t robots_per_task = 4;
constexpr std::size_t least_in_round = 4;
constexpr std::size_t most_in_round = 32;

constexpr Tick unlimited = Tick{1} << 61;

// A window extends by so many of the slowest edges of its robot to both sides of its middle.
constexpr std::array<Tick, 3> edges_around{8, 16, 32};
constexpr std::array<std::size_t, 3> sizes_of_windows{2, 4, 8};

}  // namespace

struct Lns::Worker {
    Worker(SharedDistances& distances, FleetPlan& own, std::span<const Tick> alone)
        : plan(own),
          search(distances.problem().roads(), distances.problem().rules()),
          reader(distances, true),
          neighbourhoods(distances, own, alone),
          windows(distances, own) {}

    FleetPlan& plan;
    SafeIntervalSearch search;
    TripReader reader;
    Neighbourhoods neighbourhoods;
    WindowSearch windows;
    TimedTrack found;
    StageLimits limits;
};

Lns::Lns(SharedDistances& distances, FleetPlan& plan, std::span<const Tick> alone,
         std::uint64_t seed, std::size_t n_threads)
    : plan_(plan),
      alone_(alone),
      longest_alone_(alone.empty() ? 0 : *std::max_element(alone.begin(), alone.end())),
      seed_(seed),
      is_touched_(alone.size(), 0),
      neighbourhood_(n_neighbourhood_kinds * sizes.size()),
      has_windows_(may_have_windows(plan.problem())),
      size_of_windows_(sizes_of_windows.size()),
      crew_(n_threads) {
    workers_.push_back(std::make_unique<Worker>(distances, plan_, alone));
    replicas_.reserve(n_threads);
    while (workers_.size() < n_threads) {
        replicas_.push_back(plan);
        workers_.push_back(std::make_unique<Worker>(distances, replicas_.back(), alone));
    }
    tasks_.resize(std::clamp(is_touched_.size() / robots_per_task, least_in_round, most_in_round));
}

Lns::~Lns() = default;

std::int64_t Lns::n_expanded() const {
    std::int64_t sum = 0;
    for (const auto& worker : workers_) {
        sum += worker->search.n_expanded() + worker->windows.n_expanded();
    }
    return sum;
}

void Lns::run(std::int64_t n_tasks, std::int64_t patience, const StopCondition& is_over,
              const StopCondition& is_due) {
    while (n_tasks > 0 && n_idle_ < patience) {
        const auto n = std::min<std::int64_t>(n_tasks, static_cast<std::int64_t>(tasks_.size()));
        round(static_cast<std::size_t>(n), is_over);
        settle(static_cast<std::size_t>(n));
        n_tasks -= n;
        if (crew_.is_stopped() || is_due()) {
            break;
        }
    }
    crew_.pass_on();
}

void Lns::round(std::size_t n, const StopCondition& is_over) {
    for (Task& task : tasks_) {
        task.gain = -1;
        task.effort = 0;
    }
    const auto work = [this](std::size_t worker, std::size_t task, const StopCondition& stop) {
        Random random(seed_, n_rounds_, task);
        attempt(*workers_[worker], tasks_[task], random, stop);
    };
    crew_.run(n, work, is_over);
    ++n_rounds_;
}

void Lns::attempt(Worker& worker, Task& task, Random& random, const StopCondition& is_over) {
    task.has_windows = has_windows_ && shares_.draw(random);
    task.neighbourhood = (task.has_windows ? size_of_windows_ : neighbourhood_).draw(random);
    const auto kind = task.has_windows
                          ? NeighbourhoodKind::window
                          : static_cast<NeighbourhoodKind>(task.neighbourhood / sizes.size());
    const std::size_t size = task.has_windows ? sizes_of_windows[task.neighbourhood]
                                              : sizes[task.neighbourhood % sizes.size()];
    task.robots = worker.neighbourhoods.choose(kind, size, random);
    const RobotId seed = task.robots.front();
    random.shuffle(task.robots);
    if (random.below(2) == 0) {  // the seed robot goes first
        std::swap(task.robots.front(), *std::find(task.robots.begin(), task.robots.end(), seed));
    }
    if (task.has_windows) {
        choose_windows(worker, task, random);
        const std::int64_t before = worker.windows.n_expanded();
        replan_windows(worker, task, is_over);
        task.effort = worker.windows.n_expanded() - before + 1;
        return;
    }
    const std::int64_t before = worker.search.n_expanded();
    replan(worker, task, is_over);
    task.effort = worker.search.n_expanded() - before + 1;
}

// Chooses a window of each robot of a task; robots that are done by then leave it.
void Lns::choose_windows(Worker& worker, Task& task, Random& random) const {
    const Tick edges = edges_around[random.below(edges_around.size())];
    const Tick middle = worker.neighbourhoods.middle();
    std::vector<RobotId> robots;
    task.windows.clear();
    for (const RobotId robot : task.robots) {
        const Tick around = edges * plan_.problem().slowest_edge(robot);
        TrackWindow window;
        if (worker.windows.choose(robot, middle, around, window)) {
            robots.push_back(robot);
            task.windows.push_back(window);
        }
    }
    task.robots = std::move(robots);
}

// Replans the windows of a task, stores the tracks in the task, and restores the plan.
void Lns::replan_windows(Worker& worker, Task& task, const StopCondition& is_over) {
    const std::size_t n = task.robots.size();
    if (task.tracks.size() < n) {
        task.tracks.resize(n);
    }
    const Worth before = worker.plan.worth();
    for (std::size_t k = 0; k < n; ++k) {
        const TrackWindow& window = task.windows[k];
        worker.plan.open_window(task.robots[k], window.first, window.last, window.until);
    }
    std::size_t n_found = 0;
    const auto restore = [&] {
        for (std::size_t k = n; k-- > n_found;) {
            worker.plan.close_window(task.robots[k]);
        }
        for (std::size_t k = n_found; k-- > 0;) {
            worker.plan.exchange(task.robots[k], task.tracks[k]);
        }
    };
    task.gain = -1;
    bool is_found = false;
    try {
        is_found = n > 0 && find_windows(worker, task, n_found, is_over);
    } catch (...) {
        restore();
        throw;
    }
    if (is_found) {
        const Worth after = worker.plan.worth();
        task.gain = plan_.objective() == Objective::flowtime ? before.cost - after.cost
                                                             : gain_of(before, after);
    }
    restore();
}

// Gives the robots of a task tracks with other windows, one after another, and stores their former
// tracks in the task; counts them.
bool Lns::find_windows(Worker& worker, Task& task, std::size_t& n_found,
                       const StopCondition& is_over) {
    Tick slack = 0;
    for (std::size_t k = 0; k < task.robots.size(); ++k) {
        const Tick weight = plan_.problem().weight(task.robots[k]);
        slack += weight * (task.windows[k].value - task.windows[k].least);
    }
    for (std::size_t k = 0; k < task.robots.size(); ++k) {
        const RobotId robot = task.robots[k];
        const Tick weight = plan_.problem().weight(robot);
        const Tick least = task.windows[k].least;
        if (slack < 0 || !worker.windows.find(robot, task.windows[k], least + slack / weight,
                                              is_over, worker.found)) {
            return false;
        }
        slack -= weight * (worker.windows.value() - least);
        worker.plan.exchange(robot, worker.found);
        std::swap(task.tracks[k], worker.found);
        ++n_found;
    }
    return true;
}

// Replans the robots of a task, stores the tracks in the task, and restores the plan.
void Lns::replan(Worker& worker, Task& task, const StopCondition& is_over) {
    const std::size_t n = task.robots.size();
    if (task.tracks.size() < n) {
        task.tracks.resize(n);
    }
    const bool is_of_flowtime = plan_.objective() == Objective::flowtime;
    const Worth before = worker.plan.worth();
    Limits limits = limits_of(task, worker.plan);
    for (std::size_t k = 0; k < n; ++k) {
        task.tracks[k].visits.clear();
        task.tracks[k].ends.clear();
        task.tracks[k].cost = 0;
        worker.plan.exchange(task.robots[k], task.tracks[k]);
    }
    Tick gain = -1;
    const auto restore = [&] {
        for (std::size_t k = 0; k < n; ++k) {
            worker.plan.exchange(task.robots[k], task.tracks[k]);
        }
    };
    try {
        if (limits.slack > 0 && find_tracks(worker, task, limits, is_over)) {
            gain = is_of_flowtime ? limits.slack : gain_of(before, worker.plan.worth());
        }
    } catch (...) {
        restore();
        throw;
    }
    restore();
    task.gain = gain;
}

// What new tracks of a task may cost, and when they have to be complete.
Lns::Limits Lns::limits_of(const Task& task, const FleetPlan& plan) const {
    Limits limits;
    for (const RobotId robot : task.robots) {
        limits.slack +=
            plan.problem().weight(robot) * (plan.track(robot).cost - alone_[index(robot)]);
    }
    if (plan.objective() == Objective::flowtime) {
        return limits;
    }
    const Tick last = plan.makespan();
    const bool may_fall = last > longest_alone_;  // else the makespan is the least there is
    const bool is_last = std::any_of(task.robots.begin(), task.robots.end(),
                                     [&](RobotId robot) { return plan.track(robot).cost == last; });
    if (plan.objective() == Objective::makespan) {
        limits.latest = may_fall ? last - 1 : last;
        if (may_fall && is_last) {
            limits.slack = unlimited;
        }
    } else if (is_last) {
        limits.slack += plan.problem().total_weight() * (last - longest_alone_);
    }
    return limits;
}

// The gain of a plan that is no worse; -1 for a worse one. A tick of the makespan counts as one of
// every robot, and so does a robot that completes last no more.
Tick Lns::gain_of(const Worth& before, const Worth& after) const {
    if (after > before) {
        return -1;
    }
    const Tick sooner = std::max<Tick>(before.value - after.value, before.n_last - after.n_last);
    const Tick saved = std::max<Tick>(before.cost - after.cost, 0);
    const bool is_of_makespan = plan_.objective() == Objective::makespan;
    return sooner * (is_of_makespan ? plan_.problem().total_weight() : 1) + saved;
}

// Gives the robots of a task new tracks in the worker's plan, one after another.
bool Lns::find_tracks(Worker& worker, const Task& task, Limits& limits,
                      const StopCondition& is_over) {
    for (const RobotId robot : task.robots) {
        const Tick alone = alone_[index(robot)];
        const Tick weight = plan_.problem().weight(robot);
        const bool has_arcs = plan_.problem().has_arcs();
        if (has_arcs) {
            worker.plan.find_limits(robot, true, worker.limits);
        }
        const Trip& trip =
            has_arcs ? worker.reader.read(robot, worker.limits.earliest, worker.limits.latest)
                     : worker.reader.read(robot);
        const SearchRequest request{trip,
                                    worker.plan.bookings(),
                                    {},
                                    std::min(alone + limits.slack / weight, limits.latest)};
        if (worker.search.run(request, is_over) != SearchEnd::found) {
            return false;
        }
        worker.search.track(worker.found.visits);
        if (has_arcs) {
            worker.plan.measure(robot, worker.found, worker.limits);
        } else if (plan_.problem().has_times()) {
            worker.plan.measure(robot, worker.found);
        } else {
            worker.found.cost = worker.search.cost();
        }
        limits.slack -= weight * (worker.found.cost - alone);
        worker.plan.exchange(robot, worker.found);
        worker.found.cost = 0;
    }
    return true;
}

// Adopts, in order of tasks, the results that still fit together.
void Lns::settle(std::size_t n) {
    std::fill(is_touched_.begin(), is_touched_.end(), 0);
    bool is_changed = false;
    for (std::size_t k = 0; k < n; ++k) {
        Task& task = tasks_[k];
        const bool is_adopted = task.gain >= 0 && adopt(task, is_changed);
        is_changed |= is_adopted;
        n_idle_ = is_adopted && task.gain > 0 ? 0 : n_idle_ + (task.has_windows ? 0 : 1);
        const double gain = is_adopted ? static_cast<double>(task.gain) : 0.0;
        const auto effort = static_cast<double>(task.effort);
        (task.has_windows ? size_of_windows_ : neighbourhood_)
            .learn(task.neighbourhood, gain, effort);
        shares_.learn(task.has_windows, gain, effort);
        ++n_tasks_;
    }
    neighbourhood_.settle();
    size_of_windows_.settle();
    shares_.settle();
}

// Adopts a result in the plan and all replicas, unless it conflicts with results adopted before.
bool Lns::adopt(Task& task, bool may_clash) {
    const std::size_t n = task.robots.size();
    for (const RobotId robot : task.robots) {
        if (is_touched_[index(robot)] != 0) {
            return false;
        }
    }
    const Worth before = plan_.worth();
    std::vector<TimedTrack> old(n);
    for (std::size_t k = 0; k < n; ++k) {
        plan_.exchange(task.robots[k], old[k]);
    }
    for (std::size_t k = 0; k < n && may_clash; ++k) {
        if (!plan_.fits(task.robots[k], task.tracks[k])) {
            for (std::size_t j = 0; j < n; ++j) {
                plan_.exchange(task.robots[j], old[j]);
            }
            return false;
        }
    }
    for (std::size_t k = 0; k < n; ++k) {
        plan_.exchange(task.robots[k], task.tracks[k]);
    }
    // Gains of the flowtime add up; gains of a makespan may be gone by results adopted before.
    if (may_clash && plan_.worth() > before) {
        for (std::size_t k = 0; k < n; ++k) {
            plan_.exchange(task.robots[k], task.tracks[k]);
        }
        for (std::size_t k = 0; k < n; ++k) {
            plan_.exchange(task.robots[k], old[k]);
        }
        return false;
    }
    for (std::size_t k = 0; k < n; ++k) {
        for (FleetPlan& replica : replicas_) {
            old[k] = plan_.track(task.robots[k]);
            replica.exchange(task.robots[k], old[k]);
        }
        is_touched_[index(task.robots[k])] = 1;
    }
    return true;
}

}  // namespace rightofway

#include "lns/population.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "lns/lns.hpp"
#include "lns/prioritized.hpp"

namespace rightofway {
namespace {

constexpr std::size_t n_members = 4;
constexpr std::int64_t tasks_per_robot = 30;  // for each child

// The share of robots that take the mate's tracks [% of the robots with different tracks]; the most
// is also the share of replanned robots if the mate's tracks are equal [% of all].
constexpr std::size_t least_share = 20;
constexpr std::size_t most_share = 60;

constexpr std::int64_t searches_per_robot = 20;

constexpr std::int64_t any_number = std::numeric_limits<std::int64_t>::max();

bool is_same(const TimedTrack& left, const TimedTrack& right) {
    return std::equal(left.visits.begin(), left.visits.end(), right.visits.begin(),
                      right.visits.end(), [](const Visit& one, const Visit& other) {
                          return one.enter == other.enter && one.vertex == other.vertex;
                      });
}

std::vector<RobotId> find_differing(const FleetPlan& left, const FleetPlan& right) {
    std::vector<RobotId> robots;
    for (RobotId robot = 0; robot < left.n_robots(); ++robot) {
        if (!is_same(left.track(robot), right.track(robot))) {
            robots.push_back(robot);
        }
    }
    return robots;
}

// Grows a group around a robot: adds robots in conflict with a member when only one of the two
// takes the mate's track. The group may have fewer than `size` robots.
std::vector<RobotId> grow_group(const FleetPlan& plan, const FleetPlan& mate, RobotId first,
                                std::size_t size, Random& random) {
    std::vector<RobotId> group{first};
    std::vector<RobotId> open{first};
    std::vector<std::uint8_t> is_known(static_cast<std::size_t>(plan.n_robots()), 0);
    is_known[index(first)] = 1;
    std::vector<RobotId> conflicting;
    const auto add_conflicting = [&] {
        for (const RobotId robot : conflicting) {
            if (is_known[index(robot)] == 0 && group.size() < size) {
                is_known[index(robot)] = 1;
                group.push_back(robot);
                open.push_back(robot);
            }
        }
    };
    while (!open.empty() && group.size() < size) {
        std::swap(open[random.below(open.size())], open.back());
        const RobotId robot = open.back();
        open.pop_back();
        plan.find_conflicting(robot, mate.track(robot), conflicting);
        add_conflicting();
        mate.find_conflicting(robot, plan.track(robot), conflicting);
        add_conflicting();
    }
    return group;
}

// A uniform sample of `percent` % of all robots, at least one.
std::vector<RobotId> sample_robots(RobotId n_robots, std::size_t percent, Random& random) {
    std::vector<RobotId> robots(static_cast<std::size_t>(n_robots));
    std::iota(robots.begin(), robots.end(), 0);
    random.shuffle(robots);
    robots.resize(std::max<std::size_t>(1, robots.size() * percent / 100));
    return robots;
}

void remove_tracks(FleetPlan& plan, std::span<const RobotId> robots) {
    for (const RobotId robot : robots) {
        TimedTrack no_track;
        plan.exchange(robot, no_track);
    }
}

}  // namespace

Population::Population(SharedDistances& distances, FleetPlan& plan, std::span<const Tick> alone,
                       std::uint64_t seed, std::size_t n_threads, std::int64_t n_idle)
    : distances_(distances),
      plan_(plan),
      alone_(alone),
      seed_(seed),
      members_{plan},
      children_(n_members, Child{FleetPlan(distances.problem())}),
      crew_(std::min(n_threads, n_members)),
      n_idle_(n_idle) {}

void Population::run(std::int64_t n_tasks, std::int64_t patience, const StopCondition& is_over,
                     const StopCondition& is_due) {
    while (n_tasks > 0 && n_idle_ < patience) {
        const std::int64_t before = n_tasks_;
        const std::size_t n = begin_generation(std::min(n_tasks, patience - n_idle_));
        const auto work = [this](std::size_t, std::size_t k, const StopCondition& stop) {
            make_child(k, stop);
        };
        crew_.run(n, work, is_over);
        insert_children(n);
        n_tasks -= n_tasks_ - before;
        if (crew_.is_stopped() || is_due()) {
            break;
        }
    }
    crew_.pass_on();
}

// Assigns tasks to the next children; returns the number of children.
std::size_t Population::begin_generation(std::int64_t n_tasks) {
    const std::size_t most = has_all_members() ? n_members : n_members - members_.size();
    const std::int64_t each = tasks_per_robot * plan_.n_robots();
    std::size_t n = 0;
    for (; n < most && n_tasks > 0; ++n) {
        children_[n].most_tasks = std::min(each, n_tasks);
        children_[n].n_tasks = 0;
        children_[n].n_expanded = 0;
        children_[n].is_whole = false;
        n_tasks -= children_[n].most_tasks;
    }
    return n;
}

bool Population::has_all_members() const { return members_.size() == n_members; }

void Population::make_child(std::size_t k, const StopCondition& is_over) {
    Child& child = children_[k];
    Random random(seed_, n_generations_, k);
    if (!vary(child, has_all_members() ? k : 0, random, is_over)) {
        child.n_tasks = is_over() ? 0 : child.most_tasks;  // count failed tasks, too
        return;
    }
    Lns improver(distances_, child.plan, alone_, random.next(), 1);
    improver.run(child.most_tasks, any_number, is_over, [] { return false; });
    child.n_tasks = improver.n_tasks();
    child.n_expanded += improver.n_expanded();
    child.is_whole = true;
}

// Makes a variant of the parent's plan; false if some robots got no track.
bool Population::vary(Child& child, std::size_t parent, Random& random,
                      const StopCondition& is_over) {
    child.plan = members_[parent];
    const FleetPlan& mate = members_[(parent + 1 + random.below(n_members - 1)) % members_.size()];
    const std::vector<RobotId> differing = find_differing(child.plan, mate);
    std::vector<RobotId> out;
    if (differing.empty()) {
        out = sample_robots(plan_.n_robots(), most_share, random);
        remove_tracks(child.plan, out);
    } else {
        out = cross_over(child.plan, mate, differing, random);
    }
    random.shuffle(out);
    Prioritized planner(distances_, child.plan);
    planner.start(out);
    const bool is_found =
        planner.run(searches_per_robot * plan_.n_robots(), is_over) == SearchEnd::found;
    child.n_expanded = planner.n_expanded();
    return is_found;
}

// Gives a group of robots the mate's tracks. Returns the robots that lost their tracks by that.
std::vector<RobotId> Population::cross_over(FleetPlan& plan, const FleetPlan& mate,
                                            std::span<const RobotId> differing,
                                            Random& random) const {
    const std::size_t share = least_share + random.below(most_share - least_share + 1);
    const RobotId first = differing[random.below(differing.size())];
    const std::size_t size = std::max<std::size_t>(1, differing.size() * share / 100);
    const std::vector<RobotId> group = grow_group(plan, mate, first, size, random);
    remove_tracks(plan, group);
    std::vector<RobotId> out;
    std::vector<RobotId> conflicting;
    for (const RobotId robot : group) {
        TimedTrack track = mate.track(robot);
        plan.find_conflicting(robot, track, conflicting);
        remove_tracks(plan, conflicting);
        out.insert(out.end(), conflicting.begin(), conflicting.end());
        plan.exchange(robot, track);
    }
    return out;
}

// Inserts the children in order: a child replaces its parent if its worth is no greater, else the
// worst member if its worth is no greater than the worst.
void Population::insert_children(std::size_t n_children) {
    const bool are_parents = has_all_members();
    const auto is_better = [](const FleetPlan& left, const FleetPlan& right) {
        return left.worth() < right.worth();
    };
    for (std::size_t k = 0; k < n_children; ++k) {
        Child& child = children_[k];
        n_tasks_ += child.n_tasks;
        n_idle_ += child.n_tasks;
        n_expanded_ += child.n_expanded;
        if (!child.is_whole) {
            continue;
        }
        if (child.plan.worth() < plan_.worth()) {
            plan_ = child.plan;
            n_idle_ = 0;
        }
        if (!are_parents) {
            members_.push_back(std::move(child.plan));
            continue;
        }
        auto place = members_.begin() + static_cast<std::ptrdiff_t>(k);
        if (is_better(*place, child.plan)) {
            place = std::max_element(members_.begin(), members_.end(), is_better);
        }
        if (!is_better(*place, child.plan)) {
            std::swap(*place, child.plan);
        }
    }
    ++n_generations_;
}

}  // namespace rightofway

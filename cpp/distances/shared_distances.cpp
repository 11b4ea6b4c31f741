#include "distances/shared_distances.hpp"

#include <algorithm>

#include "core/reject.hpp"

namespace rightofway {
namespace {

constexpr Tick alone_offset = 2;  // see `alone_`

}  // namespace

SharedDistances::SharedDistances(const Problem& problem, std::size_t budget)
    : problem_(problem),
      tables_(problem.graph().indptr, problem.graph().indices),
      is_uniform_(!problem.is_barred() && std::all_of(problem.roads().length_class.begin(),
                                                      problem.roads().length_class.end(),
                                                      [](std::int32_t one) { return one == 0; })),
      budget_(budget),
      alone_(static_cast<std::size_t>(problem.n_robots())) {}

std::shared_ptr<const DistanceTable> SharedDistances::to(VertexId target, RobotId robot) {
    const Key key{target, is_uniform_ ? 0 : problem_.pace_of(robot)};
    {
        const std::lock_guard lock(mutex_);
        if (const auto found = known_.find(key); found != known_.end()) {
            return found->second;
        }
    }
    auto table = make(target, robot);
    const std::lock_guard lock(mutex_);
    if (known_.emplace(key, table).second) {
        by_age_.push_back(key);
        bytes_ += table->bytes();
    }
    while (bytes_ > budget_ && by_age_.size() > 1) {
        const auto oldest = known_.find(by_age_.front());
        bytes_ -= oldest->second->bytes();
        known_.erase(oldest);
        by_age_.pop_front();
    }
    return table;
}

std::shared_ptr<const TurningTable> SharedDistances::with_turns(RobotId robot) {
    const std::size_t n_entries = problem_.n_stages() * problem_.graph().indices.size();
    if (!problem_.turns(robot).take_time() || sizeof(std::int32_t) * n_entries > budget_) {
        return nullptr;
    }
    {
        const std::lock_guard lock(mutex_);
        if (const auto found = turning_.find(robot); found != turning_.end()) {
            return found->second;
        }
    }
    auto table = std::make_shared<const TurningTable>(problem_, robot);
    const std::lock_guard lock(mutex_);
    return turning_.emplace(robot, std::move(table)).first->second;
}

Tick SharedDistances::between(VertexId from, VertexId target, RobotId robot) {
    if (target == none) {
        return 0;
    }
    if (!is_uniform_) {
        return to(target, robot)->view(1).from(from);
    }
    const std::lock_guard lock(ways_mutex_);
    if (!ways_) {
        ways_.emplace(problem_.graph(), tables_);
    }
    const std::int32_t steps = ways_->between(from, target);
    return steps == AltDistance::no_way ? -1 : scale(robot) * steps;
}

Tick SharedDistances::alone(RobotId robot) {
    std::atomic<Tick>& known = alone_[index(robot)];
    if (known == 0) {
        known = least_completion(robot) + alone_offset;
    }
    return known - alone_offset;
}

// Longest paths: robot after robot, until no end changes. Arcs and tours have no cycle, so an end
// has its last value after as many rounds as a path has arcs.
std::vector<Tick> SharedDistances::least_ends() {
    std::vector<Tick> ends(problem_.n_stages(), 0);
    bool has_changed = true;
    for (std::size_t round = 0; has_changed && round <= problem_.n_stages(); ++round) {
        has_changed = false;
        for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
            const Itinerary itinerary = problem_.itinerary(robot);
            Tick now = itinerary.times.ready;
            VertexId place = itinerary.home;
            for (std::size_t k = 0; k < itinerary.n_stages(); ++k) {
                const std::int32_t stage =
                    problem_.first_stage(robot) + static_cast<std::int32_t>(k);
                now += std::max<Tick>(0, between(place, itinerary.stage_vertex[k], robot));
                now = std::max(now, itinerary.times.earliest[k]);
                for (const std::int32_t before : problem_.stages_before(stage)) {
                    now = std::max(now, ends[index(before)]);
                }
                now += itinerary.stage_work[k];
                has_changed |= ends[index(stage)] != now;
                ends[index(stage)] = now;
                now += itinerary.turn_after(k);
                place = itinerary.stage_vertex[k];
            }
        }
        has_changed &= problem_.has_arcs();
    }
    return ends;
}

void SharedDistances::take_alone(std::span<const Tick> alone) {
    require_length("alone", alone.size(), alone_.size());
    for (std::size_t robot = 0; robot < alone.size(); ++robot) {
        alone_[robot] = alone[robot] + alone_offset;
    }
}

Tick SharedDistances::least_completion(RobotId robot) {
    const Itinerary itinerary = problem_.itinerary(robot);
    if (itinerary.turns.take_time()) {
        std::vector<std::shared_ptr<const DistanceTable>> tables;
        std::vector<DistanceView> to_stage;
        for (const VertexId stage : itinerary.stage_vertex) {
            tables.push_back(to(stage, robot));
            to_stage.push_back(tables.back()->view(scale(robot)));
        }
        return least_completion_with_turns(problem_, robot, to_stage);
    }
    const std::size_t first_at_end = itinerary.first_stage_at_end();
    Tick now = itinerary.times.ready;
    VertexId place = itinerary.home;
    for (std::size_t k = 0; k < itinerary.n_stages(); ++k) {
        const Tick way = between(place, itinerary.stage_vertex[k], robot);
        if (way < 0) {
            return -1;
        }
        const Tick begin = itinerary.times.are_known()
                               ? std::max(now + way, itinerary.times.earliest[k])
                               : now + way;
        now = begin + itinerary.stage_work[k] + (k < first_at_end ? itinerary.turn_after(k) : 0);
        place = itinerary.stage_vertex[k];
    }
    return now;
}

std::shared_ptr<const DistanceTable> SharedDistances::make(VertexId target, RobotId robot) const {
    auto table = std::make_shared<DistanceTable>();
    if (target == none) {
        table->narrow.assign(index(problem_.n_vertices()), 0);
        return table;
    }
    if (is_uniform_) {
        if (tables_.steps_to(target, table->narrow)) {
            return table;
        }
        table->narrow = {};
    }
    std::vector<std::int32_t> ticks(problem_.graph().indices.size(), 1);
    for (std::size_t e = 0; e < ticks.size() && !is_uniform_; ++e) {
        ticks[e] = problem_.drive(robot, static_cast<EdgeId>(e));
    }
    table->wide = tables_.to(target, ticks);
    return table;
}

}  // namespace rightofway

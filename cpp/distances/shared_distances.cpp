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
    Tick sum = 0;
    VertexId place = itinerary.home;
    for (std::size_t k = 0; k < itinerary.n_stages(); ++k) {
        const Tick way = between(place, itinerary.stage_vertex[k], robot);
        if (way < 0) {
            return -1;
        }
        sum += way + itinerary.stage_work[k] + (k < first_at_end ? itinerary.stage_turn[k] : 0);
        place = itinerary.stage_vertex[k];
    }
    return sum;
}

std::shared_ptr<const DistanceTable> SharedDistances::make(VertexId target, RobotId robot) const {
    auto table = std::make_shared<DistanceTable>();
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

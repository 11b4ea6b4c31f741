#include "problem/problem.hpp"

#include <string>

#include "core/reject.hpp"

namespace rightofway {
namespace {

template <class T>
std::vector<T> copy(std::span<const T> values) {
    return {values.begin(), values.end()};
}

std::string entry(const char* name, std::size_t index) {
    return std::string(name) + "[" + std::to_string(index) + "]";
}

void require_ids(const char* name, std::span<const std::int32_t> ids, std::int64_t count) {
    for (std::size_t k = 0; k < ids.size(); ++k) {
        if (ids[k] < 0 || ids[k] >= count) {
            require_id(entry(name, k), ids[k], count);
        }
    }
}

void require_durations(const char* name, std::span<const Tick> ticks) {
    for (std::size_t k = 0; k < ticks.size(); ++k) {
        if (ticks[k] < 0 || ticks[k] >= conflict_cap) {
            reject_entry(name, k, ticks[k], "is negative or too long");
        }
    }
}

}  // namespace

Problem::Problem(const ProblemArrays& arrays, std::int32_t n_classes, const BookingRules& rules,
                 std::size_t bytes_for_distances)
    : indptr_(copy(arrays.indptr)),
      heads_(copy(arrays.heads)),
      length_class_(copy(arrays.length_class)),
      paces_(copy(arrays.paces)),
      pace_of_(copy(arrays.pace_of)),
      home_(copy(arrays.home)),
      first_stage_(copy(arrays.first_stage)),
      stage_vertex_(copy(arrays.stage_vertex)),
      stage_work_(copy(arrays.stage_work)),
      stage_turn_(copy(arrays.stage_turn)),
      n_classes_(static_cast<std::size_t>(n_classes)),
      rules_(rules),
      distances_(std::make_unique<SharedDistances>(roads(), bytes_for_distances)),
      alone_(home_.size()) {
    if (n_classes < 0) {
        reject("n_classes", n_classes, "is negative");
    }
    if (rules.headway < 0 || rules.headway >= conflict_cap) {
        reject("headway", rules.headway, "is negative or too long");
    }
    check(arrays);
}

void Problem::check(const ProblemArrays& arrays) const {
    require_length("length_class", length_class_.size(), heads_.size());
    require_ids("length_class", length_class_, static_cast<std::int64_t>(n_classes_));
    for (std::size_t k = 0; k < paces_.size(); ++k) {
        if (paces_[k] <= 0) {
            reject_entry("paces", k, paces_[k], "is not positive");
        }
    }
    const std::size_t n_paces = n_classes_ == 0 ? 1 : paces_.size() / n_classes_;
    require_length("paces", paces_.size(), n_paces * n_classes_);
    require_length("pace_of", pace_of_.size(), home_.size());
    require_ids("pace_of", pace_of_, static_cast<std::int64_t>(n_paces));
    require_ids("home", home_, n_vertices());
    require_length("first_stage", first_stage_.size(), home_.size() + 1);
    for (std::size_t r = 0; r < home_.size(); ++r) {
        if (first_stage_[r] >= first_stage_[r + 1]) {
            reject_entry("first_stage", r + 1, first_stage_[r + 1], "leaves a robot no stage");
        }
    }
    require_length("stage_vertex", stage_vertex_.size(),
                   static_cast<std::size_t>(first_stage_.back()));
    require_ids("stage_vertex", arrays.stage_vertex, n_vertices());
    require_length("stage_work", stage_work_.size(), stage_vertex_.size());
    require_length("stage_turn", stage_turn_.size(), stage_vertex_.size());
    require_durations("stage_work", stage_work_);
    require_durations("stage_turn", stage_turn_);
}

std::span<const std::int32_t> Problem::pace(RobotId robot) const {
    const auto first = static_cast<std::size_t>(pace_of_[robot]) * n_classes_;
    return std::span(paces_).subspan(first, n_classes_);
}

std::int32_t Problem::drive(RobotId robot, VertexId tail, VertexId head) const {
    for (EdgeId edge = indptr_[tail]; edge < indptr_[tail + 1]; ++edge) {
        if (heads_[edge] == head) {
            return pace(robot)[length_class_[edge]];
        }
    }
    return -1;
}

Tick Problem::alone(RobotId robot) const {
    constexpr Tick offset = 2;
    std::atomic<Tick>& known = alone_[static_cast<std::size_t>(robot)];
    if (known == 0) {
        known = least_completion(robot) + offset;
    }
    return known - offset;
}

Tick Problem::least_completion(RobotId robot) const {
    const auto vertices = stages(robot);
    std::size_t first_last = vertices.size() - 1;
    while (first_last > 0 && vertices[first_last - 1] == vertices.back()) {
        --first_last;
    }
    Tick sum = 0;
    VertexId place = home_[robot];
    for (std::size_t k = 0; k < vertices.size(); ++k) {
        const Tick way = distances_->between(place, vertices[k], pace(robot));
        if (way < 0) {
            return -1;
        }
        sum += way + works(robot)[k] + (k < first_last ? turns(robot)[k] : 0);
        place = vertices[k];
    }
    return sum;
}

const Trip& TripReader::read(RobotId robot) {
    if (robot == robot_) {
        return trip_;
    }
    robot_ = robot;
    trip_.stage_vertex = fleet_.stages(robot);
    trip_.stage_work = fleet_.works(robot);
    trip_.stage_turn = fleet_.turns(robot);
    trip_.home = fleet_.home(robot);
    trip_.pace = fleet_.pace(robot);
    tables_.clear();
    trip_.to_stage.clear();
    const Tick scale = fleet_.distances().scale(trip_.pace);
    for (const VertexId stage : trip_.stage_vertex) {
        tables_.push_back(fleet_.distances().to(stage, trip_.pace));
        trip_.to_stage.push_back(tables_.back()->view(scale));
    }
    return trip_;
}

Tick TripReader::completion(RobotId robot, std::span<const Visit> track,
                            std::vector<std::int32_t>* stage_of) {
    const auto stages = fleet_.stages(robot);
    const auto works = fleet_.works(robot);
    const auto turns = fleet_.turns(robot);
    const std::size_t last = track.size() - 1;
    std::size_t stage = 0;
    Tick work = 0;
    if (stage_of != nullptr) {
        stage_of->clear();
    }
    for (std::size_t visit = 0; visit <= last; ++visit) {
        const bool stays = visit == last;
        Tick spare =
            stays ? 0 : track[visit + 1].enter - track[visit].enter - track[visit + 1].drive;
        while (stage < stages.size() && stages[stage] == track[visit].vertex) {
            const Tick need = works[stage] + turns[stage];
            const bool is_final = stage + 1 == stages.size();
            if (stays) {
                work += works[stage];
            } else if (is_final || spare < need) {
                break;
            }
            spare -= need;
            ++stage;
        }
        if (stage_of != nullptr) {
            stage_of->push_back(static_cast<std::int32_t>(stage));
        }
    }
    return stage == stages.size() ? track[last].enter + work : -1;
}

}  // namespace rightofway

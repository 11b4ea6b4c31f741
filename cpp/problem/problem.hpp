// The trips of a whole fleet and the roads they use: everything that a search for tracks is given
// and never changes.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "distances/shared_distances.hpp"
#include "problem/trip.hpp"

namespace rightofway {

// Arrays that describe a fleet. Robot r owns stages first_stage[r] .. first_stage[r + 1] - 1, and
// drives an edge of class c in paces[pace_of[r] * n_classes + c] ticks.
struct ProblemArrays {
    std::span<const EdgeId> indptr;
    std::span<const VertexId> heads;
    std::span<const std::int32_t> length_class;
    std::span<const std::int32_t> paces;
    std::span<const std::int32_t> pace_of;
    std::span<const VertexId> home;
    std::span<const std::int32_t> first_stage;
    std::span<const VertexId> stage_vertex;
    std::span<const Tick> stage_work;
    std::span<const Tick> stage_turn;
};

class Problem {
  public:
    // Copies the arrays. Throws std::invalid_argument where they do not fit together.
    Problem(const ProblemArrays& arrays, std::int32_t n_classes, const BookingRules& rules,
            std::size_t bytes_for_distances);
    Problem(const Problem&) = delete;
    Problem& operator=(const Problem&) = delete;

    RobotId n_robots() const { return static_cast<RobotId>(home_.size()); }
    VertexId n_vertices() const { return roads().graph.n_vertices(); }
    Roads roads() const { return {{indptr_, heads_}, length_class_}; }
    const BookingRules& rules() const { return rules_; }
    VertexId home(RobotId robot) const { return home_[static_cast<std::size_t>(robot)]; }
    std::span<const std::int32_t> pace(RobotId robot) const;
    std::span<const VertexId> stages(RobotId robot) const { return part(stage_vertex_, robot); }
    std::span<const Tick> works(RobotId robot) const { return part(stage_work_, robot); }
    std::span<const Tick> turns(RobotId robot) const { return part(stage_turn_, robot); }
    SharedDistances& distances() const { return *distances_; }

    // What the robot needs at least, -1 if it cannot get to a stage.
    Tick alone(RobotId robot) const;

    // The ticks that a robot drives from one vertex to the next, -1 where there is no edge.
    std::int32_t drive(RobotId robot, VertexId tail, VertexId head) const;

  private:
    void check(const ProblemArrays& arrays) const;
    Tick least_completion(RobotId robot) const;

    // What belongs to the stages of a robot.
    template <class T>
    std::span<const T> part(const std::vector<T>& of_stages, RobotId robot) const {
        const auto first = static_cast<std::size_t>(first_stage_[robot]);
        const auto end = static_cast<std::size_t>(first_stage_[robot + 1]);
        return std::span(of_stages).subspan(first, end - first);
    }

    std::vector<EdgeId> indptr_;
    std::vector<VertexId> heads_;
    std::vector<std::int32_t> length_class_;
    std::vector<std::int32_t> paces_;
    std::vector<std::int32_t> pace_of_;
    std::vector<VertexId> home_;
    std::vector<std::int32_t> first_stage_;
    std::vector<VertexId> stage_vertex_;
    std::vector<Tick> stage_work_;
    std::vector<Tick> stage_turn_;
    std::size_t n_classes_;
    BookingRules rules_;
    std::unique_ptr<SharedDistances> distances_;
    mutable std::vector<std::atomic<Tick>> alone_;  // plus 2; 0 until it is asked for
};

// Makes a robot's trip ready for a search, in memory that is used again; one for each thread.
class TripReader {
  public:
    explicit TripReader(const Problem& fleet) : fleet_(fleet) {}

    // Valid until the next call.
    const Trip& read(RobotId robot);

    // Which stage each visit of a track is on its way to when it is left, and when the trip is
    // complete: stages are served as early as visits last long enough, the last one in the last
    // visit.
    Tick completion(RobotId robot, std::span<const Visit> track,
                    std::vector<std::int32_t>* stage_of = nullptr);

  private:
    const Problem& fleet_;
    RobotId robot_ = -1;
    Trip trip_;
    std::vector<std::shared_ptr<const DistanceTable>> tables_;
};

}  // namespace rightofway

// The itinerary of one robot with a distance table for each stage: the input of a search.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "distances/distance_tables.hpp"
#include "distances/shared_distances.hpp"
#include "distances/turning_table.hpp"
#include "problem/problem.hpp"

namespace rightofway {

struct Trip : Itinerary {
    std::vector<DistanceView> to_stage;  // distances to each stage's vertex
    std::int32_t first_row = 0;          // of the robot's size class in a booking table
    std::shared_ptr<const TurningTable> with_turns = nullptr;  // better bounds; may be null
};

// Throws std::invalid_argument if the arrays of a trip do not fit each other or the roads, or if
// the robot cannot reach a stage.
void require_trip(const Roads& roads, const Trip& trip);

// Builds the trip of a robot in reused memory; one reader per thread.
class TripReader {
  public:
    // Borrows the distances. With turns, a trip gets the table of a robot that turns in some time:
    // it takes longer than one search, and many searches are faster with it.
    explicit TripReader(SharedDistances& distances, bool with_turns = false)
        : distances_(distances), with_turns_(with_turns) {}

    // The trip of a robot, valid until the next call.
    const Trip& read(RobotId robot);
    // The same with other limits of the times of its stages, borrowed.
    const Trip& read(RobotId robot, std::span<const Tick> earliest, std::span<const Tick> latest);

  private:
    SharedDistances& distances_;
    bool with_turns_;
    RobotId robot_ = -1;
    Trip trip_;
    std::vector<std::shared_ptr<const DistanceTable>> tables_;
};

// The completion time of a track, -1 if the track leaves out a stage. Sets `stage_after` to the
// first stage not served after each visit; `ends` to the end of the work of each stage served,
// where stages have times.
Tick completion(const Itinerary& itinerary, std::span<const Visit> track,
                std::vector<std::int32_t>* stage_after = nullptr,
                std::vector<Tick>* ends = nullptr);

// What the ends of stages and the completion of a robot cost, without surcharges.
Tick cost_of_ends(const Itinerary& itinerary, std::span<const Tick> ends, Tick completion);

}  // namespace rightofway

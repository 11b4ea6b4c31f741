// What one robot has to do, with a table of how far it is to each stage: what a search is given.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "distances/distance_tables.hpp"
#include "distances/shared_distances.hpp"
#include "problem/problem.hpp"

namespace rightofway {

struct Trip : Itinerary {
    std::vector<DistanceView> to_stage;  // to the vertex of each stage
};

// Throws std::invalid_argument where the arrays of a trip do not fit together or to the roads, or a
// stage cannot be reached.
void require_trip(const Roads& roads, const Trip& trip);

// Makes a robot's trip ready for a search, in memory that is used again; one for each thread.
class TripReader {
  public:
    // Borrows the distances.
    explicit TripReader(SharedDistances& distances) : distances_(distances) {}

    // Valid until the next call.
    const Trip& read(RobotId robot);

  private:
    SharedDistances& distances_;
    RobotId robot_ = -1;
    Trip trip_;
    std::vector<std::shared_ptr<const DistanceTable>> tables_;
};

// When the trip of a track is complete, -1 if it leaves out a stage. `stage_after` is set to the
// first stage that is left after each visit.
Tick completion(const Itinerary& itinerary, std::span<const Visit> track,
                std::vector<std::int32_t>* stage_after = nullptr);

}  // namespace rightofway

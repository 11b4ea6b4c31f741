// A first plan of a fleet with jobs in which one robot moves at a time, and the others stay.
//
// A robot serves stages until one has to wait for a stage of another robot, and drives to its last
// vertex: home, or if it ends anywhere, back to where it was or else to another vertex. Then
// another robot follows. This finds a plan wherever robots begin at home, each stage can be reached
// from there on a way that avoids the other homes, and no stage has a latest end. Where homes are
// occupied at first, robots whose way is free go first.
#pragma once

#include <optional>
#include <vector>

#include "core/search_end.hpp"
#include "distances/trip.hpp"
#include "lns/fleet_plan.hpp"
#include "search/booking_table.hpp"
#include "search/sipp.hpp"

namespace rightofway {

class OneAtATime {
  public:
    // Borrows the distances; the problem has times of stages.
    explicit OneAtATime(SharedDistances& distances);

    // A track for each robot. `proven_none`: none that this method finds.
    SearchEnd run(const StopCondition& is_over);
    std::vector<TimedTrack>& tracks() { return tracks_; }

  private:
    struct Part {  // of a trip: stages from the first one not served on, and the rest after them
        std::vector<VertexId> vertex;
        std::vector<Tick> work;
        std::vector<Tick> turn;
        std::vector<Tick> earliest;
        std::vector<Tick> latest;
    };

    bool is_done(RobotId robot) const;
    std::size_t count_ready(RobotId robot) const;
    SearchEnd move(RobotId robot, std::size_t n_ready, const StopCondition& is_over);
    SearchEnd move_to(VertexId rest, RobotId robot, std::size_t n_ready,
                      const StopCondition& is_over);
    Trip trip_of(RobotId robot, std::size_t n_ready, VertexId rest_vertex);
    void append(RobotId robot);
    void hold(RobotId robot, bool is_held);
    VertexId place(RobotId robot) const { return tracks_[index(robot)].visits.back().vertex; }
    VertexId rest_of(RobotId robot) const;
    std::size_t n_stages(RobotId robot) const;

    SharedDistances& distances_;
    const Problem& problem_;
    BookingTable bookings_;
    SafeIntervalSearch search_;
    TripReader reader_;
    std::vector<TimedTrack> tracks_;
    std::vector<std::size_t> n_served_;
    std::vector<EdgeId> edge_;  // driven last by each robot
    Part part_;
    std::vector<Visit> found_;
    Tick now_ = 0;
};

}  // namespace rightofway

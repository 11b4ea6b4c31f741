// The neighbourhoods of LNS: small sets of robots with related tracks, to be replanned together.
//
// Li et al., "Anytime multi-agent path finding via large neighborhood search", IJCAI 2021.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/random.hpp"
#include "distances/trip.hpp"
#include "lns/fleet_plan.hpp"

namespace rightofway {

enum class NeighbourhoodKind : std::int32_t {
    blockers,    // a late robot, and the robots on its route alone
    delay,       // a late robot, and the robots met on random walks from its track
    congestion,  // robots near one vertex at about one time
    segment,     // a late robot, and the opposing robots of a segment
    random,
    window,  // a late robot, and the robots that pass near it for some time around one visit
};
inline constexpr std::size_t n_neighbourhood_kinds = 5;  // of whole tracks

class Neighbourhoods {
  public:
    // Borrows all. `alone`: completion time of each robot driving alone.
    Neighbourhoods(SharedDistances& distances, const FleetPlan& plan, std::span<const Tick> alone);

    // Chooses at most `size` robots, each once.
    const std::vector<RobotId>& choose(NeighbourhoodKind kind, std::size_t size, Random& random);
    // The time around which the robots of the latest window meet.
    Tick middle() const { return middle_; }

  private:
    RobotId late_robot(Random& random);
    RobotId last_robot(Random& random) const;
    void blockers(std::size_t size, Random& random);
    void delay(std::size_t size, Random& random);
    void congestion(std::size_t size, Random& random);
    void segment(std::size_t size, Random& random);
    void window(std::size_t size, Random& random);
    void add_around(const Visit& middle, Tick around, std::size_t size);
    void fill_up(std::size_t size, Random& random);
    void add(RobotId robot);
    void add_all(VertexId vertex, Tick start, Tick end, std::size_t size);

    const Problem& problem_;
    const FleetPlan& plan_;
    std::span<const Tick> alone_;
    TripReader reader_;
    std::vector<RobotId> chosen_;
    std::vector<std::uint8_t> is_chosen_;
    std::vector<std::int32_t> stage_of_;
    std::vector<VertexId> ring_;
    Tick middle_ = 0;
};

}  // namespace rightofway

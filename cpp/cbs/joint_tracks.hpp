// Two robots alone on the roads: which completion times they can have together.
//
// All tracks of one robot up to some completion time are one graph (a multi-value decision diagram,
// MDD) of *phases*: intervals in which the robot books the same rows all the time, as it stays at a
// vertex or drives along an edge. Phases of one track follow each other without a gap or an
// overlap. So a search over pairs of phases, which goes on with the phase that ends first, finds
// each pair of tracks that keep clear of each other, and takes no longer than the pairs of phases
// that overlap in time: symmetric tracks in an open hall are not searched one by one.
//
// Only for rules without headway, where the phases of a track do not overlap, and without
// surcharges.
//
// Sharon, Stern, Goldenberg & Felner, "The increasing cost tree search for optimal multi-agent
// pathfinding", Artificial Intelligence 195, 2013 (MDDs of pairs).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/index_table.hpp"
#include "core/search_end.hpp"
#include "distances/trip.hpp"
#include "problem/problem.hpp"
#include "search/booking_table.hpp"
#include "search/sipp.hpp"

namespace rightofway {

// Thrown where the stop condition ends a search.
struct Stopped {};

// All tracks of one robot that complete by some tick. One object serves many searches.
class TrackGraph {
  public:
    struct Phase {
        Tick start;
        Tick end;                         // `never` for the last visit
        std::array<std::int32_t, 3> row;  // booked; -1: none
        VertexId tail;                    // of a drive; -1 for a stay
        VertexId head;
        Tick completion;         // of the last visit, else -1
        std::int32_t after = 0;  // of a drive: the visit after it; of a stay: number in `drives`
    };

    // Makes the graph of the tracks that book no row while the table has a booking of it. False if
    // it would have more than `most_phases` phases.
    bool build(const Problem& problem, const SearchRequest& request, RobotId robot,
               SafeIntervalSearch& search, std::size_t most_phases);

    const Phase& at(std::int32_t phase) const { return phases_[index(phase)]; }
    // The phases with which the track begins, and those that follow a phase.
    std::span<const std::int32_t> first() const { return list(first_of_visit_[0]); }
    std::span<const std::int32_t> next(std::int32_t phase) const {
        const Phase& one = at(phase);
        return list(one.tail < 0 ? one.after : first_of_visit_[index(one.after)]);
    }

  private:
    struct Arrival {
        Tick enter;
        VertexId vertex;
        EdgeId edge;  // driven in; -1 at home, and where turns take no time
        std::int32_t stage;
        std::int32_t drive;  // ticks of the drive in
        bool operator==(const Arrival&) const = default;
    };
    class Builder;

    std::span<const std::int32_t> list(std::int32_t number) const {
        const auto [first, end] = lists_[index(number)];
        return std::span(numbers_).subspan(first, end - first);
    }
    std::int32_t visit(const Arrival& arrival);

    std::vector<Phase> phases_;
    std::vector<Arrival> visits_;
    std::vector<std::int32_t> first_of_visit_;  // its list
    std::vector<std::pair<std::size_t, std::size_t>> lists_;
    std::vector<std::int32_t> numbers_;  // of phases, list after list
    IndexTable known_;                   // of visits
    std::vector<std::pair<Tick, std::int32_t>> drives_;
};

// Searches pairs of phases. One object serves many searches.
class JointTracks {
  public:
    // Finds the pairs of completion times of tracks that keep clear of each other. Ends early at
    // the first pair, with `any`. Gives up beyond `most_pairs` pairs of phases. Throws Stopped.
    bool search(const Problem& problem, const TrackGraph& first, const TrackGraph& second, bool any,
                std::size_t most_pairs, const StopCondition& is_over);

    const std::vector<std::array<Tick, 2>>& completions() const { return completions_; }

  private:
    std::vector<std::array<Tick, 2>> completions_;
    std::vector<std::pair<std::int32_t, std::int32_t>> pairs_;
    std::vector<std::int32_t> open_;
    IndexTable known_;
};

}  // namespace rightofway

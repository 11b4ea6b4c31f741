// The swap operation of PIBT: two robots that face each other in a corridor change places.
//
// One robot pulls the other back to a vertex with room. Tests whether a swap is necessary and
// possible look ahead along the corridor only, where a pushed robot has one way.
//
// Okumura, "Improving LaCAM for scalable eventually optimal multi-agent pathfinding", IJCAI 2023.
#pragma once

#include <concepts>
#include <cstdint>

#include "core/graph.hpp"
#include "core/types.hpp"

namespace rightofway {

// The queries of `Swaps` to a fleet whose robots choose.
template <class F>
concept ChoosingFleet = requires(const F& fleet, RobotId robot, VertexId vertex) {
    { fleet.graph() } -> std::convertible_to<const Graph&>;
    { fleet.at(robot) } -> std::same_as<VertexId>;
    { fleet.here(vertex) } -> std::same_as<RobotId>;
    { fleet.keeps_off(robot, vertex) } -> std::same_as<RobotId>;  // points: the robot here
    { fleet.target(robot) } -> std::same_as<VertexId>;
    { fleet.way(robot, vertex) } -> std::same_as<std::int32_t>;  // edges to the target
    { fleet.is_free(robot) } -> std::same_as<bool>;              // can choose or has chosen
    { fleet.is_idle(robot) } -> std::same_as<bool>;              // can choose, has not chosen
};

template <ChoosingFleet F>
class Swaps {
  public:
    explicit Swaps(const F& fleet) : fleet_(fleet) {}

    // The robot to swap with: the robot at the wanted vertex, or a robot behind this one that has
    // to pass it; `nobody` if no swap is needed or possible. A robot that is too near to a vertex
    // counts as at this vertex.
    RobotId partner(RobotId robot, VertexId wanted) const {
        const VertexId here = fleet_.at(robot);
        if (wanted == here) {
            return nobody;
        }
        const RobotId ahead = fleet_.keeps_off(robot, wanted);
        if (ahead != nobody && fleet_.is_idle(ahead) && must_swap({robot, ahead, here, wanted}) &&
            can_swap(wanted, here)) {
            return ahead;
        }
        for (const VertexId place : fleet_.graph().heads(here)) {
            const RobotId behind = fleet_.keeps_off(robot, place);
            if (behind != nobody && place != wanted && fleet_.is_free(behind) &&
                must_swap({behind, robot, here, wanted}) && can_swap(wanted, here)) {
                return behind;
            }
        }
        return nobody;
    }

  private:
    static constexpr VertexId nowhere = -1;
    static constexpr VertexId more = -2;
    struct Pair {
        RobotId pusher;
        RobotId puller;
        VertexId behind;  // the pusher's vertex; the puller is at `ahead`
        VertexId ahead;
    };

    // The only next vertex of a robot pushed along a corridor; `more` if there are several,
    // `nowhere` if there is none.
    VertexId only_way_on(VertexId from, VertexId at) const {
        VertexId found = nowhere;
        for (const VertexId head : fleet_.graph().heads(at)) {
            if (head == from || is_blind(head)) {
                continue;
            }
            if (found != nowhere) {
                return more;
            }
            found = head;
        }
        return found;
    }

    // Whether the vertex is a dead end whose robot is at its target.
    bool is_blind(VertexId vertex) const {
        if (fleet_.graph().heads(vertex).size() != 1) {
            return false;
        }
        const RobotId resident = fleet_.here(vertex);
        return resident != nobody && fleet_.target(resident) == vertex;
    }

    // Whether the pusher, following the puller along the corridor, would only push the puller away
    // from its target.
    bool must_swap(Pair pair) const {
        auto [pusher, puller, behind, ahead] = pair;
        VertexId on = only_way_on(behind, ahead);
        if (on == more && fleet_.target(pusher) != behind) {
            return false;  // the result of the code below, without table reads
        }
        std::int32_t from_behind = fleet_.way(pusher, behind);
        std::int32_t from_ahead = fleet_.way(pusher, ahead);
        while (from_ahead < from_behind && on != nowhere) {
            if (on == more) {
                return false;
            }
            behind = ahead;
            ahead = on;
            from_behind = from_ahead;
            from_ahead = fleet_.way(pusher, ahead);
            on = only_way_on(behind, ahead);
        }
        return fleet_.way(puller, behind) < fleet_.way(puller, ahead) &&
               (fleet_.target(pusher) == behind || from_ahead < from_behind);
    }

    // Whether the way back along the corridor has a junction where the two robots can pass. One-way
    // lanes may lead into a circle that never comes back to the start: a walk that meets a move
    // again goes round for ever (Brent, "An improved Monte Carlo factorization algorithm", 1980).
    bool can_swap(VertexId behind, VertexId ahead) const {
        const VertexId start = behind;
        VertexId marked_behind = nowhere;
        VertexId marked_ahead = nowhere;
        std::int64_t next_mark = 1;
        for (std::int64_t n_moves = 0; ahead != start; ++n_moves) {
            if (behind == marked_behind && ahead == marked_ahead) {
                return false;
            }
            if (n_moves == next_mark) {
                marked_behind = behind;
                marked_ahead = ahead;
                next_mark *= 2;
            }
            const VertexId on = only_way_on(behind, ahead);
            if (on == more) {
                return true;
            }
            if (on == nowhere) {
                return false;
            }
            behind = ahead;
            ahead = on;
        }
        return false;
    }

    const F& fleet_;
};

}  // namespace rightofway

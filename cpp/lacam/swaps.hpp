// Two robots that face each other in a corridor: do they have to change places, and can they?
//
// One pulls the other back to where there is room. Looking ahead is along the corridor only, where
// a robot that is pushed on has one way to go.
//
// Okumura, "Improving LaCAM for scalable eventually optimal multi-agent pathfinding", IJCAI 2023.
#pragma once

#include <concepts>
#include <cstdint>

#include "core/graph.hpp"
#include "core/types.hpp"

namespace rightofway {

// What there is to know of a fleet while its robots choose.
template <class F>
concept ChoosingFleet = requires(const F& fleet, RobotId robot, VertexId vertex) {
    { fleet.graph() } -> std::convertible_to<const Graph&>;
    { fleet.at(robot) } -> std::same_as<VertexId>;
    { fleet.here(vertex) } -> std::same_as<RobotId>;
    { fleet.target(robot) } -> std::same_as<VertexId>;
    { fleet.way(robot, vertex) } -> std::same_as<std::int32_t>;  // edges to the target
    { fleet.is_free(robot) } -> std::same_as<bool>;              // it can choose now, or has chosen
    { fleet.is_idle(robot) } -> std::same_as<bool>;              // it can, and has not chosen yet
};

template <ChoosingFleet F>
class Swaps {
  public:
    explicit Swaps(const F& fleet) : fleet_(fleet) {}

    // The robot to change places with: the one that stands where this one wants to go, or one
    // behind this one that has to get past it.
    RobotId partner(RobotId robot, VertexId wanted) const {
        const VertexId here = fleet_.at(robot);
        if (wanted == here) {
            return nobody;
        }
        const RobotId ahead = fleet_.here(wanted);
        if (ahead != nobody && fleet_.is_idle(ahead) && must_swap({robot, ahead, here, wanted}) &&
            can_swap(wanted, here)) {
            return ahead;
        }
        for (const VertexId place : fleet_.graph().heads(here)) {
            const RobotId behind = fleet_.here(place);
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
        VertexId behind;  // where the pusher is, and the puller ahead of it
        VertexId ahead;
    };

    // The one way on for whoever is pushed back along a corridor; `more` if there are several, and
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

    // A dead end whose robot is at its target.
    bool is_blind(VertexId vertex) const {
        if (fleet_.graph().heads(vertex).size() != 1) {
            return false;
        }
        const RobotId resident = fleet_.here(vertex);
        return resident != nobody && fleet_.target(resident) == vertex;
    }

    // Whether the pusher, following the puller down the corridor, would only ever push it further
    // from where the puller wants to go.
    bool must_swap(Pair pair) const {
        auto [pusher, puller, behind, ahead] = pair;
        VertexId on = only_way_on(behind, ahead);
        if (on == more && fleet_.target(pusher) != behind) {
            return false;  // so it would come out below, but for many looks at tables
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

    // Whether, going back along the corridor, there comes a place where the two can pass each
    // other.
    bool can_swap(VertexId behind, VertexId ahead) const {
        const VertexId start = behind;
        while (ahead != start) {
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

#include "cbs/fewest_actions.hpp"

#include <deque>
#include <utility>
#include <vector>

#include "cbs/constrained_tracks.hpp"
#include "cbs/constraint_sets.hpp"
#include "cbs/joint_search.hpp"
#include "cbs/track_conflicts.hpp"
#include "search/booking_table.hpp"

namespace rightofway {
namespace {

class ActionSearch {
  public:
    ActionSearch(SharedDistances& distances, FleetPlan& plan, std::span<Tick> waits, Tick latest,
                 std::int64_t most_states, const StopCondition& is_over)
        : plan_(plan),
          problem_(plan.problem()),
          closures_(problem_),
          joint_(problem_, closures_.table()),
          waits_(waits),
          latest_(latest),
          most_states_(most_states),
          is_over_(is_over) {
        for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
            trips_.emplace_back(distances, true);
        }
    }

    // Whether the fewest actions are proven.
    bool take_all() {
        std::vector<GroupMember> members;
        for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
            members.push_back({robot, &trips_[index(robot)].read(robot), {}, latest_});
        }
        KnownPlan known{plan_.cost(), 0};
        for (const GroupMember& member : members) {
            known.actions += waits_[index(member.robot)] + count_drives(member.robot);
        }
        const SearchEnd end = search(members, known);
        if (end != SearchEnd::found) {
            return end == SearchEnd::proven_none;
        }
        TimedTrack none;
        for (const GroupMember& member : members) {
            plan_.exchange(member.robot, none);
            none = {};
        }
        for (std::size_t k = 0; k < members.size(); ++k) {
            TimedTrack track = track_of(k, members[k]);
            plan_.exchange(members[k].robot, track);
        }
        return true;
    }

    // Whether a robot has got a track with fewer actions.
    bool take_one(RobotId robot) {
        const std::vector<Constraint> others = bookings_of_others(robot);
        const Tick cost = problem_.weight(robot) * plan_.track(robot).cost;
        const std::vector<GroupMember> members{
            {robot, &trips_[index(robot)].read(robot), others, latest_}};
        if (search(members, {cost, waits_[index(robot)] + count_drives(robot)}) !=
            SearchEnd::found) {
            return false;
        }
        TimedTrack track = track_of(0, members[0]);
        if (!plan_.fits(robot, track)) {
            return false;
        }
        plan_.exchange(robot, track);
        waits_[index(robot)] = joint_.actions() - count_drives(robot);
        return true;
    }

  private:
    SearchEnd search(std::span<const GroupMember> members, const KnownPlan& known) {
        if (known.actions > JointSearch::most_actions) {
            return SearchEnd::stopped;
        }
        return joint_.run(members, most_states_, is_over_, &known);
    }

    Tick count_drives(RobotId robot) const {
        return static_cast<Tick>(plan_.track(robot).visits.size()) - 1;
    }

    TimedTrack track_of(std::size_t member, const GroupMember& of) const {
        TimedTrack track;
        joint_.track(member, track.visits);
        track.cost = completion(*of.trip, track.visits) + plan_.surcharges(track.visits);
        return track;
    }

    // What the other robots keep a robot from, as constraints of it.
    std::vector<Constraint> bookings_of_others(RobotId robot) const {
        std::vector<Constraint> constraints;
        const BookingTable& table = plan_.bookings();
        for (std::int32_t row = 0; row < table.n_rows(); ++row) {
            for (const BookedBy& one : table.at(row)) {
                if (one.robot != robot && one.robot != nobody) {
                    constraints.push_back({row, one.time.start, one.time.end});
                }
            }
        }
        for (RobotId other = 0; other < problem_.n_robots() && problem_.may_follow(); ++other) {
            const auto& visits = plan_.track(other).visits;
            for (std::size_t k = 1; k < visits.size() && other != robot; ++k) {
                const EdgeId back = problem_.graph().edge(visits[k].vertex, visits[k - 1].vertex);
                if (back >= 0) {
                    constraints.push_back(against_move(problem_, back, visits[k].enter));
                }
            }
        }
        return constraints;
    }

    FleetPlan& plan_;
    const Problem& problem_;
    Traffic closures_;
    JointSearch joint_;
    std::deque<TripReader> trips_;  // one per robot: a reader keeps one trip
    std::span<Tick> waits_;
    Tick latest_;
    std::int64_t most_states_;
    const StopCondition& is_over_;
};

}  // namespace

bool take_fewest_actions(SharedDistances& distances, FleetPlan& plan, std::span<Tick> waits,
                         Tick latest, std::int64_t most_states, const StopCondition& is_over) {
    const Problem& problem = plan.problem();
    ActionSearch search(distances, plan, waits, latest, most_states, is_over);
    try {
        if (waits.size() <= JointSearch::most_robots && search.take_all()) {
            return true;
        }
        // A rotation of some robots is seen by no single one.
        const bool may_change = !problem.may_follow() || problem.rules().rotations;
        for (bool has_changed = may_change; has_changed;) {
            has_changed = false;
            for (RobotId robot = 0; robot < problem.n_robots(); ++robot) {
                has_changed = (waits[index(robot)] > 0 && search.take_one(robot)) || has_changed;
            }
        }
    } catch (const Stopped&) {  // what has been taken is kept
    }
    return false;
}

}  // namespace rightofway

// A plan of a whole fleet that planners make and improve, one call after another.
//
// First tracks come from prioritized planning (`prioritize`, `repair`), or are given (`start`);
// `improve` replaces them by better ones, `restore` gives robots earlier tracks again, `retime`
// makes robots as early as the order of visits allows. The seed decides all that is drawn.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/poll.hpp"
#include "distances/shared_distances.hpp"
#include "lns/anytime_lns.hpp"
#include "lns/fleet_plan.hpp"
#include "lns/prioritized_portfolio.hpp"
#include "problem/problem.hpp"
#include "search/sipp.hpp"

namespace rightofway {

// Robot r has the visits first_visit[r] .. first_visit[r + 1] - 1; none: no track.
struct GivenTracks {
    std::span<const std::int32_t> first_visit;
    std::span<const VertexId> vertices;
    std::span<const Tick> enter;
};

// All functions check what they are given, and throw std::invalid_argument with array, index,
// value.
class FleetSearch {
  public:
    // Borrows the problem. 1 to 1024 threads. Surcharges count in no makespan: only for the
    // flowtime. Tracks may conflict after the horizon.
    FleetSearch(const Problem& problem, std::uint64_t seed, std::size_t n_threads,
                Objective objective = Objective::flowtime, Tick horizon = never);

    // The least completion of each robot without the others, -1 if it cannot get to a stage; null
    // if there was no time.
    const std::vector<Tick>* alone(const StopCondition& deadline);
    // Takes over what `alone` returned for the same trips.
    void take_alone(std::span<const Tick> alone);

    // Takes over tracks. They overlap no other track.
    void start(const GivenTracks& given);

    // Starts from tracks of an earlier plan. A robot whose track serves its stages keeps it. The
    // robots of `order` get new tracks one after another; until a robot has one, its earlier track
    // stays booked. Returns the robots that have no track: none was found or given, or it overlaps
    // one before it.
    std::vector<RobotId> take_over(const GivenTracks& given, std::span<const RobotId> order,
                                   const StopCondition& deadline);

    // Gives the robots tracks in this order, which names every robot once. Whether all have one.
    bool prioritize(std::span<const RobotId> order, std::int64_t n_searches,
                    const StopCondition& deadline, const StopCondition& with_fallback);
    // Continues a `prioritize` that returned false.
    bool resume(std::int64_t n_searches, const StopCondition& deadline,
                const StopCondition& with_fallback);
    // Plans robots in this order beside the present tracks, and takes the plan over if it is
    // better. Whether the attempt has ended. Another call continues one that has not; `improve` and
    // `start` may come between. A greedy attempt is quick, and ends in one call or never.
    bool compete(std::span<const RobotId> order, std::int64_t n_searches,
                 const StopCondition& deadline);
    void hurry(std::span<const RobotId> order, std::int64_t n_searches,
               const StopCondition& deadline);
    // Gives all robots tracks on which one of them moves at a time. Whether this was possible. Only
    // for a problem with times of stages.
    bool move_one_at_a_time(const StopCondition& deadline);
    // Gives tracks to the robots that have none, in this order. Whether all have one.
    bool repair(std::span<const RobotId> order, std::int64_t n_searches,
                const StopCondition& deadline);

    // Gives robots these tracks where that costs no more; the number of robots that have theirs.
    std::int64_t restore(const GivenTracks& given, const StopCondition& interrupt);
    // Replans neighbourhoods until one of the numbers is reached; the number of them.
    std::int64_t improve(std::int64_t n_tasks, std::int64_t patience, const StopCondition& deadline,
                         const StopCondition& pause);
    void retime(const StopCondition& interrupt);

    const FleetPlan& plan() const { return plan_; }
    Tracks tracks() const { return plan_.tracks(); }
    Tick cost() const { return plan_.cost(); }
    Tick value() const { return plan_.worth().value; }
    std::int64_t n_idle() const { return improvement_ ? improvement_->n_idle() : 0; }
    std::int64_t n_expanded() const { return improvement_ ? improvement_->n_expanded() : 0; }

  private:
    std::size_t n_robots() const { return static_cast<std::size_t>(problem_.n_robots()); }
    Tick latest() const;
    void require_each_once(std::span<const RobotId> order) const;
    void require_tracks(const GivenTracks& given) const;
    void require_all_tracks(const char* what) const;
    TimedTrack track_of(RobotId robot, const GivenTracks& given) const;
    bool measure(RobotId robot, TimedTrack& track) const;
    bool replace_track(RobotId robot, SafeIntervalSearch& search, TripReader& reader,
                       const StopCondition& deadline);
    std::vector<TimedTrack> tracks_of(const GivenTracks& given) const;
    void measure_least();
    std::vector<RobotId> find_conflict_closure(RobotId first, std::span<const TimedTrack> old,
                                               Poll& poll) const;
    void take_if_better(const FleetPlan& plan);
    void drop_searches();
    void clear();

    const Problem& problem_;
    SharedDistances distances_;
    FleetPlan plan_;
    std::uint64_t seed_;
    std::size_t n_threads_;
    std::vector<Tick> alone_;
    std::vector<Tick> least_costs_;  // of each robot
    bool is_alone_known_ = false;
    Tick bound_ = 0;
    std::optional<PrioritizedPortfolio> portfolio_;
    struct Rival {
        Rival(SharedDistances& distances, const Problem& problem, Objective objective, Tick horizon,
              std::span<const RobotId> order)
            : plan(problem, objective, horizon), portfolio(distances, plan, order) {}

        FleetPlan plan;
        PrioritizedPortfolio portfolio;
    };
    std::unique_ptr<Rival> rival_;  // portfolios refer to plans: it does not move
    std::optional<AnytimeLns> improvement_;
};

}  // namespace rightofway

// Large neighbourhood search (LNS): anytime improvement of one plan on several threads.
//
// A task removes the tracks of a few robots and replans them one after another, in random order;
// in half of the tasks the seed robot of the neighbourhood goes first. The plan keeps the result if
// its worth (objective.hpp) is no greater. A round has a fixed number of tasks. Each task starts
// from the plan at the beginning of the round, on the thread's replica, with the random stream
// (seed, round, task). After a round, results that still fit together are adopted in order of
// tasks. So the outcome depends on the seed and the number of tasks, not on the threads.
//
// Where stages have times, a task may replan windows instead of whole tracks: of robots that meet
// at about one time, each the part of its track around that time (window_search.hpp). A trip of
// twenty stages has many windows, and each is replanned in a small part of the time.
//
// For the makespan, half of the neighbourhoods grow around a robot that completes last. Where one
// of those is replanned, all robots of the task have to complete before the makespan, whatever the
// flowtime; in other tasks none may complete at or after it, and the flowtime falls.
//
// Li et al., "Anytime multi-agent path finding via large neighborhood search", IJCAI 2021.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/task_crew.hpp"
#include "lns/adaptive_choice.hpp"
#include "lns/fleet_plan.hpp"
#include "lns/neighbourhoods.hpp"
#include "lns/window_search.hpp"
#include "search/sipp.hpp"

namespace rightofway {

class Lns {
  public:
    // Borrows all; every robot needs a track. `alone`: completion time of each robot driving alone.
    Lns(SharedDistances& distances, FleetPlan& plan, std::span<const Tick> alone,
        std::uint64_t seed, std::size_t n_threads);
    ~Lns();

    // Does `n_tasks` tasks. Stops early after `patience` tasks of whole tracks in a row without a
    // gain, once `is_over` is true, or at the end of a round if `is_due` is true. Only the calling
    // thread evaluates both. Rethrows an exception of `is_over` or of a task once the plan is
    // complete.
    void run(std::int64_t n_tasks, std::int64_t patience, const StopCondition& is_over,
             const StopCondition& is_due);

    std::int64_t n_tasks() const { return n_tasks_; }
    std::int64_t n_idle() const { return n_idle_; }  // since the last gain
    std::int64_t n_expanded() const;

  private:
    static constexpr std::array<std::size_t, 4> sizes{2, 4, 8, 16};

    struct Task {
        std::vector<RobotId> robots;
        std::vector<TrackWindow> windows;  // one for each robot, unless tracks are whole
        std::vector<TimedTrack> tracks;
        std::size_t neighbourhood = 0;  // index of kind and size; of windows, of size
        bool has_windows = false;
        Tick gain = -1;  // below 0: nothing found that is as good
        std::int64_t effort = 0;
    };
    struct Worker;

    void round(std::size_t n, const StopCondition& is_over);
    void attempt(Worker& worker, Task& task, Random& random, const StopCondition& is_over);
    void choose_windows(Worker& worker, Task& task, Random& random) const;
    void replan(Worker& worker, Task& task, const StopCondition& is_over);
    void replan_windows(Worker& worker, Task& task, const StopCondition& is_over);
    bool find_windows(Worker& worker, Task& task, std::size_t& n_found,
                      const StopCondition& is_over);
    struct Limits {
        Tick slack = 0;  // allowed sum of weighted costs above `alone`
        Tick latest = never;
    };
    Limits limits_of(const Task& task, const FleetPlan& plan) const;
    bool find_tracks(Worker& worker, const Task& task, Limits& limits,
                     const StopCondition& is_over);
    Tick gain_of(const Worth& before, const Worth& after) const;
    void settle(std::size_t n);
    bool adopt(Task& task, bool may_clash);

    FleetPlan& plan_;
    std::span<const Tick> alone_;
    Tick longest_alone_;
    std::uint64_t seed_;
    std::vector<FleetPlan> replicas_;
    std::vector<std::unique_ptr<Worker>> workers_;
    std::vector<Task> tasks_;
    std::vector<std::uint8_t> is_touched_;
    AdaptiveChoice neighbourhood_;
    bool has_windows_;     // the problem may have
    EffortShares shares_;  // of tasks that replan whole tracks, and windows
    AdaptiveChoice size_of_windows_;
    TaskCrew crew_;
    std::uint64_t n_rounds_ = 0;
    std::int64_t n_tasks_ = 0;
    std::int64_t n_idle_ = 0;
};

}  // namespace rightofway

// Conflict-based search (CBS): a plan of least flowtime and surcharges, with its proof.
//
// The high level is a tree. Each node constrains each robot by some bookings of nobody and has, for
// each robot, a track of least cost under them; so the sum of these costs is a lower bound of all
// plans that keep the constraints. Where two tracks conflict, every plan keeps one of two
// constraints (track_conflicts.hpp), and the node gets a child for each. The search expands the
// node of least bound first; a node without conflicts is an optimal plan.
//
// What makes it fast can be switched (CbsOptions): of the children of a conflict of points, one
// holds a robot to where it is and the other keeps it away (decision 9), conflicts that cost both
// robots something are resolved first, tracks of equal cost with fewer conflicts replace others
// without a split, and the losses of pairs of robots, each solved for itself, raise the bound of a
// node by the least weighted vertex cover. Two symmetries are one split each: a robot that has
// reached its end, and a pair of which one robot or the other has to complete later (decision 9).
// A fleet of few robots is searched by joint states in turn, which ends also where there is no plan
// (decision 10).
//
// With a factor above 1 it is a focal search: it takes in turn the node of least bound, and the
// node with the fewest conflicts of those whose tracks cost little enough.
//
// Sharon, Stern, Felner & Sturtevant, "Conflict-based search for optimal multi-agent pathfinding",
// Artificial Intelligence 219, 2015.
// Boyarski et al., "ICBS: Improved conflict-based search algorithm for multi-agent pathfinding",
// IJCAI 2015 (cardinal conflicts, bypass).
// Li, Felner, Boyarski, Ma & Koenig, "Improved heuristics for multi-agent path finding with
// conflict-based search", IJCAI 2019 (WDG).
// Li, Harabor, Stuckey, Ma, Felner & Koenig, "Disjoint splitting for multi-agent path finding with
// conflict-based search", ICAPS 2019.
// Barer, Sharon, Stern & Felner, "Suboptimal variants of the conflict-based search algorithm for
// the multi-agent pathfinding problem", SoCS 2014 (focal search). Li et al., "Pairwise symmetry
// reasoning for multi-agent path finding search", Artificial Intelligence 301, 2021 (targets,
// corridors, rectangles).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cbs/cbs_options.hpp"
#include "cbs/constrained_tracks.hpp"
#include "cbs/constraint_sets.hpp"
#include "cbs/pair_losses.hpp"
#include "cbs/track_conflicts.hpp"
#include "core/open_list.hpp"
#include "core/search_end.hpp"
#include "problem/problem.hpp"

namespace rightofway {

// One tree, for some of the robots.
class ConflictTree {
  public:
    // Borrows the tracks and the losses of pairs; without these, nodes have no heuristic.
    ConflictTree(ConstrainedTracks& tracks, std::vector<RobotId> robots, const CbsOptions& options,
                 PairLosses* losses);

    // Costs that the robots' tracks must not exceed, besides the latest completion of all.
    void limit(std::span<const Tick> most);

    // Makes the root. False if a robot has no track, so that no plan exists. Throws Stopped.
    bool start(std::span<const SetId> sets, const StopCondition& is_over);

    // Expands nodes until there is a plan, or the bound is `enough` or more, or no node is left:
    // found, stopped with that bound, proven none. A plan is enough if it costs at most the factor
    // times the bound. Nodes with a bound of `upper` or more are left
    // out; the bound ends at `upper` if no other is left. Stops after `most_nodes`. Throws
    // Stopped; the bound is valid then, has the losses of pairs that were solved, and the search
    // can go on.
    SearchEnd run(Tick upper, Tick enough, std::int64_t most_nodes, const StopCondition& is_over);

    // No plan that keeps the constraints of the root costs less; `upper` if that was reached.
    Tick bound() const { return bound_; }
    // The tracks of the plan found, in the order of the robots.
    const std::vector<const ConstrainedTrack*>& tracks() const { return found_; }
    std::int64_t n_nodes() const { return n_nodes_; }
    std::size_t bytes() const { return bytes_; }

  private:
    static constexpr std::int64_t first_joint_search = 50;

    struct Node {
        std::vector<SetId> sets;
        std::vector<const ConstrainedTrack*> tracks;
        std::vector<TrackConflict> conflicts;
        Tick cost = 0;             // of the tracks
        Tick least = 0;            // of the best tracks under the constraints
        Tick bound = 0;            // of all plans that keep the constraints
        bool is_measured = false;  // its bound has the losses of pairs
        bool is_clear = false;     // tracks with fewer conflicts were looked for
        bool is_open = false;
    };

    void push(Node&& node, Tick upper);
    std::int32_t least_open();
    std::int32_t take(std::int32_t least);
    Tick most_cost() const;
    void raise_bound(Tick upper);
    void load(const Node& node);
    std::vector<std::pair<RobotId, RobotId>> pairs_in_conflict(const Node& node) const;
    void measure(Node& node, const StopCondition& is_over);
    bool split(Node& node, Tick upper, const StopCondition& is_over);
    void clear(Node& node, const StopCondition& is_over);
    const ConstrainedTrack* clearest(const Node& node, RobotId robot, const StopCondition& is_over);
    void take_best(Node& node, const StopCondition& is_over);
    std::int64_t joint_states(std::int64_t n_nodes) const;
    std::optional<SearchEnd> search_joint_states(Tick upper, const StopCondition& is_over);
    std::optional<TrackConflict> choose(Node& node, const StopCondition& is_over);
    std::optional<TrackConflict> split_pair(const Node& node, RobotId first, RobotId second,
                                            const StopCondition& is_over);
    static void hold(Node& node, RobotId robot, SetId set);
    bool may_hold() const;
    const Constraint* held_in(const Node& node, const TrackConflict& conflict,
                              std::size_t side) const;
    void weigh(const Node& node, TrackConflict& conflict, const StopCondition& is_over);
    bool bypass(Node& node, const TrackConflict& conflict, const StopCondition& is_over);
    bool offer(Node& node, RobotId robot, const ConstrainedTrack* track);
    void meet_others(const Node& node, RobotId robot, const ConstrainedTrack& track,
                     std::vector<TrackConflict>& conflicts);
    std::optional<Node> child(const Node& node, RobotId robot, SetId set, Tick upper,
                              const StopCondition& is_over);
    void replace(Node& node, RobotId robot, const ConstrainedTrack* track);
    static std::ptrdiff_t count_conflicts(const Node& node, RobotId robot);
    static std::size_t bytes_of(const Node& node);

    ConstrainedTracks& tracks_;
    std::vector<RobotId> robots_;
    std::vector<SetId> sets_;  // of the root
    CbsOptions options_;
    PairLosses* losses_;
    ConflictFinder finder_;
    std::optional<Traffic> traffic_;  // of the node at hand; not for pairs
    std::deque<Node> nodes_;
    OpenList open_;    // all open nodes, least bound first, and some that are not open any more
    OpenList costly_;  // those whose tracks cost too much to be enough, least cost first
    OpenList focal_;   // those whose tracks do not, fewest conflicts first
    bool takes_least_ = false;  // whether the next node is that of least bound
    std::vector<Tick> most_;    // cost of each robot's track
    std::vector<TrackConflict> met_;
    std::vector<const ConstrainedTrack*> found_;
    Tick first_ = 0;  // bound of the root
    Tick bound_ = 0;
    Tick cut_off_ = never;  // least bound of a node left out
    std::int64_t n_nodes_ = 0;
    std::int64_t next_joint_search_ = first_joint_search;  // after these nodes
    std::size_t bytes_ = 0;
};

}  // namespace rightofway

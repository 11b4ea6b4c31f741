// Conflict-based search (CBS): a plan of least flowtime and surcharges, with its proof.
//
// The high level is a tree. Each node constrains each robot by some bookings of nobody and has, for
// each robot, a track of least cost under them; so the sum of these costs is a lower bound of all
// plans that keep the constraints. Where two tracks conflict, every plan keeps one of two
// constraints (track_conflicts.hpp), and the node gets a child for each. The search expands the
// node of least bound first; a node without conflicts is an optimal plan.
//
// What makes it fast can be switched (CbsOptions): conflicts that cost both robots something are
// resolved first, tracks of equal cost with fewer conflicts replace others without a split, and the
// losses of pairs of robots, each solved for itself, raise the bound of a node by the least
// weighted vertex cover.
//
// Sharon, Stern, Felner & Sturtevant, "Conflict-based search for optimal multi-agent pathfinding",
// Artificial Intelligence 219, 2015.
// Boyarski et al., "ICBS: Improved conflict-based search algorithm for multi-agent pathfinding",
// IJCAI 2015 (cardinal conflicts, bypass).
// Li, Felner, Boyarski, Ma & Koenig, "Improved heuristics for multi-agent path finding with
// conflict-based search", IJCAI 2019 (WDG).
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "cbs/constrained_tracks.hpp"
#include "cbs/constraint_sets.hpp"
#include "cbs/track_conflicts.hpp"
#include "core/open_list.hpp"
#include "core/search_end.hpp"
#include "problem/problem.hpp"

namespace rightofway {

struct CbsOptions {
    bool cardinal = true;  // resolve conflicts first that cost both robots something
    bool bypass = true;    // replace tracks by others of equal cost with fewer conflicts
    bool clear = true;     // look for tracks of equal cost without any conflict
    // Nodes at most to solve each pair of robots, whose losses raise the bounds of nodes; 0: no
    // such losses.
    std::int64_t pair_nodes = 100;
};

// The losses of pairs of robots, each pair solved for itself and kept.
class PairLosses {
  public:
    PairLosses(ConstrainedTracks& tracks, const CbsOptions& options)
        : tracks_(tracks), options_(options) {
        options_.clear = false;  // it costs more than the trees of most pairs
    }

    // A lower bound of what two robots lose together by each other, above their least costs under
    // their constraints; `never` if they have no plan.
    Tick of(RobotId first, SetId first_set, RobotId second, SetId second_set,
            const StopCondition& is_over);

  private:
    struct Key {
        RobotId first;
        RobotId second;
        SetId first_set;
        SetId second_set;
        bool operator==(const Key&) const = default;
    };
    struct Hash {
        std::size_t operator()(const Key& key) const;
    };

    ConstrainedTracks& tracks_;
    CbsOptions options_;
    std::unordered_map<Key, Tick, Hash> known_;
};

// One tree, for some of the robots.
class ConflictTree {
  public:
    // Borrows the tracks and the losses of pairs; without these, nodes have no heuristic.
    ConflictTree(ConstrainedTracks& tracks, std::vector<RobotId> robots, const CbsOptions& options,
                 PairLosses* losses);

    // Makes the root. False if a robot has no track, so that no plan exists. Throws Stopped.
    bool start(std::span<const SetId> sets, const StopCondition& is_over);

    // Expands nodes until there is a plan, or the bound is `enough` or more, or no node is left:
    // found, stopped with that bound, proven none. Nodes with a bound of `upper` or more are left
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
    struct Node {
        std::vector<SetId> sets;
        std::vector<const ConstrainedTrack*> tracks;
        std::vector<TrackConflict> conflicts;
        Tick cost = 0;
        Tick bound = 0;
        bool is_measured = false;  // its bound has the losses of pairs
        bool is_clear = false;     // tracks without conflict were looked for
    };

    void push(Node&& node, Tick upper);
    void raise_bound(Tick upper);
    void measure(Node& node, const StopCondition& is_over);
    bool split(Node& node, Tick upper, const StopCondition& is_over);
    void clear(Node& node, const StopCondition& is_over);
    const TrackConflict* choose(Node& node, const StopCondition& is_over);
    void weigh(const Node& node, TrackConflict& conflict, const StopCondition& is_over);
    bool bypass(Node& node, const TrackConflict& conflict, const StopCondition& is_over);
    void branch(const Node& node, RobotId robot, SetId set, Tick upper,
                const StopCondition& is_over);
    void replace(Node& node, RobotId robot, const ConstrainedTrack* track);
    static std::size_t bytes_of(const Node& node);

    ConstrainedTracks& tracks_;
    std::vector<RobotId> robots_;
    CbsOptions options_;
    PairLosses* losses_;
    ConflictFinder finder_;
    std::optional<Traffic> traffic_;  // made at the first use
    std::deque<Node> nodes_;
    OpenList open_;
    std::vector<TrackConflict> met_;
    std::vector<const ConstrainedTrack*> found_;
    Tick first_ = 0;  // bound of the root
    Tick bound_ = 0;
    Tick cut_off_ = never;  // least bound of a node left out
    std::int64_t n_nodes_ = 0;
    std::size_t bytes_ = 0;
};

}  // namespace rightofway

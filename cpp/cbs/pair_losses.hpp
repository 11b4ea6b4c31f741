// Time that pairs of robots lose to each other; each pair is solved separately.
//
// Li, Felner, Boyarski, Ma & Koenig, "Improved heuristics for multi-agent path finding with
// conflict-based search", IJCAI 2019 (weighted dependency graph).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>

#include "cbs/cbs_options.hpp"
#include "cbs/constrained_tracks.hpp"
#include "cbs/constraint_sets.hpp"
#include "core/search_end.hpp"

namespace rightofway {

// What two robots lose by each other, above their least costs under their constraints: lower
// bounds.
struct PairLoss {
    Tick together = 0;      // `never` if they have no plan
    bool is_exact = false;  // no longer search would raise that
    // The first robot loses this or more, or the second robot does; not known before it is asked.
    std::array<Tick, 2> either{-1, -1};
};

// The losses of pairs of robots, each pair solved for itself and kept: by a tree of few nodes,
// which is enough for most pairs, and else by joint states. All pairs together search no more
// states than they are allowed to. A pair whose search stopped has a bound, and waits until a
// longer search is allowed.
class PairLosses {
  public:
    PairLosses(ConstrainedTracks& tracks, const CbsOptions& options)
        : tracks_(tracks), options_(options), most_states_(options.joint_states) {
        options_.clear = false;  // it costs more than the trees of most pairs
    }

    // Lets all pairs together search this many joint states.
    void allow(std::int64_t states) { most_states_ = std::max(most_states_, states); }

    std::int64_t n_states() const { return n_states_; }

    // A lower bound of what two robots lose together. Throws Stopped.
    Tick together(std::array<RobotId, 2> robots, std::array<SetId, 2> sets,
                  const StopCondition& is_over);

    // Bounds of which one or the other holds in every plan; only for pairs that lose something
    // together. Throws Stopped.
    std::array<Tick, 2> either(std::array<RobotId, 2> robots, std::array<SetId, 2> sets,
                               const StopCondition& is_over);

  private:
    struct Key {
        std::array<RobotId, 2> robots;
        std::array<SetId, 2> sets;
        bool operator==(const Key&) const = default;
    };
    struct Hash {
        std::size_t operator()(const Key& key) const;
    };

    PairLoss& of(const Key& key, const StopCondition& is_over);
    PairLoss solve(const Key& key, std::array<Tick, 2> most, const StopCondition& is_over);
    void search_states(const Key& key, std::array<Tick, 2> most, PairLoss& loss,
                       const StopCondition& is_over);

    ConstrainedTracks& tracks_;
    CbsOptions options_;
    std::int64_t most_states_;
    std::int64_t n_states_ = 0;  // searched
    std::unordered_map<Key, PairLoss, Hash> known_;
    std::unordered_map<Key, std::int64_t, Hash> needed_;  // states, by two robots without sets
};

}  // namespace rightofway

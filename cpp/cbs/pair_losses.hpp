// What pairs of robots lose to each other, each pair solved for itself.
//
// Li, Felner, Boyarski, Ma & Koenig, "Improved heuristics for multi-agent path finding with
// conflict-based search", IJCAI 2019 (weighted dependency graph).
#pragma once

#include <array>
#include <cstddef>
#include <unordered_map>

#include "cbs/cbs_options.hpp"
#include "cbs/constrained_tracks.hpp"
#include "cbs/constraint_sets.hpp"
#include "core/search_end.hpp"

namespace rightofway {

// What two robots lose by each other, above their least costs under their constraints: lower
// bounds.
struct PairLoss {
    Tick together = 0;  // `never` if they have no plan
    // The first robot loses this or more, or the second robot does; not known before it is asked.
    std::array<Tick, 2> either{-1, -1};
};

// The losses of pairs of robots, each pair solved for itself and kept.
class PairLosses {
  public:
    PairLosses(ConstrainedTracks& tracks, const CbsOptions& options)
        : tracks_(tracks), options_(options) {
        options_.clear = false;  // it costs more than the trees of most pairs
    }

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
    Tick least_loss(const Key& key, std::array<Tick, 2> costs, const StopCondition& is_over);

    ConstrainedTracks& tracks_;
    CbsOptions options_;
    std::unordered_map<Key, PairLoss, Hash> known_;
};

}  // namespace rightofway

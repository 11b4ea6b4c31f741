// The list of rights of way given so far, indexed by both of their visits.
//
// Rights of way are numbered in the order of giving, and forgotten in reverse order. A right of way
// keeps its number until it is forgotten, also while it is taken back on trial.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/types.hpp"

namespace rightofway {

struct RightOfWay {
    VisitId first;   // this visit leaves the vertex ...
    VisitId second;  // ... before this one enters it
};

class RightsOfWay {
  public:
    explicit RightsOfWay(VisitId n_visits)
        : latest_of_first_(static_cast<std::size_t>(n_visits), none),
          latest_of_second_(static_cast<std::size_t>(n_visits), none) {}

    // The number of the right of way of one visit over another, or `none`.
    std::int32_t find(VisitId first, VisitId second) const;

    std::int32_t give(VisitId first, VisitId second);  // returns its number
    void forget_latest();                              // the last given; unlinks it if it holds
    void take_back(std::int32_t right) { unlink(right); }
    void restore(std::int32_t right) { link(right); }

    // The rights of way that hold, in the order of giving.
    std::vector<RightOfWay> list() const;

    // Calls use(visit) for each visit over which `first` has the right of way; and vice versa.
    template <class Use>
    void for_each_second(VisitId first, Use&& use) const {
        for (std::int32_t k = latest_of_first_[index(first)]; k != none;
             k = next_of_first_[index(k)]) {
            use(rights_[index(k)].second);
        }
    }
    template <class Use>
    void for_each_first(VisitId second, Use&& use) const {
        for (std::int32_t k = latest_of_second_[index(second)]; k != none;
             k = next_of_second_[index(k)]) {
            use(rights_[index(k)].first);
        }
    }

  private:
    void link(std::int32_t right);
    void unlink(std::int32_t right);

    // By number; the rights of way of one visit form a linked list.
    std::vector<RightOfWay> rights_;
    std::vector<std::uint8_t> holds_;
    std::vector<std::int32_t> next_of_first_;
    std::vector<std::int32_t> next_of_second_;
    std::vector<std::int32_t> latest_of_first_;   // per visit
    std::vector<std::int32_t> latest_of_second_;  // per visit
};

}  // namespace rightofway

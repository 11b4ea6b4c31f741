// Search for the times that a new arc raises in a longest-path graph, and for cycles it closes.
//
// S. Cotton and O. Maler, Fast and flexible difference constraint propagation for DPLL(T), SAT
// 2006.
//
// Every visit is a node; enters are the least solution of enter[q] >= enter[p] + length(p, q). A
// new arc into b raises b by delta ticks. The old times satisfy every old arc, so a raise shrinks
// along a path by the slack of each arc. Visits are therefore settled in order of falling raise,
// each once: Dijkstra's algorithm on raises. The new arc u -> b closes a cycle of positive length
// (a deadlock) exactly if the raise of b reaches u. The search changes no times: the derived class
// accepts or forgets the raises.
//
// The steps as published, with raises instead of falls; the numbers stand beside the code:
//
//      add the arc u -> b:
//   1      raise(b) <- enter(u) + length(u, b) - enter(b); raise(w) <- 0 for all other w
//   2      while some raise is above 0 and not settled, and raise(u) = 0:
//   3          s <- the visit with the greatest of them, which is settled now
//   4          for each arc s -> t to a visit that is not settled:
//   5              raise(t) <- max(raise(t), enter(s) + raise(s) + length(s, t) - enter(t))
//   6      the arc closes a cycle of positive length if raise(u) > 0
//
// What is added: visits later than u cannot reach it, so they wait until u is known to be safe.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/types.hpp"

namespace rightofway {

// The derived class provides, for the current times and the raises on trial:
//   Tick enter(Visit) const;
//   Tick& raise(Visit);             0 if the visit is not raised
//   Visit& cause(Visit);            the visit whose raise raised it, or no_cause
//   void for_each_arc(Visit, use);  use(Visit to, Tick length) for each arc from a visit
template <class Derived, class Visit>
class RaiseSearch {
  protected:
    explicit RaiseSearch(Visit no_cause) : no_cause_(no_cause) {}

    // Raises b and its successors; false as soon as the raise reaches the source of the new arc.
    // No arc leads back in time: only visits entered no later than the source can reach the source.
    // These visits are settled; raises of later visits are recorded but not followed.
    bool spread(Visit b, Tick delta, Visit source) {
        latest_ = self().enter(source);
        raise_by(b, delta, no_cause_);  // 1
        return settle(source);
    }

    // Follows the recorded raises of later visits, after a spread that did not reach the source.
    void spread_on(Visit source) {
        for (const Visit visit : raised_) {
            if (self().enter(visit) > latest_) {
                open(self().raise(visit), visit);
            }
        }
        latest_ = never;
        settle(source);
    }

    // Writes the cycle that a refused arc would close, from b to the source, along the causes.
    void explain(Visit source) {
        cycle_.clear();
        for (Visit visit = source; visit != no_cause_; visit = self().cause(visit)) {
            cycle_.push_back(visit);
        }
        std::reverse(cycle_.begin(), cycle_.end());
    }

    void forget_raises() {
        for (const Visit visit : raised_) {
            self().raise(visit) = 0;
        }
        raised_.clear();
        open_.clear();
    }

    Tick latest_ = never;
    std::vector<Visit> raised_;  // each once
    std::vector<Visit> cycle_;

  private:
    struct Raise {
        Tick delta;
        Visit visit;
        // Max-heap by raise; ties by visit, so that the order is total.
        bool operator<(const Raise& other) const {
            return delta != other.delta ? delta < other.delta : visit > other.visit;
        }
    };

    Derived& self() { return static_cast<Derived&>(*this); }

    bool settle(Visit source) {
        while (!open_.empty()) {  // 2
            std::pop_heap(open_.begin(), open_.end());
            const Raise top = open_.back();  // 3
            open_.pop_back();
            if (top.delta < self().raise(top.visit)) {
                continue;  // outdated: raised further
            }
            self().for_each_arc(top.visit, [&](Visit to, Tick length) {  // 4
                const Tick slack = self().enter(to) - self().enter(top.visit) - length;
                const Tick delta = self().raise(top.visit) - slack;
                if (delta > self().raise(to)) {
                    raise_by(to, delta, top.visit);  // 5
                }
            });
            if (self().raise(source) > 0) {
                return false;  // 6
            }
        }
        return true;
    }

    void raise_by(Visit visit, Tick delta, Visit cause) {
        if (self().raise(visit) == 0) {
            raised_.push_back(visit);
        }
        self().raise(visit) = delta;
        self().cause(visit) = cause;
        if (self().enter(visit) <= latest_) {
            open(delta, visit);
        }
    }

    void open(Tick delta, Visit visit) {
        open_.push_back({delta, visit});
        std::push_heap(open_.begin(), open_.end());
    }

    Visit no_cause_;
    std::vector<Raise> open_;  // a heap
};

}  // namespace rightofway

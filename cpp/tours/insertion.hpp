// The best places of a job's stops in a tour.
//
// The stops are inserted one after another, each after the one before it: dynamic programming over
// the gaps of the tour and the number of stops inserted so far. A label has a time and a cost; for
// objectives of completions alone the earliest label of a state is enough. So a job of s stops
// takes O(s n) steps in a tour of n stops, instead of O(n^s).
//
// Ropke & Pisinger, "An adaptive large neighborhood search heuristic for the pickup and delivery
// problem with time windows", Transportation Science 2006 (basic insertion).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/random.hpp"
#include "tours/tour.hpp"

namespace rightofway {

struct Insertion {
    double score = std::numeric_limits<double>::infinity();  // what it adds to the objective
    RobotId robot = nobody;
    std::vector<std::int32_t> gaps;  // one for each stop, in the tour before the insertion

    bool exists() const { return robot != nobody; }
};

// Writes a tour with the stops of a job inserted.
void insert_stops(const TourProblem& problem, std::span<const std::int32_t> stops, std::int32_t job,
                  std::span<const std::int32_t> gaps, std::vector<std::int32_t>& with);

// What does not depend on the tour.
struct InsertionQuery {
    std::int32_t job;
    Tick release;      // the job must not begin before
    Tick makespan;     // of all tours now
    double skips = 0;  // with this probability a gap is not tried ("blinks")
};

class InsertionFinder {
  public:
    // Borrows all.
    InsertionFinder(const TourProblem& problem, ChargePlanner& charges);

    // Replaces `best` if the tour has a better insertion. `releases` are those of the other jobs.
    // The job begins after gap `first_gap`.
    void improve(const Tour& tour, const InsertionQuery& query, std::size_t first_gap,
                 std::span<const Tick> releases, Random& random, Insertion& best);

    // The change of the objective: with this service and completion instead of those of the tour.
    double score(const Tour& tour, std::int64_t service, Tick completion, Tick makespan) const;

  private:
    struct Label {
        Tick t;
        std::int64_t cost;  // of stops of the tour since the first gap, and of the job
        std::int32_t place;
        std::int32_t chain;  // index in `chain_`: the gaps
    };
    struct Link {
        std::int32_t gap;
        std::int32_t parent;
    };
    struct Candidate {
        double score;
        std::int32_t chain;
    };

    void insert(const Label& from, std::size_t k, std::size_t gap);
    void finish(const Label& label, std::size_t gap);
    void go_on(const Label& label, std::size_t k, std::size_t gap);
    void keep(std::vector<Label>& labels, const Label& label) const;
    bool is_hopeless(const Label& label, std::size_t gap, Tick arrival) const;
    void read_gaps(std::int32_t chain, std::vector<std::int32_t>& gaps) const;
    void choose_charged(std::span<const Tick> releases);

    const TourProblem& problem_;
    ChargePlanner& charges_;
    bool is_service_;
    const Tour* tour_ = nullptr;
    const TourRobot* robot_ = nullptr;
    InsertionQuery query_{};
    std::span<const TourStop> stops_;
    std::vector<std::int32_t> loads_;  // on board after so many stops of the job
    Insertion* best_ = nullptr;
    std::vector<std::vector<Label>> moving_;    // k stops inserted before this gap
    std::vector<std::vector<Label>> inserted_;  // stop k - 1 inserted in this gap
    std::vector<std::vector<Label>> next_;
    std::vector<Link> chain_;
    std::vector<Candidate> candidates_;
    std::vector<std::int32_t> with_;
    std::vector<Tick> releases_;
    TourTimes times_;
};

}  // namespace rightofway

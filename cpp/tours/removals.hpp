// Which jobs to remove from the tours of a fleet, to insert them again at better places.
//
// Shaw, "Using constraint programming and local search methods to solve vehicle routing problems",
// CP 1998 (related removal). Ropke & Pisinger, "An adaptive large neighborhood search heuristic for
// the pickup and delivery problem with time windows", Transportation Science 2006 (worst removal).
// Christiaens & Vanden Berghe, "Slack induction by string removals for vehicle routing problems",
// Transportation Science 2020 (strings of neighbouring tours).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/random.hpp"
#include "tours/tour_plan.hpp"
#include "tours/tour_problem.hpp"

namespace rightofway {

enum class RemovalKind : std::int32_t { strings, related, worst, random, tours };
inline constexpr std::size_t n_removal_kinds = 5;

class Removals {
  public:
    // Borrows the problem.
    explicit Removals(const TourProblem& problem);

    // Chooses about `n` served jobs, each once; none if no job is served.
    const std::vector<std::int32_t>& choose(const TourPlan& plan, RemovalKind kind, std::size_t n,
                                            Random& random);
    // The jobs that are near a job, the nearest first.
    std::span<const std::int32_t> near(std::int32_t job) const {
        return {near_.data() + index(job) * n_near_, n_near_};
    }

  private:
    void find_near();
    double distance(std::int32_t a, std::int32_t b) const;
    double relatedness(const TourPlan& plan, std::int32_t a, std::int32_t b) const;
    void choose_strings(const TourPlan& plan, std::size_t n, Random& random);
    void take_string(const TourPlan& plan, std::int32_t job, std::size_t length, Random& random);
    void choose_related(const TourPlan& plan, std::size_t n, Random& random);
    void choose_worst(const TourPlan& plan, std::size_t n, Random& random);
    void choose_random(std::size_t n, Random& random);
    void choose_tours(const TourPlan& plan, std::size_t n, Random& random);
    void note_places(const TourPlan& plan);
    void add(std::int32_t job);

    const TourProblem& problem_;
    std::size_t n_near_ = 0;
    std::vector<std::int32_t> near_;
    double mean_distance_ = 1;
    std::vector<std::int32_t> served_;
    std::vector<std::vector<std::int32_t>> jobs_of_;  // of each tour, by their first stops
    std::vector<std::int32_t> rank_;                  // of each job in its tour
    std::vector<double> begin_;                       // of each served job
    double span_ = 1;                                 // of all begins
    std::vector<std::int32_t> chosen_;
    std::vector<std::uint8_t> is_chosen_;
    std::vector<std::pair<double, std::int32_t>> ranked_;
};

}  // namespace rightofway

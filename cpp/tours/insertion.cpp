#include "tours/insertion.hpp"

#include <algorithm>
#include <utility>

namespace rightofway {
namespace {

constexpr std::size_t most_partial = 4;   // labels of one state
constexpr std::size_t most_charged = 12;  // insertions for which charges are planned
constexpr double tie_break = 1e-6;        // of the flowtime, the last term of the objective

}  // namespace

void insert_stops(const TourProblem& problem, std::span<const std::int32_t> stops, std::int32_t job,
                  std::span<const std::int32_t> gaps, std::vector<std::int32_t>& with) {
    with.clear();
    const std::int32_t first = problem.job(job).first_stop;
    std::size_t k = 0;
    for (std::size_t gap = 0; gap <= stops.size(); ++gap) {
        for (; k < gaps.size() && index(gaps[k]) == gap; ++k) {
            with.push_back(first + static_cast<std::int32_t>(k));
        }
        if (gap < stops.size()) {
            with.push_back(stops[gap]);
        }
    }
}

InsertionFinder::InsertionFinder(const TourProblem& problem, ChargePlanner& charges)
    : problem_(problem),
      charges_(charges),
      is_service_(problem.objective() == TourObjective::service) {}

double InsertionFinder::score(const Tour& tour, std::int64_t service, Tick completion,
                              Tick makespan) const {
    const auto weight = static_cast<double>(problem_.robot(tour.robot()).weight);
    const double later = weight * static_cast<double>(completion - tour.completion());
    if (is_service_) {
        return static_cast<double>(service - tour.service()) + tie_break * later;
    }
    if (problem_.objective() == TourObjective::flowtime) {
        return later;
    }
    const auto longer = static_cast<double>(std::max<Tick>(completion - makespan, 0));
    return problem_.makespan_weight() * longer + later;
}

// Whether no insertion that continues this label can be better than the best one: later stops of
// the job only delay the tour.
bool InsertionFinder::is_hopeless(const Label& label, std::size_t gap, Tick arrival) const {
    if (arrival > tour_->latest(gap)) {
        return true;
    }
    const std::int64_t service = is_service_ ? label.cost + tour_->service_from(gap, arrival) : 0;
    return score(*tour_, service, tour_->completion_from(gap, arrival), query_.makespan) >=
           best_->score;
}

// Keeps the labels of a state that none of the others dominates, the earliest first.
void InsertionFinder::keep(std::vector<Label>& labels, const Label& label) const {
    if (!is_service_) {
        if (labels.empty()) {
            labels.push_back(label);
        } else if (label.t < labels.front().t) {
            labels.front() = label;
        }
        return;
    }
    for (const Label& other : labels) {
        if (other.t <= label.t && other.cost <= label.cost) {
            return;
        }
    }
    std::erase_if(
        labels, [&](const Label& other) { return label.t <= other.t && label.cost <= other.cost; });
    labels.push_back(label);
    if (labels.size() > most_partial) {
        labels.erase(
            std::max_element(labels.begin(), labels.end(),
                             [](const Label& a, const Label& b) { return a.cost < b.cost; }));
    }
}

// Inserts stop k of the job in this gap.
void InsertionFinder::insert(const Label& from, std::size_t k, std::size_t gap) {
    const TourStop& stop = stops_[k];
    const std::int32_t load = tour_->load(gap) + loads_[k + 1];
    if (load < 0 || load > robot_->capacity) {
        return;
    }
    const Tick arrival = from.t + problem_.drive(*robot_, from.place, stop.place);
    const Tick begin =
        std::max(arrival, k == 0 ? std::max(stop.earliest, query_.release) : stop.earliest);
    const Tick end = begin + stop.work;
    if (end > stop.latest || arrival >= TourProblem::no_way) {
        return;
    }
    const bool is_last = k + 1 == stops_.size();
    Label label{end, from.cost, stop.place, from.chain};
    if (is_last && is_service_) {
        label.cost += problem_.service(problem_.job(query_.job), end);
    }
    chain_.push_back({static_cast<std::int32_t>(gap), from.chain});
    label.chain = static_cast<std::int32_t>(chain_.size()) - 1;
    if (is_last) {
        finish(label, gap);
    } else {
        keep(inserted_[k + 1], label);
    }
}

// All stops are inserted, the last one in this gap.
void InsertionFinder::finish(const Label& label, std::size_t gap) {
    const std::int32_t next = tour_->place_after(gap, label.place);
    const Tick arrival = label.t + problem_.drive(*robot_, label.place, next);
    if (is_hopeless(label, gap, arrival)) {
        return;
    }
    const std::int64_t service = is_service_ ? label.cost + tour_->service_from(gap, arrival) : 0;
    const double found =
        score(*tour_, service, tour_->completion_from(gap, arrival), query_.makespan);
    if (robot_->battery >= 0) {
        candidates_.push_back({found, label.chain});
        return;
    }
    best_->score = found;
    best_->robot = tour_->robot();
    read_gaps(label.chain, best_->gaps);
}

// Serves the stop of the tour after this gap, with k stops of the job inserted before.
void InsertionFinder::go_on(const Label& label, std::size_t k, std::size_t gap) {
    const std::int32_t stop = tour_->stops()[gap];
    const TourStop& at = problem_.stop(stop);
    const Tick arrival = label.t + problem_.drive(*robot_, label.place, at.place);
    const std::int32_t load = tour_->load(gap + 1) + loads_[k];
    if (load > robot_->capacity || load < 0 || is_hopeless(label, gap, arrival)) {
        return;
    }
    Label after{std::max(arrival, tour_->earliest(gap)) + at.work, label.cost, at.place,
                label.chain};
    if (at.is_last && is_service_) {
        after.cost += problem_.service(problem_.job(at.job), after.t);
    }
    keep(next_[k], after);
}

void InsertionFinder::read_gaps(std::int32_t chain, std::vector<std::int32_t>& gaps) const {
    gaps.clear();
    for (; chain >= 0; chain = chain_[index(chain)].parent) {
        gaps.push_back(chain_[index(chain)].gap);
    }
    std::reverse(gaps.begin(), gaps.end());
}

// Plans charges for the most promising insertions. Their scores without charges are lower bounds.
void InsertionFinder::choose_charged(std::span<const Tick> releases) {
    std::stable_sort(candidates_.begin(), candidates_.end(),
                     [](const Candidate& a, const Candidate& b) { return a.score < b.score; });
    releases_.assign(releases.begin(), releases.end());
    releases_[index(query_.job)] = query_.release;
    std::vector<std::int32_t> gaps;
    for (std::size_t c = 0; c < std::min(most_charged, candidates_.size()); ++c) {
        if (candidates_[c].score >= best_->score) {
            return;
        }
        read_gaps(candidates_[c].chain, gaps);
        insert_stops(problem_, tour_->stops(), query_.job, gaps, with_);
        if (!charges_.plan(tour_->robot(), with_, releases_, times_)) {
            continue;
        }
        const double found = score(*tour_, times_.service, times_.completion, query_.makespan);
        if (found < best_->score) {
            best_->score = found;
            best_->robot = tour_->robot();
            std::swap(best_->gaps, gaps);
        }
    }
}

void InsertionFinder::improve(const Tour& tour, const InsertionQuery& query, std::size_t first_gap,
                              std::span<const Tick> releases, Random& random, Insertion& best) {
    tour_ = &tour;
    robot_ = &problem_.robot(tour.robot());
    query_ = query;
    best_ = &best;
    stops_ = problem_.stops_of(problem_.job(query.job));
    const std::size_t n_stops = stops_.size();
    loads_.assign(1, 0);
    for (const TourStop& stop : stops_) {
        loads_.push_back(loads_.back() + stop.load);
    }
    moving_.resize(std::max(moving_.size(), n_stops + 1));
    inserted_.resize(moving_.size());
    next_.resize(moving_.size());
    for (auto& labels : moving_) {
        labels.clear();
    }
    chain_.clear();
    candidates_.clear();
    const auto threshold = static_cast<std::uint64_t>(query.skips * 0x1p32);
    for (std::size_t gap = first_gap; gap <= tour.size(); ++gap) {
        for (auto& labels : inserted_) {
            labels.clear();
        }
        if (threshold == 0 || (random.next() >> 32) >= threshold) {
            insert({tour.leave(gap), tour.service_before(gap), tour.place_before(gap), -1}, 0, gap);
        }
        for (std::size_t k = 1; k < n_stops; ++k) {
            for (const Label& label : moving_[k]) {
                insert(label, k, gap);
            }
            for (const Label& label : inserted_[k]) {
                insert(label, k, gap);
            }
        }
        if (gap == tour.size()) {
            break;
        }
        for (std::size_t k = 1; k < n_stops; ++k) {
            next_[k].clear();
            for (const auto* labels : {&moving_[k], &inserted_[k]}) {
                for (const Label& label : *labels) {
                    go_on(label, k, gap);
                }
            }
            std::swap(moving_[k], next_[k]);
        }
    }
    if (robot_->battery >= 0) {
        choose_charged(releases);
    }
}

}  // namespace rightofway

#include "execution/runs.hpp"

namespace rightofway {
namespace {

constexpr std::size_t visits_between_asking = 1 << 20;

}  // namespace

ExecutionRuns::ExecutionRuns(const ActionDependencyGraph& plan, const Delays& delays)
    : plan_(plan), delays_(delays), timetable_(plan), conflicts_(plan), conflicts_by_clock_(plan) {}

RunBatch ExecutionRuns::run(std::uint64_t seed, std::uint64_t first, std::size_t count,
                            LatenessSources& sources, const StopCondition& is_over) {
    RunBatch out;
    std::size_t n_visits = 0;
    for (std::size_t k = 0; k < count; ++k) {
        n_visits += static_cast<std::size_t>(plan_.n_visits());
        if (n_visits > visits_between_asking) {
            n_visits = 0;
            if (is_over()) {
                break;
            }
        }
        delays_.draw(seed, first + k, setbacks_);
        timetable_.by_right_of_way(setbacks_, times_);
        by_clock(plan_, setbacks_, times_by_clock_);
        sources.add(times_);
        out.by_right_of_way.push_back(conflicts_.count(times_));
        out.by_clock.push_back(conflicts_by_clock_.count(times_by_clock_));
        out.completion.insert(out.completion.end(), times_.completion.begin(),
                              times_.completion.end());
        out.is_broken.insert(out.is_broken.end(), times_.is_broken.begin(), times_.is_broken.end());
    }
    return out;
}

}  // namespace rightofway

#include "execution/runs.hpp"

#include <algorithm>

namespace rightofway {
namespace {

constexpr std::size_t visits_between_asking = 1 << 16;

// At most `never`, however many runs are late.
void add_up(Tick& sum, Tick ticks) { sum = ticks >= never - sum ? never : sum + ticks; }

}  // namespace

LatenessSources::LatenessSources(const ActionDependencyGraph& plan)
    : plan_(plan),
      own_(static_cast<std::size_t>(plan.n_visits()), 0),
      of_others_(static_cast<std::size_t>(plan.n_visits()), 0) {}

void LatenessSources::add(const ActualTimes& times) {
    const auto late = [&](VisitId x) {
        return std::max<Tick>(times.enter[index(x)] - plan_.planned(x), 0);
    };
    for (RobotId r = 0; r < plan_.n_robots(); ++r) {
        if (times.completion[index(r)] >= never) {
            continue;
        }
        VisitId x = completing_stay(r, times);
        VisitId source = x;
        Tick left = times.completion[index(r)] - plan_.planned_completion(r);
        while (left > 0) {
            const Tick before = std::min(late(x), left);
            charge(r, source, left - before);
            left = before;
            source = times.source[index(x)];
            x = times.cause[index(x)];
        }
    }
}

// The visit whose stay the completion of a robot is due to.
VisitId LatenessSources::completing_stay(RobotId robot, const ActualTimes& times) const {
    const VisitId last = plan_.last_of(robot);
    const WorkId work = plan_.works().end_of(last) - 1;
    const bool is_due =
        work >= plan_.works().first_of(last) || plan_.completing_work(robot) != none;
    return is_due ? times.stay[index(work)] : last;
}

void LatenessSources::charge(RobotId robot, VisitId source, Tick ticks) {
    const RobotId other = plan_.robot(source);
    if (ticks == 0) {
        return;
    }
    if (other == robot) {
        add_up(own_[index(source)], ticks);
        return;
    }
    add_up(of_others_[index(source)], ticks);
    add_up(between_[static_cast<std::int64_t>(robot) * plan_.n_robots() + other], ticks);
}

ExecutionRuns::ExecutionRuns(const ActionDependencyGraph& plan, const Delays& delays)
    : plan_(plan), delays_(delays), timetable_(plan), conflicts_(plan), conflicts_by_clock_(plan) {}

RunBatch ExecutionRuns::run(std::uint64_t seed, std::uint64_t first, std::size_t count,
                            LatenessSources& sources, const StopCondition& is_over) {
    RunBatch out;
    std::size_t n_visits = 0;
    for (std::size_t k = 0; k < count; ++k) {
        n_visits += static_cast<std::size_t>(plan_.n_visits()) + 1;
        if (k > 0 && n_visits > visits_between_asking) {
            n_visits = 0;
            if (is_over()) {
                break;
            }
        }
        delays_.draw(seed, first + k, sample_);
        timetable_.by_right_of_way(sample_, times_);
        by_clock(plan_, sample_, times_by_clock_);
        sources.add(times_);
        out.by_right_of_way.push_back(conflicts_.count(times_));
        out.by_clock.push_back(conflicts_by_clock_.count(times_by_clock_));
        out.completion.insert(out.completion.end(), times_.completion.begin(),
                              times_.completion.end());
        out.is_caught.insert(out.is_caught.end(), times_.is_caught.begin(), times_.is_caught.end());
        out.is_broken.insert(out.is_broken.end(), times_.is_broken.begin(), times_.is_broken.end());
    }
    return out;
}

}  // namespace rightofway

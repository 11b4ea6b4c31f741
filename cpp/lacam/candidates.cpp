#include "lacam/candidates.hpp"

#include <algorithm>

namespace rightofway {

Candidates::Candidates(const Problem& problem, StepTables& tables, const SpaceUtilization& paths,
                       const ChosenMoves& moves, std::uint64_t seed)
    : problem_(problem),
      tables_(tables),
      paths_(paths),
      moves_(moves),
      outlook_(static_cast<std::size_t>(problem.n_robots())),
      ties_(seed) {
    for (std::size_t stage = 0; stage < problem.n_stages(); ++stage) {
        const VertexId target = problem.stage_vertex(static_cast<std::int32_t>(stage));
        stage_table_.push_back(tables.table_of(target));
    }
    for (RobotId r = 0; r < problem.n_robots(); ++r) {
        pace_.push_back(problem.quickest_edge(r));
    }
    for (VertexId v = 0; v < problem.graph().n_vertices(); ++v) {
        most_heads_ = std::max(most_heads_, problem.graph().heads(v).size());
    }
    steps_beside_.resize(static_cast<std::size_t>(problem.n_robots()) * most_heads_);
}

// Cached for waiting robots.
const Candidates::Outlook& Candidates::outlook(const FleetState& now, RobotId robot) {
    Outlook& outlook = outlook_[index(robot)];
    const VertexId here = now.at(robot);
    const std::int32_t stage = now.stage(robot);
    if (outlook.here == here && outlook.stage == stage) {
        return outlook;
    }
    outlook.here = here;
    outlook.stage = stage;
    outlook.steps = way(now, robot, here);
    outlook.preferred = paths_.next(stage, here);
    std::int32_t* beside = steps_beside_.data() + index(robot) * most_heads_;
    for (const VertexId head : problem_.graph().heads(here)) {
        *beside++ = !problem_.may_drive(robot, here, head) ? StepTables::unreachable
                    : head == outlook.preferred            ? outlook.steps - 1
                                                           : way(now, robot, head);
    }
    return outlook;
}

void Candidates::push(const FleetState& now, RobotId robot, std::vector<Candidate>& candidates) {
    const auto begin = static_cast<std::ptrdiff_t>(candidates.size());
    const VertexId here = outlook(now, robot).here;
    const std::size_t n_heads = problem_.graph().heads(here).size();
    for (std::size_t k = 0; k <= n_heads; ++k) {
        candidates.push_back(candidate(now, robot, k));
    }
    skip(here);
    std::sort(candidates.begin() + begin, candidates.end(), ranks_before);
}

Candidate Candidates::best(const FleetState& now, RobotId robot) const {
    const Outlook& ahead = outlook_[index(robot)];
    const std::size_t n_heads = problem_.graph().heads(ahead.here).size();
    const std::int32_t* steps = steps_beside(robot);
    Candidate best = candidate(now, robot, n_heads);
    for (std::size_t k = 0; k < n_heads; ++k) {
        if (steps[k] <= ahead.steps) {  // the others rank after staying
            best = std::min(best, candidate(now, robot, k), ranks_before);
        }
    }
    return best;
}

void Candidates::skip(VertexId vertex) { ties_.skip(problem_.graph().heads(vertex).size() + 1); }

// The candidate over the k-th edge of the robot's vertex, or the vertex itself.
Candidate Candidates::candidate(const FleetState& now, RobotId robot, std::size_t k) const {
    const Outlook& ahead = outlook_[index(robot)];
    const EdgeId edge = problem_.graph().indptr[index(ahead.here)] + static_cast<EdgeId>(k);
    const bool stays = edge == problem_.graph().indptr[index(ahead.here + 1)];
    const VertexId vertex = stays ? ahead.here : problem_.graph().indices[index(edge)];
    const Tick there = stays ? now.now() + pace_[index(robot)]
                             : soonest(now, robot, vertex, problem_.drive(robot, edge));
    const Tick way_on = (stays ? ahead.steps : steps_beside(robot)[k]) * pace_[index(robot)];
    const bool is_first = !stays && vertex == ahead.preferred;
    return {2 * (there - now.now() + way_on) - (is_first ? 1 : 0),
            static_cast<std::uint32_t>(ties_.after(k) >> 32), vertex};
}

bool Candidates::ranks_before(const Candidate& left, const Candidate& right) {
    return left.cost != right.cost ? left.cost < right.cost
           : left.tie != right.tie ? left.tie < right.tie
                                   : left.vertex < right.vertex;
}

// The earliest arrival at a place if a free robot there leaves at once.
Tick Candidates::soonest(const FleetState& now, RobotId robot, VertexId place, Tick drive) const {
    Tick left = -problem_.rules().headway;
    moves_.any_near(now, robot, place, [&](std::int32_t resource, std::int32_t size, bool) {
        const RobotId other = now.here(resource);
        const bool is_held = other != nobody && other != robot && problem_.first_row(other) == size;
        left = std::max(left, !is_held             ? now.left(resource)
                              : now.is_busy(other) ? now.ready(other)
                                                   : 0);
        return false;
    });
    return std::max(now.now() + drive, left + problem_.gap(drive));
}

}  // namespace rightofway

#include "distances/turning_table.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <stdexcept>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "core/reverse_graph.hpp"

namespace rightofway {
namespace {

constexpr Tick largest_entry = std::numeric_limits<std::int32_t>::max();

}  // namespace

TurningTable::TurningTable(const Problem& problem, RobotId robot)
    : n_places_(problem.graph().indices.size() + 1) {
    using Key = std::pair<Tick, EdgeId>;  // total order: ties by edge
    const Graph& graph = problem.graph();
    const Itinerary itinerary = problem.itinerary(robot);
    const ReverseGraph reverse(graph);
    const std::vector<VertexId> tails = list_tails(graph);
    const std::size_t n_stages = itinerary.n_stages();
    const std::size_t first_last = itinerary.first_stage_at_end();
    least_.assign(n_stages * n_places_, -1);
    Tick work_at_end = 0;  // of this stage and the stages after it
    for (std::size_t stage = n_stages; stage-- > 0;) {
        std::int32_t* least = least_.data() + stage * n_places_ + 1;  // by edge; [-1]: home
        const VertexId target = itinerary.stage_vertex[stage];
        if (target == none) {
            std::fill_n(least - 1, n_places_, 0);
            continue;
        }
        const bool is_at_end = stage >= first_last;
        work_at_end += is_at_end ? itinerary.stage_work[stage] : 0;
        const Tick dwell = itinerary.stage_work[stage] + itinerary.turn_after(stage);
        const auto served = [&](EdgeId edge) {  // the rest of the trip if the stage is served now
            if (is_at_end) {
                return work_at_end;
            }
            const Tick rest = from(edge, static_cast<std::int32_t>(stage) + 1);
            return rest < 0 ? never : dwell + rest;
        };
        std::vector<Tick> best(graph.indices.size(), never);
        std::priority_queue<Key, std::vector<Key>, std::greater<>> open;
        for (const EdgeId edge : reverse.edges(target)) {
            best[index(edge)] = served(edge);
            if (best[index(edge)] < never) {
                open.emplace(best[index(edge)], edge);
            }
        }
        while (!open.empty()) {
            const auto [ticks, edge] = open.top();
            open.pop();
            if (ticks > best[index(edge)]) {
                continue;
            }
            if (ticks > largest_entry) {
                throw std::overflow_error(
                    "trip of robot " + std::to_string(robot) + ": " + std::to_string(ticks) +
                    " ticks do not fit int32 (bring speeds and lengths closer together)");
            }
            least[edge] = static_cast<std::int32_t>(ticks);
            if (problem.drive(robot, edge) < 0) {
                continue;  // barred
            }
            const Tick before = ticks + problem.drive(robot, edge);
            for (const EdgeId previous : reverse.edges(tails[index(edge)])) {
                const Tick through = before + itinerary.turns.between(previous, edge);
                if (through < best[index(previous)]) {
                    best[index(previous)] = through;
                    open.emplace(through, previous);
                }
            }
        }
        Tick at_home = itinerary.home == target ? served(-1) : never;
        for (EdgeId e = graph.indptr[index(itinerary.home)];
             e < graph.indptr[index(itinerary.home + 1)] && itinerary.home != target; ++e) {
            if (least[e] >= 0 && problem.drive(robot, e) > 0) {
                at_home = std::min(at_home, Tick{itinerary.turns.between(-1, e)} +
                                                problem.drive(robot, e) + Tick{least[e]});
            }
        }
        least[-1] = at_home > largest_entry ? -1 : static_cast<std::int32_t>(at_home);
    }
}

Tick least_completion_with_turns(const Problem& problem, RobotId robot,
                                 std::span<const DistanceView> to_stage) {
    using Key = std::tuple<Tick, Tick, std::uint64_t>;  // bound, rest, state: a total order
    const Graph& graph = problem.graph();
    const Itinerary trip = problem.itinerary(robot);
    const std::size_t first_last = trip.first_stage_at_end();
    const std::uint64_t n_places = graph.indices.size() + 1;
    std::vector<Tick> later(trip.n_stages(), 0);    // from each stage's vertex, its work included
    std::vector<Tick> soonest(trip.n_stages(), 0);  // completion, by the earliest begins from it on
    for (std::size_t k = trip.n_stages(); k-- > 0;) {
        later[k] = trip.stage_work[k];
        if (k >= first_last) {
            later[k] += k + 1 < trip.n_stages() ? later[k + 1] : 0;
        } else {
            const Tick way = to_stage[k + 1].from(trip.stage_vertex[k]);
            if (way < 0) {
                return -1;
            }
            later[k] += trip.turn_after(k) + way + later[k + 1];
        }
        if (trip.times.are_known()) {
            soonest[k] = std::max(trip.times.earliest[k] + later[k],
                                  k + 1 < trip.n_stages() ? soonest[k + 1] : 0);
        }
    }
    std::unordered_map<std::uint64_t, Tick> best;
    std::priority_queue<Key, std::vector<Key>, std::greater<>> open;
    const auto reach = [&](EdgeId edge, VertexId vertex, std::size_t stage, Tick now) {
        for (; stage < first_last && trip.stage_vertex[stage] == vertex; ++stage) {
            now = std::max(now, trip.times.are_known() ? trip.times.earliest[stage] : now);
            now += trip.stage_work[stage] + trip.turn_after(stage);
        }
        const Tick way = to_stage[stage].from(vertex);
        const std::uint64_t state = stage * n_places + static_cast<std::uint64_t>(edge + 1);
        if (way < 0) {
            return;
        }
        const auto [known, is_new] = best.emplace(state, now);
        if (is_new || now < known->second) {
            known->second = now;
            const Tick bound = std::max(now + way + later[stage], soonest[stage]);
            open.emplace(bound, bound - now, state);
        }
    };
    reach(-1, trip.home, 0, trip.times.ready);
    while (!open.empty()) {
        const auto [bound, rest, state] = open.top();
        open.pop();
        const auto edge = static_cast<EdgeId>(state % n_places) - 1;
        const std::size_t stage = state / n_places;
        const VertexId vertex = edge < 0 ? trip.home : graph.indices[index(edge)];
        if (stage >= first_last && (trip.ends_anywhere() || vertex == trip.stage_vertex.back())) {
            return bound;
        }
        const Tick now = bound - rest;
        if (now > best[state]) {
            continue;
        }
        for (EdgeId e = graph.indptr[index(vertex)]; e < graph.indptr[index(vertex + 1)]; ++e) {
            const Tick drive = problem.drive(robot, e);
            if (drive > 0) {
                reach(e, graph.indices[index(e)], stage, now + trip.turns.between(edge, e) + drive);
            }
        }
    }
    return -1;
}

}  // namespace rightofway

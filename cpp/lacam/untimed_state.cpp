#include "lacam/untimed_state.hpp"

#include <cstddef>
#include <string>
#include <vector>

#include "core/reject.hpp"

namespace rightofway {
namespace {

void check_stages(const Graph& graph, const UntimedProblem& goals) {
    require_length("first_stage", goals.first_stage.size(), goals.home.size() + 1);
    if (goals.first_stage.front() != 0) {
        reject_entry("first_stage", 0, goals.first_stage.front(), "must be 0");
    }
    for (std::size_t r = 0; r < goals.home.size(); ++r) {
        if (goals.first_stage[r + 1] <= goals.first_stage[r]) {
            reject_entry("first_stage", r + 1, goals.first_stage[r + 1], "leaves a robot no stage");
        }
    }
    if (!goals.ends_anywhere.empty()) {
        require_length("ends_anywhere", goals.ends_anywhere.size(), goals.home.size());
    }
    require_length("stage_vertex", goals.stage_vertex.size(),
                   static_cast<std::size_t>(goals.first_stage.back()));
    for (std::size_t s = 0; s < goals.stage_vertex.size(); ++s) {
        require_id("stage_vertex[" + std::to_string(s) + "]", goals.stage_vertex[s],
                   graph.n_vertices());
    }
}

void check_homes(const Graph& graph, const UntimedProblem& goals) {
    std::vector<bool> is_taken(static_cast<std::size_t>(graph.n_vertices()), false);
    for (std::size_t r = 0; r < goals.home.size(); ++r) {
        require_id("home[" + std::to_string(r) + "]", goals.home[r], graph.n_vertices());
        if (is_taken[goals.home[r]]) {
            reject_entry("home", r, goals.home[r], "is the home of another robot");
        }
        is_taken[goals.home[r]] = true;
    }
}

}  // namespace

void check(const Graph& graph, const UntimedProblem& goals) {
    require_graph(graph);
    check_stages(graph, goals);
    check_homes(graph, goals);
}

}  // namespace rightofway

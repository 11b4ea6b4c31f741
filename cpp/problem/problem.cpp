#include "problem/problem.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "core/excluded_rows.hpp"
#include "core/reject.hpp"

namespace rightofway {
namespace {

// With durations of at most 2^40 ticks, their sum over a plan stays far below `never`.
constexpr Tick longest_duration = Tick{1} << 40;

constexpr Tick heaviest = 1'000'000;

void require_durations(const char* name, std::span<const Tick> ticks) {
    for (std::size_t k = 0; k < ticks.size(); ++k) {
        if (ticks[k] < 0 || ticks[k] > longest_duration) {
            reject_entry(name, k, ticks[k], "is not in 0..2^40");
        }
    }
}

}  // namespace

void require_turns(const Graph& graph, const TurnArrays& turns, std::size_t n_robots) {
    if (turns.n_kinds < 0) {
        reject("n_turn_kinds", turns.n_kinds, "is negative");
    }
    const auto n_kinds = static_cast<std::size_t>(turns.n_kinds);
    const std::size_t n_classes = n_kinds == 0 ? 0 : turns.ticks.size() / n_kinds;
    require_length("turn_ticks", turns.ticks.size(), n_classes * n_kinds);
    require_length("turn_class", turns.class_of.size(), n_robots);
    for (std::size_t r = 0; r < turns.class_of.size(); ++r) {
        if (turns.class_of[r] != -1) {
            require_id("turn_class[" + std::to_string(r) + "]", turns.class_of[r],
                       static_cast<std::int64_t>(n_classes));
        }
    }
    require_length("turn_offset", turns.offset.size(), graph.indices.size());
    require_ids("turn_kind", turns.kind, turns.n_kinds);
    for (std::size_t e = 0; e < graph.indices.size(); ++e) {
        const auto n_entries = static_cast<std::int64_t>(turns.kind.size());
        const std::int64_t first = graph.indptr[index(graph.indices[e])];
        const std::int64_t end = graph.indptr[index(graph.indices[e] + 1)];
        if (turns.offset[e] < -first || turns.offset[e] > n_entries - end) {
            reject_entry("turn_offset", e, turns.offset[e], "leads out of turn_kind");
        }
    }
    for (std::size_t k = 0; k < turns.ticks.size(); ++k) {
        if (turns.ticks[k] < 0) {
            reject_entry("turn_ticks", k, turns.ticks[k], "is negative");
        }
    }
}

Problem::Problem(const ProblemArrays& arrays, const BookingRules& rules, const Resources& resources,
                 const TurnArrays& turns, const Closures& closures)
    : arrays_(arrays),
      roads_{{arrays.indptr, arrays.heads}, arrays.length_class},
      rules_(rules),
      size_of_(resources.size_of),
      lists_{resources.lists.finder, roads_.graph.n_vertices()},
      turns_(turns),
      closures_(closures),
      n_rows_(roads_.graph.n_vertices()) {
    if (arrays_.n_classes < 0) {
        reject("n_classes", arrays_.n_classes, "is negative");
    }
    if (rules_.headway < 0 || rules_.headway > longest_duration) {
        reject("headway", rules_.headway, "is not in 0..2^40");
    }
    require_graph(graph(), "heads");
    require_length("length_class", arrays_.length_class.size(), arrays_.heads.size());
    require_ids("length_class", arrays_.length_class, arrays_.n_classes);
    for (std::size_t k = 0; k < arrays_.paces.size(); ++k) {
        if (arrays_.paces[k] <= 0 && arrays_.paces[k] != barred) {
            reject_entry("paces", k, arrays_.paces[k], "is neither positive nor -1");
        }
        is_barred_ |= arrays_.paces[k] == barred;
    }
    if (!arrays_.surcharges.empty()) {
        require_length("surcharges", arrays_.surcharges.size(),
                       static_cast<std::size_t>(arrays_.n_classes));
        require_durations("surcharges", arrays_.surcharges);
    }
    check_robots();
    check_resources();
    if (!turns_.class_of.empty()) {
        require_turns(graph(), turns_, arrays_.home.size());
    }
    check_closures();
}

void Problem::check_closures() {
    require_length("closed_from", closures_.start.size(), closures_.row.size());
    require_length("closed_until", closures_.end.size(), closures_.row.size());
    require_ids("closed_row", closures_.row, std::max(n_rows(), n_resources()));
    if (std::any_of(closures_.row.begin(), closures_.row.end(),
                    [this](std::int32_t row) { return row >= n_vertices(); })) {
        n_rows_ = std::max(n_rows_, n_resources());
    }
    for (std::size_t k = 0; k < closures_.row.size(); ++k) {
        if (closures_.start[k] < 0 || closures_.end[k] <= closures_.start[k] ||
            closures_.end[k] > never) {
            reject_entry("closed_until", k, closures_.end[k],
                         "is not after closed_from, or later than never");
        }
    }
}

void Problem::check_resources() {
    if (lists_.is_identity()) {
        size_of_ = {};
        return;
    }
    n_rows_ = lists_.n_rows();
    require_length("size_of", size_of_.size(), arrays_.home.size());
    if (lists_.finder->n_resources() != n_resources()) {
        reject("lists", lists_.finder->n_resources(),
               "vertices and edges, but the roads have " + std::to_string(n_resources()));
    }
    require_ids("size_of", size_of_, n_rows() / n_resources());
    edges_exclude_ = lists_.finder->may_exclude_edges();
    if (!rules_.books_ahead) {
        throw std::invalid_argument("books_ahead: is false, but robots with sizes book ahead");
    }
}

bool Problem::moves_in_steps() const {
    const auto is_step = [](std::int32_t ticks) { return ticks == 1 || ticks == -1; };
    if (!may_follow() || !std::all_of(arrays_.paces.begin(), arrays_.paces.end(), is_step)) {
        return false;
    }
    for (RobotId r = 0; r < n_robots(); ++r) {
        if (turns(r).take_time()) {
            return false;
        }
        for (std::int32_t s = first_stage(r); !is_last(r, s); ++s) {
            if (stage_dwell(s) > 0) {
                return false;
            }
        }
    }
    return true;
}

void Problem::check_robots() const {
    const std::size_t n_robots = arrays_.home.size();
    const auto n_classes = static_cast<std::size_t>(arrays_.n_classes);
    const std::size_t n_paces = n_classes == 0 ? n_robots : arrays_.paces.size() / n_classes;
    require_length("paces", arrays_.paces.size(), n_paces * n_classes);
    require_length("pace_of", arrays_.pace_of.size(), n_robots);
    require_ids("pace_of", arrays_.pace_of, static_cast<std::int64_t>(n_paces));
    require_ids("home", arrays_.home, n_vertices());
    std::vector<bool> is_taken(static_cast<std::size_t>(n_vertices()), false);
    for (std::size_t r = 0; r < n_robots; ++r) {
        if (is_taken[index(arrays_.home[r])]) {
            reject_entry("home", r, arrays_.home[r], "is the home of another robot");
        }
        is_taken[index(arrays_.home[r])] = true;
    }
    require_length("first_stage", arrays_.first_stage.size(), n_robots + 1);
    require_lists("first_stage", arrays_.first_stage, arrays_.stage_vertex.size(), "stages", 1);
    const std::size_t n_stages = arrays_.stage_vertex.size();
    require_ids("stage_vertex", arrays_.stage_vertex, n_vertices());
    require_length("stage_work", arrays_.stage_work.size(), n_stages);
    require_length("stage_turn", arrays_.stage_turn.size(), n_stages);
    require_durations("stage_work", arrays_.stage_work);
    require_durations("stage_turn", arrays_.stage_turn);
    if (!arrays_.weight.empty()) {
        require_length("weight", arrays_.weight.size(), n_robots);
        require_ranges("weight", arrays_.weight, 1, heaviest);
    }
}

Itinerary Problem::itinerary(RobotId robot) const {
    const auto first = index(first_stage(robot));
    const std::size_t n = index(first_stage(robot + 1)) - first;
    return {home(robot),
            arrays_.stage_vertex.subspan(first, n),
            arrays_.stage_work.subspan(first, n),
            arrays_.stage_turn.subspan(first, n),
            pace(robot),
            turns(robot),
            arrays_.surcharges};
}

Turns Problem::turns(RobotId robot) const { return Turns::of(turns_, robot); }

Turns Turns::of(const TurnArrays& turns, RobotId robot) {
    if (turns.class_of.empty() || turns.class_of[index(robot)] < 0) {
        return {};
    }
    const auto n = static_cast<std::size_t>(turns.n_kinds);
    const auto first = index(turns.class_of[index(robot)]) * n;
    return {turns.offset, turns.kind, turns.ticks.subspan(first, n)};
}

Tick Problem::quickest_edge(RobotId robot) const {
    Tick least = never;
    for (const std::int32_t ticks : pace(robot)) {
        least = ticks == barred ? least : std::min<Tick>(least, ticks);
    }
    return least == never ? 1 : least;
}

Tick Problem::slowest_edge(RobotId robot) const {
    const auto ticks = pace(robot);
    return ticks.empty() ? 1 : std::max(1, *std::max_element(ticks.begin(), ticks.end()));
}

}  // namespace rightofway

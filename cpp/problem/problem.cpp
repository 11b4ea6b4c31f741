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
                 const TurnArrays& turns, const Closures& closures, const WorkArrays& work)
    : arrays_(arrays),
      roads_{{arrays.indptr, arrays.heads}, arrays.length_class},
      rules_(rules),
      size_of_(resources.size_of),
      lists_{resources.lists.finder, roads_.graph.n_vertices()},
      turns_(turns),
      closures_(closures),
      work_(work),
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
    if (has_times()) {
        check_work();
    }
}

void Problem::check_work() {
    const auto n_robots = arrays_.home.size();
    const auto n_stages = arrays_.stage_vertex.size();
    require_length("latest", work_.latest.size(), n_stages);
    require_length("earliest", work_.earliest.size(), n_stages);
    require_durations("earliest", work_.earliest);
    require_ranges("latest", work_.latest, 0, never);
    require_length("ready", work_.ready.size(), n_robots);
    require_durations("ready", work_.ready);
    require_length("first_turn_of", work_.first_turn_of.size(), n_robots + 1);
    require_lists("first_turn_of", work_.first_turn_of, work_.first_turn.size(), "turns");
    for (std::size_t r = 0; r < n_robots; ++r) {
        const auto n_turns = work_.first_turn_of[r + 1] - work_.first_turn_of[r];
        if (n_turns != 0) {
            require_length("first_turn[" + std::to_string(r) + "]", index(n_turns),
                           graph().heads(arrays_.home[r]).size());
        }
    }
    require_ranges("first_turn", work_.first_turn, 0, std::int32_t{1} << 30);
    require_length("after", work_.after.size(), work_.before.size());
    require_ids("before", work_.before, static_cast<std::int64_t>(n_stages));
    require_ids("after", work_.after, static_cast<std::int64_t>(n_stages));
    for (std::size_t k = 0; k < work_.before.size(); ++k) {
        if (robot_of(work_.before[k]) == robot_of(work_.after[k])) {
            reject_entry("after", k, work_.after[k], "is a stage of the same robot");
        }
    }
    if (!work_.before.empty()) {
        before_.resize(n_stages);
        after_.resize(n_stages);
    }
    for (std::size_t k = 0; k < work_.before.size(); ++k) {
        before_[index(work_.after[k])].push_back(work_.before[k]);
        after_[index(work_.before[k])].push_back(work_.after[k]);
    }
    require_length("late_cost", work_.late_cost.size(), work_.cost.size());
    require_length("due", work_.due.size(), work_.cost.size());
    if (has_costs()) {
        require_length("cost", work_.cost.size(), n_stages);
        require_ranges("cost", work_.cost, 0, heaviest);
        require_ranges("late_cost", work_.late_cost, 0, heaviest);
        require_ranges("due", work_.due, 0, never);
    }
    require_range("n_places", work_.n_places, 0, n_vertices());
    count_wanting();
}

void Problem::count_wanting() {
    n_wanting_.assign(index(n_vertices()), 0);
    std::vector<RobotId> last(n_wanting_.size(), nobody);
    for (RobotId robot = 0; robot < n_robots(); ++robot) {
        for (std::int32_t stage = first_stage(robot); stage < first_stage(robot + 1); ++stage) {
            const VertexId vertex = stage_vertex(stage);
            if (vertex != none && last[index(vertex)] != robot) {
                last[index(vertex)] = robot;
                ++n_wanting_[index(vertex)];
            }
        }
    }
}

RobotId Problem::robot_of(std::int32_t stage) const {
    const auto& first = arrays_.first_stage;
    return static_cast<RobotId>(std::upper_bound(first.begin(), first.end(), stage) -
                                first.begin()) -
           1;
}

void Problem::refuse_times(const char* method) const {
    if (has_times()) {
        throw std::invalid_argument(std::string(method) + ": does not know times of stages");
    }
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
    if (has_times() || !may_follow() ||
        !std::all_of(arrays_.paces.begin(), arrays_.paces.end(), is_step)) {
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
    if (has_times()) {
        check_ends_anywhere();
    } else {
        require_ids("stage_vertex", arrays_.stage_vertex, n_vertices());
    }
    require_length("stage_work", arrays_.stage_work.size(), n_stages);
    require_length("stage_turn", arrays_.stage_turn.size(), n_stages);
    require_durations("stage_work", arrays_.stage_work);
    require_durations("stage_turn", arrays_.stage_turn);
    if (!arrays_.weight.empty()) {
        require_length("weight", arrays_.weight.size(), n_robots);
        require_ranges("weight", arrays_.weight, 1, heaviest);
    }
}

// A stage is at a vertex, but the last one of a robot may be at `none`.
void Problem::check_ends_anywhere() const {
    for (std::size_t r = 0; r < arrays_.home.size(); ++r) {
        for (auto k = index(arrays_.first_stage[r]); k < index(arrays_.first_stage[r + 1]); ++k) {
            const bool is_last = k + 1 == index(arrays_.first_stage[r + 1]);
            const bool is_anywhere = is_last && arrays_.stage_vertex[k] == none;
            if (is_anywhere && arrays_.stage_work[k] != 0) {
                reject_entry("stage_work", k, arrays_.stage_work[k], "is work at no vertex");
            }
            if (!is_anywhere) {
                require_id("stage_vertex[" + std::to_string(k) + "]", arrays_.stage_vertex[k],
                           n_vertices());
            }
        }
    }
}

Itinerary Problem::itinerary(RobotId robot) const {
    const auto first = index(first_stage(robot));
    const std::size_t n = index(first_stage(robot + 1)) - first;
    Itinerary itinerary{home(robot),
                        arrays_.stage_vertex.subspan(first, n),
                        arrays_.stage_work.subspan(first, n),
                        arrays_.stage_turn.subspan(first, n),
                        pace(robot),
                        turns(robot),
                        arrays_.surcharges};
    if (has_times()) {
        StageTimes& times = itinerary.times;
        times.earliest = work_.earliest.subspan(first, n);
        times.latest = work_.latest.subspan(first, n);
        times.ready = work_.ready[index(robot)];
        times.n_places = work_.n_places;
        times.n_wanting = n_wanting_;
        if (has_costs()) {
            times.cost = work_.cost.subspan(first, n);
            times.late_cost = work_.late_cost.subspan(first, n);
            times.due = work_.due.subspan(first, n);
            times.weight = arrays_.weight.empty() ? 1 : arrays_.weight[index(robot)];
        }
    }
    return itinerary;
}

std::size_t Itinerary::stage_after_in_time(std::size_t stage, VertexId vertex, Tick enter,
                                           Tick until, std::vector<Tick>* ends) const {
    Tick now = std::max(enter, times.ready);
    for (; stage + 1 < n_stages() && stage_vertex[stage] == vertex; ++stage) {
        now = end_of(stage, now);
        if (now >= never || now + stage_turn[stage] > until) {
            break;
        }
        if (ends != nullptr) {
            ends->push_back(now);
        }
    }
    return stage;
}

Turns Problem::turns(RobotId robot) const {
    Turns turns = Turns::of(turns_, robot);
    if (turns.take_time() && has_times()) {
        const auto first = work_.first_turn_of[index(robot)];
        const auto n_turns = work_.first_turn_of[index(robot) + 1] - first;
        turns.first = work_.first_turn.subspan(index(first), index(n_turns));
        turns.first_edge = graph().indptr[index(home(robot))];
    }
    return turns;
}

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

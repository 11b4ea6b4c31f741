#include "cbs/joint_search.hpp"

#include <algorithm>
#include <tuple>

namespace rightofway {
namespace {

std::uint64_t mixed(std::uint64_t hash, std::int64_t part) {
    hash = (hash ^ static_cast<std::uint64_t>(part)) * 0x9E3779B97F4A7C15U;
    return hash ^ (hash >> 29);
}

bool is_finite(Tick tick) { return tick < never; }

// Whether rows that are booked at one instant exclude each other.
bool exclude(const Problem& problem, std::span<const std::int32_t> left,
             std::span<const std::int32_t> right) {
    for (const std::int32_t row : left) {
        if (!problem.has_sizes()) {
            if (std::find(right.begin(), right.end(), row) != right.end()) {
                return true;
            }
            continue;
        }
        for (const std::int32_t other : problem.excluded(row)) {
            if (std::find(right.begin(), right.end(), other) != right.end()) {
                return true;
            }
        }
    }
    return false;
}

}  // namespace

SearchEnd JointSearch::run(std::span<const GroupMember> members, std::int64_t most_nodes,
                           const StopCondition& is_over, const KnownPlan* known) {
    is_over_ = &is_over;
    n_states_ = n_steps_ = 0;
    prepare(members, known);
    start();
    while (!open_.empty()) {
        const std::int32_t node = open_.pop().node;
        const Node& here = nodes_[index(node)];
        if (here.cost > nodes_[index(here.first)].best) {
            continue;
        }
        bound_ = std::max(bound_, here.least);
        bool is_goal = true;
        for (std::size_t k = 0; k < size_; ++k) {
            is_goal = is_goal && has_ended(members_[k].states[index(state_of(node, k))]);
        }
        if (is_goal) {
            goal_ = node;
            return SearchEnd::found;
        }
        if (n_states_ >= most_nodes) {
            return SearchEnd::stopped;
        }
        ++n_states_;
        expand(node);
    }
    return SearchEnd::proven_none;
}

// Asked in each step of the product of choices: one state of many robots has very many successors.
void JointSearch::stop_if_over() {
    constexpr std::int64_t steps_between_questions = 1024;
    if (n_steps_++ % steps_between_questions == 0 && (*is_over_)()) {
        throw Stopped{};
    }
}

void JointSearch::prepare(std::span<const GroupMember> members, const KnownPlan* known) {
    size_ = members.size();
    const bool books_ahead = problem_.rules().books_ahead;
    every_tick_ = known != nullptr || (problem_.has_sizes() && !books_ahead);
    begins_drives_ = books_ahead || every_tick_;
    parts_ = known == nullptr ? 1 : most_actions + 1;
    limit_ = known == nullptr || known->cost >= never / parts_
                 ? never
                 : known->cost * parts_ + known->actions;
    while (members_.size() < size_) {
        members_.emplace_back();
        rests_.emplace_back(problem_.roads(), problem_.rules());
    }
    choices_.resize(std::max(choices_.size(), size_));
    Tick last = 0;
    Tick longest = 0;
    closes_for_ever_ = false;
    const auto note = [&](Tick tick) {
        closes_for_ever_ = closes_for_ever_ || !is_finite(tick);
        last = is_finite(tick) ? std::max(last, tick) : last;
    };
    for (std::size_t k = 0; k < problem_.closures().row.size(); ++k) {
        note(problem_.closures().start[k]);
        note(problem_.closures().end[k]);
    }
    for (std::size_t k = 0; k < size_; ++k) {
        Member& member = members_[k];
        member.robot = members[k].robot;
        member.trip = members[k].trip;
        member.weight = parts_ * problem_.weight(member.robot);
        member.most = members[k].most;
        member.stays_from = member.ends_from = 0;
        member.constraints.clear();
        for (const Constraint& one : members[k].constraints) {
            note(one.start);
            note(one.end);
            if (one.row >= 0) {
                member.constraints.push_back({one.row, {one.start, one.end}});
                continue;
            }
            Tick& from = one.row == Constraint::completion ? member.ends_from : member.stays_from;
            from = std::max(from, one.end);
        }
        std::sort(member.constraints.begin(), member.constraints.end(),
                  [](const Closed& left, const Closed& right) { return left.row < right.row; });
        member.states.clear();
        member.facts.clear();
        member.known.clear();
        rests_[k].measure(*member.trip);
        longest = std::max(longest, problem_.slowest_edge(member.robot));
    }
    horizon_ = last + longest + problem_.rules().headway + 1;
    nodes_.clear();
    states_.clear();
    edges_.clear();
    known_.clear();
    open_.clear();
    chosen_.clear();
    bound_ = 0;
    goal_ = none;
}

// Each robot at home; where its home is its end, it may stay there for ever.
void JointSearch::start() {
    const Tick headway = problem_.rules().headway;
    for (std::size_t k = 0; k < size_; ++k) {
        const Member& member = members_[k];
        const VertexId home = member.trip->home;
        choices_[k].clear();
        if (!is_free(member, problem_.vertex_row(member.robot, home), 0, headway + 1)) {
            return;
        }
        choices_[k].push_back({none, number(k, {home, none, 0, false, 0, 0, {}}), 0});
        if (home == member.trip->stage_vertex.back() && may_end(member, 0, 0, 0)) {
            const Tick cost = member.weight * work_at_end(member, 0);
            choices_[k].push_back({none, number(k, {home, none, 0, true, 0, 0, {}}), cost});
        }
    }
    first_ = 0;
    for (std::size_t k = 0; k < size_; ++k) {
        Tick least = never;
        for (const Choice& choice : choices_[k]) {
            const bool ends = members_[k].states[index(choice.state)].ends;
            const Tick rest = members_[k].facts[index(choice.state)].rest;
            least = std::min(
                least, ends ? choice.cost : members_[k].weight * std::min(rest, conflict_cap));
        }
        first_ += least;
    }
    node_ = none;
    std::vector<std::size_t> taken(size_, 0);
    for (bool is_more = true; is_more;) {
        stop_if_over();
        chosen_.clear();
        Tick cost = 0;
        bool is_valid = true;
        for (std::size_t k = 0; k < size_; ++k) {
            const Choice& choice = choices_[k][taken[k]];
            is_valid = is_valid && is_allowed(k, choice);
            chosen_.push_back(choice);
            cost += choice.cost;
        }
        if (is_valid) {
            after_.clear();
            for (const Choice& choice : chosen_) {
                after_.push_back(choice.state);
            }
            reach(0, cost);
        }
        is_more = false;
        for (std::size_t k = 0; k < size_ && !is_more; ++k) {
            is_more = ++taken[k] < choices_[k].size();
            taken[k] = is_more ? taken[k] : 0;
        }
    }
}

void JointSearch::expand(std::int32_t node) {
    node_ = node;
    for (std::size_t k = 0; k < size_; ++k) {
        list_choices(k, state_of(node, k), nodes_[index(node)].now);
    }
    chosen_.clear();
    choose(0);
}

void JointSearch::list_choices(std::size_t k, std::int32_t number, Tick now) {
    choices_[k].clear();
    choices_[k].push_back({none, number, 0});
    const State state = members_[k].states[index(number)];
    if (state.left > 0 || state.ends) {
        return;
    }
    const Graph& roads = problem_.graph();
    for (EdgeId edge = roads.indptr[index(state.vertex)];
         edge < roads.indptr[index(state.vertex + 1)]; ++edge) {
        drive(k, state, edge, now);
    }
    if (limit_ < never) {
        const Member& member = members_[k];
        const Tick spare =
            limit_ - nodes_[index(node_)].least + member.weight * member.facts[index(number)].rest;
        std::erase_if(choices_[k], [&](const Choice& one) {
            const bool ends = member.states[index(one.state)].ends;
            const Tick rest = ends ? 0 : member.facts[index(one.state)].rest;
            return one.edge >= 0 && one.cost + member.weight * rest >= spare;
        });
    }
}

// Adds the drive along an edge that begins now, or that ends now.
void JointSearch::drive(std::size_t k, const State& state, EdgeId edge, Tick now) {
    const Member& member = members_[k];
    const Tick headway = problem_.rules().headway;
    std::int32_t stage = none;
    Tick ticks = 0;
    bool waits = false;
    for_each_way(k, state, [&](EdgeId way, Tick drive, Tick need, std::int32_t served) {
        if (way == edge && need <= state.age) {
            stage = served;
            ticks = drive;
            waits = need < state.age;
        }
    });
    const VertexId head = problem_.graph().indices[index(edge)];
    if (stage == none || rests_[k].rest(head, edge, stage) < 0) {
        return;
    }
    const Tick enter = begins_drives_ ? now + ticks : now;
    const Tick booked = enter - problem_.approach(static_cast<std::int32_t>(ticks));
    const std::int32_t here = problem_.vertex_row(member.robot, state.vertex);
    const std::int32_t there = problem_.vertex_row(member.robot, head);
    if (closes(now) && (!is_free(member, here, now, enter + headway) ||
                        !is_free(member, there, booked, enter + headway + 1) ||
                        (closes_edges() && !is_free(member, edge_row(member, edge), enter - ticks,
                                                    enter + headway)))) {
        return;
    }
    State driven{state.vertex, edge, stage, false, 0, ticks, state.trails};
    if (!begins_drives_) {
        driven.vertex = head;
        driven.edge = member.trip->turns.take_time() ? edge : none;
        driven.left = 0;
        if (headway > 0) {
            driven.trails.push_back({here, headway});
        }
    }
    const Tick price =
        member.weight * problem_.surcharge(edge) + (parts_ > 1 ? (waits ? 2 : 1) : 0);
    if (head == member.trip->stage_vertex.back() && may_end(member, stage, enter, booked)) {
        State last = driven;
        last.ends = true;
        last.edge = begins_drives_ ? edge : none;
        const Tick cost = enter + work_at_end(member, stage) - now;
        choices_[k].push_back(
            {edge, this->number(k, std::move(last)), price + member.weight * cost});
    }
    choices_[k].push_back({edge, this->number(k, std::move(driven)), price});
}

void JointSearch::choose(std::size_t k) {
    stop_if_over();
    if (k == size_) {
        step();
        return;
    }
    for (const Choice& choice : choices_[k]) {
        if (is_allowed(k, choice)) {
            chosen_.push_back(choice);
            choose(k + 1);
            chosen_.pop_back();
        }
    }
}

// Whether a robot can do this besides what the robots before it do.
bool JointSearch::is_allowed(std::size_t k, const Choice& choice) const {
    const Graph& roads = problem_.graph();
    const auto& rows = members_[k].facts[index(choice.state)].rows;
    for (std::size_t other = 0; other < k; ++other) {
        const Choice& chosen = chosen_[other];
        if (exclude(problem_, members_[other].facts[index(chosen.state)].rows, rows)) {
            return false;
        }
        if (!begins_drives_ && problem_.may_follow() && choice.edge >= 0 && chosen.edge >= 0) {
            const VertexId here = members_[k].states[index(state_of(node_, k))].vertex;
            const VertexId there = members_[other].states[index(state_of(node_, other))].vertex;
            if (roads.indices[index(choice.edge)] == there &&
                roads.indices[index(chosen.edge)] == here) {
                return false;  // a swap
            }
        }
    }
    return true;
}

// Whether robots enter in a circle what the next one leaves at this instant: two of them always
// swap, more of them may be allowed to rotate.
bool JointSearch::is_circle_forbidden() const {
    const Graph& roads = problem_.graph();
    for (std::size_t first = 0; first < size_; ++first) {
        std::size_t at = first;
        for (std::size_t n = 1; n <= size_ && at < size_ && entered_[at] >= 0; ++n) {
            const VertexId head = roads.indices[index(entered_[at])];
            std::size_t next = 0;
            while (next < size_ &&
                   (entered_[next] < 0 ||
                    members_[next].states[index(state_of(node_, next))].vertex != head)) {
                ++next;
            }
            if (next == first && (n == 2 || !problem_.rules().rotations)) {
                return true;
            }
            at = next == first ? size_ : next;
        }
    }
    return false;
}

// Whether robots that drive without booking ahead may arrive, as the others go on.
bool JointSearch::is_arrival_free() const {
    for (std::size_t k = 0; k < size_; ++k) {
        for (std::size_t other = 0; other < k && entered_[k] >= 0; ++other) {
            if (exclude(problem_, members_[other].facts[index(after_[other])].rows,
                        members_[k].facts[index(after_[k])].rows)) {
                return false;
            }
        }
    }
    return true;
}

// All robots have chosen: goes to the next instant at which something ends.
void JointSearch::step() {
    const Tick now = nodes_[index(node_)].now;
    Tick cost = nodes_[index(node_)].cost;
    Tick next = never;
    bool all_end = true;
    for (std::size_t k = 0; k < size_; ++k) {
        next = std::min(next, next_step(k, chosen_[k].state, now));
        all_end = all_end && has_ended(members_[k].states[index(chosen_[k].state)]);
        cost += chosen_[k].cost;
    }
    if (all_end) {
        next = now;
    }
    if (!is_finite(next)) {
        return;  // nobody goes on, whatever happens
    }
    after_.clear();
    entered_.clear();
    for (std::size_t k = 0; k < size_; ++k) {
        const Member& member = members_[k];
        const State& state = member.states[index(chosen_[k].state)];
        const bool arrives = state.left > 0 && state.left == next - now;
        entered_.push_back(!begins_drives_ ? chosen_[k].edge : arrives ? state.edge : none);
        if (!state.ends) {
            const std::int32_t row = problem_.vertex_row(member.robot, state.vertex);
            if (now < horizon_ && state.left == 0 &&
                !is_free(member, row, now, next + problem_.rules().headway)) {
                return;
            }
            cost += member.weight * (next - now);
        }
        after_.push_back(all_end ? chosen_[k].state : after(k, chosen_[k].state, next - now));
    }
    if (problem_.may_follow() && is_circle_forbidden()) {
        return;
    }
    if (begins_drives_ && !problem_.rules().books_ahead && !is_arrival_free()) {
        return;
    }
    reach(next, cost);
}

// Adds a node for the states `after_`, unless they are known at no greater cost.
void JointSearch::reach(Tick now, Tick cost) {
    Tick least = cost;
    Tick rest = 0;
    std::uint64_t hash = mixed(0, std::min(now, horizon_));
    for (std::size_t k = 0; k < size_; ++k) {
        const Member& member = members_[k];
        hash = mixed(hash, after_[k]);
        if (member.states[index(after_[k])].ends) {
            continue;
        }
        const Tick to_go = member.facts[index(after_[k])].rest;
        if (!is_finite(to_go) || now + to_go > member.most) {
            return;
        }
        rest += member.weight * to_go;
    }
    least += rest;
    if (least >= limit_) {
        return;
    }
    const auto fresh = static_cast<std::int32_t>(nodes_.size());
    const std::int32_t first = known_.find_or_add(hash, fresh, [&](std::int32_t other) {
        return std::min(nodes_[index(other)].now, horizon_) == std::min(now, horizon_) &&
               std::equal(after_.begin(), after_.end(),
                          states_.begin() + static_cast<std::ptrdiff_t>(index(other) * size_));
    });
    if (first != fresh) {
        if (cost >= nodes_[index(first)].best) {
            return;
        }
        nodes_[index(first)].best = cost;
    }
    nodes_.push_back({now, cost, least, node_, first, cost});
    states_.insert(states_.end(), after_.begin(), after_.end());
    for (const Choice& choice : chosen_) {
        edges_.push_back(choice.edge);
    }
    open_.push(OpenList::key(least - first_, rest), fresh);
}

// Whether the last visit can begin to book at a tick.
bool JointSearch::may_end(const Member& member, std::int32_t stage, Tick enter, Tick booked) const {
    const Trip& trip = *member.trip;
    if (index(stage) < trip.first_stage_at_end() || booked < member.stays_from) {
        return false;
    }
    const Tick end = enter + work_at_end(member, stage);
    const std::int32_t row = problem_.vertex_row(member.robot, trip.stage_vertex.back());
    return end >= member.ends_from && end <= member.most && is_free(member, row, booked, never);
}

Tick JointSearch::work_at_end(const Member& member, std::int32_t stage) const {
    Tick work = 0;
    for (auto k = index(stage); k < member.trip->n_stages(); ++k) {
        work += member.trip->stage_work[k];
    }
    return work;
}

// The first instant after this one at which a robot can begin what it could not begin before, or
// at which something that it books ends.
Tick JointSearch::next_step(std::size_t k, std::int32_t number, Tick now) const {
    const Member& member = members_[k];
    const State& state = member.states[index(number)];
    Tick next = never;
    for (const Trail& trail : state.trails) {
        next = std::min(next, now + trail.left);
    }
    if (state.left > 0) {
        return std::min(next, now + state.left);
    }
    if (state.ends) {
        return next;
    }
    for_each_way(k, state, [&](EdgeId edge, Tick drive, Tick need, std::int32_t served) {
        const Tick soonest = now + need - state.age;
        const auto note = [&](Tick tick) {
            if (tick > now && tick >= soonest) {
                next = std::min(next, tick);
            }
        };
        note(every_tick_ ? std::max(soonest, now + 1) : soonest);
        if (now >= horizon_ || every_tick_) {
            return;
        }
        const VertexId head = problem_.graph().indices[index(edge)];
        for_each_closed(member, problem_.vertex_row(member.robot, head),
                        [&](const Booking& closed) { note(closed.end); });
        if (closes_edges()) {
            for_each_closed(member, edge_row(member, edge), [&](const Booking& closed) {
                note(closed.end + (begins_drives_ ? 0 : drive));
            });
        }
        if (head == member.trip->stage_vertex.back() &&
            index(served) >= member.trip->first_stage_at_end()) {
            note(member.stays_from);
            note(member.ends_from - work_at_end(member, served) - (begins_drives_ ? drive : 0));
        }
    });
    return next;
}

// The state after some ticks in which the robot only goes on.
std::int32_t JointSearch::after(std::size_t k, std::int32_t number, Tick ticks) {
    const Member& member = members_[k];
    State state = member.states[index(number)];
    for (Trail& trail : state.trails) {
        trail.left -= ticks;
    }
    std::erase_if(state.trails, [](const Trail& trail) { return trail.left <= 0; });
    if (state.left > 0) {
        state.left -= ticks;
        if (state.left == 0) {
            if (const Tick headway = problem_.rules().headway; headway > 0) {
                state.trails.push_back({problem_.vertex_row(member.robot, state.vertex), headway});
                if (drives_book_edges()) {
                    state.trails.push_back({edge_row(member, state.edge), headway});
                }
            }
            state.vertex = problem_.graph().indices[index(state.edge)];
            state.edge = member.trip->turns.take_time() && !state.ends ? state.edge : none;
        }
    } else if (!state.ends) {
        // A wait is what is longer than the longest stay that may be needed.
        const Tick longest = member.facts[index(number)].longest + (parts_ > 1 ? 1 : 0);
        state.age = std::min(state.age + ticks, longest);
    }
    return this->number(k, std::move(state));
}

std::int32_t JointSearch::number(std::size_t k, State&& state) {
    Member& member = members_[k];
    std::uint64_t hash = 0;
    for (const std::int64_t part :
         {std::int64_t{state.vertex}, std::int64_t{state.edge}, std::int64_t{state.stage},
          std::int64_t{state.ends}, state.age, state.left}) {
        hash = mixed(hash, part);
    }
    for (const Trail& trail : state.trails) {
        hash = mixed(mixed(hash, trail.row), trail.left);
    }
    const auto fresh = static_cast<std::int32_t>(member.states.size());
    const std::int32_t known = member.known.find_or_add(
        hash, fresh, [&](std::int32_t other) { return member.states[index(other)] == state; });
    if (known == fresh) {
        member.facts.push_back(look(k, state));
        member.states.push_back(std::move(state));
    }
    return known;
}

JointSearch::Facts JointSearch::look(std::size_t k, const State& state) const {
    const Member& member = members_[k];
    Facts facts;
    for (const Trail& trail : state.trails) {
        facts.rows.push_back(trail.row);
    }
    facts.rows.push_back(problem_.vertex_row(member.robot, state.vertex));
    if (state.left > 0) {
        const VertexId head = problem_.graph().indices[index(state.edge)];
        if (problem_.rules().books_ahead) {
            facts.rows.push_back(problem_.vertex_row(member.robot, head));
        }
        if (drives_book_edges()) {
            facts.rows.push_back(edge_row(member, state.edge));
        }
        const Tick rest = rests_[k].rest(head, state.edge, state.stage);
        facts.rest = rest < 0 ? never : state.left + rest;
    } else if (!state.ends) {
        facts.rest = never;
        for_each_way(k, state, [&](EdgeId edge, Tick drive, Tick need, std::int32_t served) {
            facts.longest = std::max(facts.longest, need);
            const VertexId head = problem_.graph().indices[index(edge)];
            const Tick rest = rests_[k].rest(head, edge, served);
            if (rest >= 0) {
                const Tick whole = begins_drives_ ? drive + rest : rest;
                facts.rest = std::min(facts.rest, std::max<Tick>(need - state.age, 0) + whole);
            }
        });
    }
    return facts;
}

// Calls `use` with each edge out of the vertex where a robot stays, for each number of stages that
// it serves before: the ticks of the drive, how long it has stayed when it begins to drive (or,
// where robots do not book ahead, when it has driven), and the first stage that is not served.
template <class Use>
void JointSearch::for_each_way(std::size_t k, const State& state, const Use& use) const {
    const Member& member = members_[k];
    const Trip& trip = *member.trip;
    const Graph& roads = problem_.graph();
    for (EdgeId edge = roads.indptr[index(state.vertex)];
         edge < roads.indptr[index(state.vertex + 1)]; ++edge) {
        const Tick drive = problem_.drive(member.robot, edge);
        if (drive < 0) {
            continue;
        }
        Tick need = trip.turns.between(state.edge, edge) + (begins_drives_ ? 0 : drive);
        auto stage = index(state.stage);
        use(edge, drive, need, static_cast<std::int32_t>(stage));
        while (stage + 1 < trip.n_stages() && trip.stage_vertex[stage] == state.vertex) {
            need += trip.stage_work[stage] + trip.stage_turn[stage];
            ++stage;
            use(edge, drive, need, static_cast<std::int32_t>(stage));
        }
    }
}

template <class Use>
void JointSearch::for_each_closed(const Member& member, std::int32_t row, const Use& use) const {
    const auto is_before = [](const Closed& one, std::int32_t wanted) { return one.row < wanted; };
    for (auto one =
             std::lower_bound(member.constraints.begin(), member.constraints.end(), row, is_before);
         one != member.constraints.end() && one->row == row; ++one) {
        use(one->time);
    }
    for (const BookedBy& one : closures_.at(row)) {
        use(one.time);
    }
}

bool JointSearch::is_free(const Member& member, std::int32_t row, Tick start, Tick end) const {
    bool is_free = true;
    for_each_closed(member, row, [&](const Booking& closed) {
        is_free = is_free && (closed.start >= end || closed.end <= start);
    });
    return is_free;
}

void JointSearch::track(std::size_t member, std::vector<Visit>& visits) const {
    const Trip& trip = *members_[member].trip;
    std::vector<std::pair<EdgeId, Tick>> drives;
    for (std::int32_t node = goal_; nodes_[index(node)].parent != none;
         node = nodes_[index(node)].parent) {
        const EdgeId edge = edges_[index(node) * size_ + member];
        if (edge >= 0) {
            drives.emplace_back(edge, nodes_[index(nodes_[index(node)].parent)].now);
        }
    }
    std::reverse(drives.begin(), drives.end());
    visits.clear();
    visits.push_back({0, trip.home, 0});
    EdgeId before = none;
    for (const auto& [edge, step] : drives) {
        const std::int32_t drive = problem_.drive(members_[member].robot, edge);
        visits.push_back({begins_drives_ ? step + drive : step,
                          problem_.graph().indices[index(edge)], drive,
                          trip.turns.between(before, edge)});
        before = edge;
    }
}

}  // namespace rightofway

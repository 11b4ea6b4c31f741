#include "cbs/robot_states.hpp"

#include <utility>

namespace rightofway {

void RobotStates::prepare(const GroupMember& member) {
    robot_ = member.robot;
    trip_ = member.trip;
    weight_ = rules_.parts * problem_.weight(robot_);
    most_ = member.most;
    stays_from_ = ends_from_ = 0;
    constraints_.clear();
    for (const Constraint& one : member.constraints) {
        if (one.row >= 0) {
            constraints_.push_back({one.row, {one.start, one.end}});
            continue;
        }
        if (one.is_hold()) {
            continue;  // a bound without it holds as well
        }
        Tick& from = one.row == Constraint::completion ? ends_from_ : stays_from_;
        from = std::max(from, one.end);
    }
    std::sort(constraints_.begin(), constraints_.end(),
              [](const Closed& left, const Closed& right) { return left.row < right.row; });
    states_.clear();
    facts_.clear();
    known_.clear();
    rests_.measure(*trip_);
}

// Where its home is its end, it may stay there for ever.
void RobotStates::list_begins(std::vector<Choice>& choices) {
    choices.clear();
    const VertexId home = trip_->home;
    if (!is_free(problem_.vertex_row(robot_, home), 0, problem_.rules().headway + 1)) {
        return;
    }
    choices.push_back({none, number({home, none, 0, false, 0, 0, {}}), 0});
    if (home == trip_->stage_vertex.back() && may_end(0, 0, 0)) {
        const Tick cost = weight_ * work_at_end(0);
        choices.push_back({none, number({home, none, 0, true, 0, 0, {}}), cost});
    }
}

void RobotStates::list_choices(std::int32_t number, Tick now, Tick spare,
                               std::vector<Choice>& choices) {
    choices.clear();
    choices.push_back({none, number, 0});
    const State state = this->state(number);  // a copy: states are added
    if (state.left > 0 || state.ends) {
        return;
    }
    const Graph& roads = problem_.graph();
    for (EdgeId edge = roads.indptr[index(state.vertex)];
         edge < roads.indptr[index(state.vertex + 1)]; ++edge) {
        drive(state, edge, now, choices);
    }
    if (spare < never) {
        const Tick most = spare + weight_ * facts(number).rest;
        std::erase_if(choices, [&](const Choice& one) {
            const Tick rest = this->state(one.state).ends ? 0 : facts(one.state).rest;
            return one.edge >= 0 && one.cost + weight_ * rest >= most;
        });
    }
}

// Adds the drive along an edge that begins now, or that ends now.
void RobotStates::drive(const State& state, EdgeId edge, Tick now, std::vector<Choice>& choices) {
    const Tick headway = problem_.rules().headway;
    std::int32_t stage = none;
    Tick ticks = 0;
    bool waits = false;
    for_each_way(state, [&](EdgeId way, Tick drive, Tick need, std::int32_t served) {
        if (way == edge && need <= state.age) {
            stage = served;
            ticks = drive;
            waits = need < state.age;
        }
    });
    const VertexId head = problem_.graph().indices[index(edge)];
    if (stage == none || rests_.rest(head, edge, stage) < 0) {
        return;
    }
    const Tick enter = rules_.begins_drives ? now + ticks : now;
    const Tick booked = enter - problem_.approach(static_cast<std::int32_t>(ticks));
    const std::int32_t here = problem_.vertex_row(robot_, state.vertex);
    const std::int32_t there = problem_.vertex_row(robot_, head);
    if (rules_.closes(now) &&
        (!is_free(here, now, enter + headway) || !is_free(there, booked, enter + headway + 1) ||
         (closes_edges() && !is_free(edge_row(edge), enter - ticks, enter + headway)))) {
        return;
    }
    State driven{state.vertex, edge, stage, false, 0, ticks, state.trails};
    if (!rules_.begins_drives) {
        driven.vertex = head;
        driven.edge = trip_->turns.take_time() ? edge : none;
        driven.left = 0;
        if (headway > 0) {
            driven.trails.push_back({here, headway});
        }
    }
    const Tick price =
        weight_ * problem_.surcharge(edge) + (rules_.counts_actions() ? (waits ? 2 : 1) : 0);
    if (head == trip_->stage_vertex.back() && may_end(stage, enter, booked)) {
        State last = driven;
        last.ends = true;
        last.edge = rules_.begins_drives ? edge : none;
        const Tick cost = enter + work_at_end(stage) - now;
        choices.push_back({edge, this->number(std::move(last)), price + weight_ * cost});
    }
    choices.push_back({edge, this->number(std::move(driven)), price});
}

// Whether the last visit can begin to book at a tick.
bool RobotStates::may_end(std::int32_t stage, Tick enter, Tick booked) const {
    if (index(stage) < trip_->first_stage_at_end() || booked < stays_from_) {
        return false;
    }
    const Tick end = enter + work_at_end(stage);
    const std::int32_t row = problem_.vertex_row(robot_, trip_->stage_vertex.back());
    return end >= ends_from_ && end <= most_ && is_free(row, booked, never);
}

Tick RobotStates::work_at_end(std::int32_t stage) const {
    Tick work = 0;
    for (auto k = index(stage); k < trip_->n_stages(); ++k) {
        work += trip_->stage_work[k];
    }
    return work;
}

bool RobotStates::may_stay(std::int32_t number, Tick now, Tick next) const {
    const State& one = state(number);
    return now >= rules_.horizon || one.left > 0 ||
           is_free(problem_.vertex_row(robot_, one.vertex), now, next + problem_.rules().headway);
}

Tick RobotStates::next_step(std::int32_t number, Tick now) const {
    const State& state = states_[index(number)];
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
    for_each_way(state, [&](EdgeId edge, Tick drive, Tick need, std::int32_t served) {
        const Tick soonest = now + need - state.age;
        const auto note = [&](Tick tick) {
            if (tick > now && tick >= soonest) {
                next = std::min(next, tick);
            }
        };
        note(rules_.every_tick ? std::max(soonest, now + 1) : soonest);
        if (now >= rules_.horizon || rules_.every_tick) {
            return;
        }
        const VertexId head = problem_.graph().indices[index(edge)];
        for_each_closed(problem_.vertex_row(robot_, head),
                        [&](const Booking& closed) { note(closed.end); });
        if (closes_edges()) {
            for_each_closed(edge_row(edge), [&](const Booking& closed) {
                note(closed.end + (rules_.begins_drives ? 0 : drive));
            });
        }
        if (head == trip_->stage_vertex.back() && index(served) >= trip_->first_stage_at_end()) {
            note(stays_from_);
            note(ends_from_ - work_at_end(served) - (rules_.begins_drives ? drive : 0));
        }
    });
    return next;
}

std::int32_t RobotStates::after(std::int32_t number, Tick ticks) {
    State state = states_[index(number)];
    for (Trail& trail : state.trails) {
        trail.left -= ticks;
    }
    std::erase_if(state.trails, [](const Trail& trail) { return trail.left <= 0; });
    if (state.left > 0) {
        state.left -= ticks;
        if (state.left == 0) {
            if (const Tick headway = problem_.rules().headway; headway > 0) {
                state.trails.push_back({problem_.vertex_row(robot_, state.vertex), headway});
                if (drives_book_edges()) {
                    state.trails.push_back({edge_row(state.edge), headway});
                }
            }
            state.vertex = problem_.graph().indices[index(state.edge)];
            state.edge = trip_->turns.take_time() && !state.ends ? state.edge : none;
        }
    } else if (!state.ends) {
        // A wait is what is longer than the longest stay that may be needed.
        const Tick longest = facts_[index(number)].longest + (rules_.counts_actions() ? 1 : 0);
        state.age = std::min(state.age + ticks, longest);
    }
    return this->number(std::move(state));
}

std::int32_t RobotStates::number(State&& state) {
    std::uint64_t hash = 0;
    for (const std::int64_t part :
         {std::int64_t{state.vertex}, std::int64_t{state.edge}, std::int64_t{state.stage},
          std::int64_t{state.ends}, state.age, state.left}) {
        hash = mix_in(hash, part);
    }
    for (const Trail& trail : state.trails) {
        hash = mix_in(mix_in(hash, trail.row), trail.left);
    }
    const auto fresh = static_cast<std::int32_t>(states_.size());
    const std::int32_t known = known_.find_or_add(
        hash, fresh, [&](std::int32_t other) { return states_[index(other)] == state; });
    if (known == fresh) {
        facts_.push_back(look(state));
        states_.push_back(std::move(state));
    }
    return known;
}

RobotStates::Facts RobotStates::look(const State& state) const {
    Facts facts;
    for (const Trail& trail : state.trails) {
        facts.rows.push_back(trail.row);
    }
    facts.rows.push_back(problem_.vertex_row(robot_, state.vertex));
    if (state.left > 0) {
        const VertexId head = problem_.graph().indices[index(state.edge)];
        if (problem_.rules().books_ahead) {
            facts.rows.push_back(problem_.vertex_row(robot_, head));
        }
        if (drives_book_edges()) {
            facts.rows.push_back(edge_row(state.edge));
        }
        const Tick rest = rests_.rest(head, state.edge, state.stage);
        facts.rest = rest < 0 ? never : state.left + rest;
    } else if (!state.ends) {
        facts.rest = never;
        for_each_way(state, [&](EdgeId edge, Tick drive, Tick need, std::int32_t served) {
            facts.longest = std::max(facts.longest, need);
            const VertexId head = problem_.graph().indices[index(edge)];
            const Tick rest = rests_.rest(head, edge, served);
            if (rest >= 0) {
                const Tick whole = rules_.begins_drives ? drive + rest : rest;
                facts.rest = std::min(facts.rest, std::max<Tick>(need - state.age, 0) + whole);
            }
        });
    }
    return facts;
}

// Calls `use` with each edge out of the vertex where a robot stays, for each number of stages that
// it serves before. That number is chosen when the stay ends, not when the robot comes: it may have
// to wait before it works, or to step aside and come back, for others or for closures. A plan has
// such a choice for each of its drives, so no plan is lost. The arguments of `use` are the edge,
// the ticks of the drive, how long the robot has stayed when it begins to drive (or, where robots
// do not book ahead, when it has driven), and the first stage that is not served.
template <class Use>
void RobotStates::for_each_way(const State& state, const Use& use) const {
    const Graph& roads = problem_.graph();
    for (EdgeId edge = roads.indptr[index(state.vertex)];
         edge < roads.indptr[index(state.vertex + 1)]; ++edge) {
        const Tick drive = problem_.drive(robot_, edge);
        if (drive < 0) {
            continue;
        }
        Tick need = trip_->turns.between(state.edge, edge) + (rules_.begins_drives ? 0 : drive);
        auto stage = index(state.stage);
        use(edge, drive, need, static_cast<std::int32_t>(stage));
        while (stage + 1 < trip_->n_stages() && trip_->stage_vertex[stage] == state.vertex) {
            need += trip_->stage_work[stage] + trip_->stage_turn[stage];
            ++stage;
            use(edge, drive, need, static_cast<std::int32_t>(stage));
        }
    }
}

template <class Use>
void RobotStates::for_each_closed(std::int32_t row, const Use& use) const {
    const auto is_before = [](const Closed& one, std::int32_t wanted) { return one.row < wanted; };
    for (auto one = std::lower_bound(constraints_.begin(), constraints_.end(), row, is_before);
         one != constraints_.end() && one->row == row; ++one) {
        use(one->time);
    }
    for (const BookedBy& one : closures_.at(row)) {
        use(one.time);
    }
}

bool RobotStates::is_free(std::int32_t row, Tick start, Tick end) const {
    bool is_free = true;
    for_each_closed(row, [&](const Booking& closed) {
        is_free = is_free && (closed.start >= end || closed.end <= start);
    });
    return is_free;
}

}  // namespace rightofway

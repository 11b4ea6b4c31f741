#include "lacam/pibt.hpp"

#include <algorithm>

#include "lacam/swaps.hpp"

namespace rightofway {
namespace {

constexpr VertexId nowhere = -1;
constexpr Tick unsettled = -1;
constexpr Tick in_queue = -2;
constexpr std::uint64_t draw_step = 0x9e3779b97f4a7c15U;  // from one random number to the next

}  // namespace

// The fleet during a choice, as `Swaps` reads it.
struct Pibt::Choosing {
    Pibt& pibt;
    const FleetState& now;

    const Graph& graph() const { return pibt.problem_.graph(); }
    VertexId at(RobotId robot) const { return now.at(robot); }
    RobotId here(VertexId vertex) const { return now.here(vertex); }
    RobotId keeps_off(RobotId robot, VertexId vertex) const {
        RobotId found = now.here(vertex);
        if (found == nobody) {
            pibt.any_ahead(now, robot, vertex, [&](RobotId other) {
                found = other;
                return true;
            });
        }
        return found;
    }
    VertexId target(RobotId robot) const { return now.target(robot); }
    std::int32_t way(RobotId robot, VertexId vertex) const { return pibt.way(now, robot, vertex); }
    bool is_free(RobotId robot) const { return !now.is_busy(robot); }
    bool is_idle(RobotId robot) const { return pibt.is_idle(now, robot); }
};

Pibt::Pibt(const Problem& problem, StepTables& tables, const SpaceUtilization& paths,
           std::uint64_t seed)
    : problem_(problem),
      tables_(tables),
      paths_(paths),
      outlook_(static_cast<std::size_t>(problem.n_robots())),
      draw_(seed),
      claim_(static_cast<std::size_t>(problem.edges_exclude() ? problem.n_resources()
                                                              : problem.n_vertices()),
             nobody),
      next_(static_cast<std::size_t>(problem.n_robots()), nowhere),
      arrival_(static_cast<std::size_t>(problem.n_robots()), unsettled),
      rank_(arrival_.size()),
      seen_by_(arrival_.size(), 0) {
    for (std::size_t stage = 0; stage < problem.n_stages(); ++stage) {
        const VertexId target = problem.stage_vertex(static_cast<std::int32_t>(stage));
        stage_table_.push_back(tables.table_of(target));
    }
    for (RobotId r = 0; r < problem.n_robots(); ++r) {
        pace_.push_back(problem.quickest_edge(r));
        turns_.push_back(problem.turns(r));
    }
    for (VertexId v = 0; v < problem.graph().n_vertices(); ++v) {
        most_heads_ = std::max(most_heads_, problem.graph().heads(v).size());
    }
    steps_beside_.resize(static_cast<std::size_t>(problem.n_robots()) * most_heads_);
}

void Pibt::fix(RobotId robot, VertexId vertex) { fixed_.push_back({robot, vertex}); }

bool Pibt::choose(const FleetState& now, std::span<const RobotId> order) {
    decisions_.clear();
    n_choices_ += static_cast<std::int64_t>(fixed_.size());
    const bool found = take_fixed(now) && choose_all(now, order) && settle_arrivals(now);
    forget(now);
    return found;
}

bool Pibt::take_fixed(const FleetState& now) {
    return std::all_of(fixed_.begin(), fixed_.end(), [&](const Fixed& fixed) {
        if (!is_open(now, fixed.robot, fixed.vertex)) {
            return false;
        }
        take(now, fixed.robot, fixed.vertex);
        return true;
    });
}

bool Pibt::choose_all(const FleetState& now, std::span<const RobotId> order) {
    const auto choose_next = [&](RobotId r) {
        return next_[index(r)] != nowhere || choose_one(now, r);
    };
    return std::all_of(order.begin(), order.end(), choose_next) &&
           std::all_of(fixed_.begin(), fixed_.end(), [&](const Fixed& fixed) {
               // Maybe a robot that has arrived.
               return !any_ahead(now, fixed.robot, fixed.vertex, [&](RobotId other) {
                   return !now.is_busy(other) && !choose_next(other);
               });
           });
}

// Calls `use` with the resources that robots may not hold or drive to if this robot is to drive to
// a place, or stay there: use(resource, first row of the size class of these robots, whether only
// the drive is near to it). Ends when `use` returns true.
template <class Use>
bool Pibt::any_near(const FleetState& now, RobotId robot, VertexId place, const Use& use) const {
    const std::int32_t n_resources = problem_.n_resources();
    const auto any_of = [&](const std::int32_t own_row, bool is_drive) {
        const auto rows = problem_.excluded(own_row);
        return std::any_of(rows.begin(), rows.end(), [&](std::int32_t row) {
            const std::int32_t resource = row < n_resources ? row : row % n_resources;
            return use(resource, row - resource, is_drive);
        });
    };
    return any_of(problem_.vertex_row(robot, place), false) ||
           (problem_.edges_exclude() && place != now.at(robot) &&
            any_of(problem_.edge_row(robot, edge_to(now, robot, place)), true));
}

// Calls `use` with each robot that has to leave before this robot drives to a place.
template <class Use>
bool Pibt::any_ahead(const FleetState& now, RobotId robot, VertexId place, const Use& use) const {
    Ahead ahead{place};
    for (RobotId other; (other = next_ahead(now, robot, ahead)) != nobody;) {
        if (use(other)) {
            return true;
        }
    }
    return false;
}

// The next robot that has to leave before this robot drives to a place, by the choices so far;
// `nobody` if all have been asked.
RobotId Pibt::next_ahead(const FleetState& now, RobotId robot, Ahead& ahead) const {
    const std::int32_t n_resources = problem_.n_resources();
    const std::int32_t own_place = problem_.vertex_row(robot, ahead.place);
    const auto near_place = problem_.excluded(own_place);
    std::span<const std::int32_t> near_drive;
    if (problem_.edges_exclude() && ahead.place != now.at(robot)) {
        const std::int32_t own_drive = problem_.edge_row(robot, edge_to(now, robot, ahead.place));
        near_drive = problem_.excluded(own_drive);  // of the lists: only those have edges
    }
    while (ahead.n_asked < 2 * (near_place.size() + near_drive.size())) {
        const std::size_t k = ahead.n_asked / 2;
        const bool is_drive = k >= near_place.size();
        const std::int32_t row = is_drive ? near_drive[k - near_place.size()] : near_place[k];
        const std::int32_t resource = row < n_resources ? row : row % n_resources;
        const bool asks_who_crosses = ahead.n_asked++ % 2 == 1;
        if (asks_who_crosses && resource < problem_.n_vertices()) {
            continue;
        }
        const RobotId other = asks_who_crosses ? claim_[index(resource)] : now.here(resource);
        if (other != nobody && other != robot && problem_.first_row(other) == row - resource &&
            (!asks_who_crosses || !is_drive || goes_first(now, other, robot))) {
            return other;
        }
    }
    return nobody;
}

// Of two robots that chose edges near to each other: a robot whose vertex is in the way goes first,
// else the robot that chose first.
bool Pibt::goes_first(const FleetState& now, RobotId other, RobotId robot) const {
    const auto is_in_the_way_of = [&](RobotId one, RobotId mover) {
        return any_near(now, mover, next_[index(mover)],
                        [&](std::int32_t resource, std::int32_t size, bool) {
                            return resource == now.at(one) && size == problem_.first_row(one);
                        });
    };
    return !is_in_the_way_of(robot, other) &&
           (is_in_the_way_of(other, robot) || rank_[index(other)] < rank_[index(robot)]);
}

void Pibt::take(const FleetState& now, RobotId robot, VertexId vertex) {
    if (next_[index(robot)] == nowhere) {
        rank_[index(robot)] = static_cast<std::int32_t>(chosen_.size());
        chosen_.push_back(robot);
    } else {
        release(now, robot);
    }
    claim_[index(vertex)] = robot;
    next_[index(robot)] = vertex;
    if (problem_.edges_exclude() && moves(now, robot)) {
        claim_[index(problem_.n_vertices() + edge_to(now, robot, vertex))] = robot;
    }
}

// Gives up the place that the robot chose.
void Pibt::release(const FleetState& now, RobotId robot) {
    const VertexId place = next_[index(robot)];
    if (claim_[index(place)] == robot) {
        claim_[index(place)] = nobody;
    }
    if (problem_.edges_exclude() && moves(now, robot)) {
        claim_[index(problem_.n_vertices() + edge_to(now, robot, place))] = nobody;
    }
}

bool Pibt::moves(const FleetState& now, RobotId robot) const {
    return next_[index(robot)] != nowhere && next_[index(robot)] != now.at(robot);
}

// Whether the robot may drive to the place, no other robot enters a vertex near to it, and no robot
// near to it works or wants to swap. Where a robot wants to stay, no other may pass.
bool Pibt::is_open(const FleetState& now, RobotId robot, VertexId place) const {
    const auto n_vertices = problem_.n_vertices();
    if (place != now.at(robot) && !problem_.may_drive(robot, now.at(robot), place)) {
        return false;
    }
    return !any_near(now, robot, place, [&](std::int32_t resource, std::int32_t size, bool) {
        const auto is_other = [&](RobotId other) {
            return other != nobody && other != robot && problem_.first_row(other) == size;
        };
        if (resource >= n_vertices) {
            return place == now.at(robot) && is_other(claim_[index(resource)]);
        }
        if (is_other(now.comes(resource)) || is_other(claim_[index(resource)])) {
            return true;
        }
        const RobotId other = now.here(resource);
        const bool is_at_work = is_other(other) && now.is_busy(other) && now.to(other) == resource;
        return is_at_work || (is_other(other) && next_[index(other)] == now.at(robot));
    });
}

// Whether a robot that moves has booked the place.
bool Pibt::is_booked(const FleetState& now, RobotId robot, VertexId place) const {
    const auto n_vertices = problem_.n_vertices();
    return any_near(now, robot, place, [&](std::int32_t resource, std::int32_t size, bool) {
        const RobotId other = resource < n_vertices ? now.comes(resource) : nobody;
        return other != nobody && problem_.first_row(other) == size;
    });
}

// Whether the robot waits for a robot that waits for it, directly or not.
bool Pibt::closes_rotation(const FleetState& now, RobotId robot) {
    ++n_rotation_searches_;
    queue_.assign(1, robot);
    while (!queue_.empty()) {
        const RobotId next = queue_.back();
        queue_.pop_back();
        const bool meets = any_ahead(now, next, next_[index(next)], [&](RobotId other) {
            if (other != robot && moves(now, other) &&
                seen_by_[index(other)] != n_rotation_searches_) {
                seen_by_[index(other)] = n_rotation_searches_;
                queue_.push_back(other);
            }
            return other == robot;
        });
        if (meets) {
            return true;
        }
    }
    return false;
}

// A robot that is pushed chooses before the robot that pushes it. The chain of pushes is as long as
// the queue in a corridor, so it is a stack of frames and not of calls.
bool Pibt::choose_one(const FleetState& now, RobotId robot) {
    Choice latest = begin(now, robot);
    while (!frames_.empty()) {
        latest = try_candidates(now, latest);
    }
    return latest == Choice::found;
}

// Lets a robot choose that has no candidates to try; `open`: it has, and a frame is pushed.
Pibt::Choice Pibt::begin(const FleetState& now, RobotId robot) {
    ++n_choices_;
    const VertexId here = now.at(robot);
    if (has_to_wait(now, robot)) {
        draw_ +=
            draw_step * (problem_.graph().heads(here).size() + 1);  // as after a ranking of places
        const bool may_stay = is_open(now, robot, here);
        take(now, robot, here);
        return may_stay ? Choice::found : Choice::failed;
    }
    const std::size_t first = places_.size();
    push_places(now, robot);
    const Choosing fleet{*this, now};
    const RobotId partner = Swaps(fleet).partner(robot, places_[first].vertex);
    if (partner != nobody) {
        std::reverse(places_.begin() + static_cast<std::ptrdiff_t>(first), places_.end());
    }
    frames_.push_back({robot, partner, first, places_.size(), first});
    return Choice::open;
}

// Tries candidates of the robot on top of the stack until it has chosen, or has to push another
// robot (`open`). `pushed`: what the robot that it pushed last has chosen.
Pibt::Choice Pibt::try_candidates(const FleetState& now, Choice pushed) {
    Frame& frame = frames_.back();
    const auto stays = [&](RobotId other) { return next_[index(other)] == now.at(other); };
    while (frame.ahead.place != nowhere || take_next_place(now, frame)) {
        bool is_held = pushed == Choice::failed || (pushed == Choice::found && stays(frame.pushed));
        for (RobotId other; !is_held;) {
            other = next_ahead(now, frame.robot, frame.ahead);
            if (other == nobody) {
                break;
            }
            if (is_idle(now, other)) {
                frame.pushed = other;
                pushed = begin(now, other);
                if (pushed == Choice::open) {
                    return Choice::open;
                }
                is_held = pushed == Choice::failed;
            }
            is_held = is_held || stays(other);
        }
        if (!is_held) {
            return end(now, true);
        }
        pushed = Choice::open;
        frame.ahead = {};
        ++frame.k;
    }
    return end(now, false);
}

// Takes the next candidate that is open and closes no forbidden rotation; false if none is left.
bool Pibt::take_next_place(const FleetState& now, Frame& frame) {
    for (; frame.k < frame.end; ++frame.k) {
        const VertexId place = places_[frame.k].vertex;
        if (!is_open(now, frame.robot, place)) {
            continue;
        }
        take(now, frame.robot, place);
        if (!problem_.may_rotate() && place != now.at(frame.robot) &&
            closes_rotation(now, frame.robot)) {
            release(now, frame.robot);
            continue;
        }
        frame.ahead = {place};
        return true;
    }
    return false;
}

// Takes the top of the stack off. A robot that found a place pulls its partner, another one stays.
Pibt::Choice Pibt::end(const FleetState& now, bool is_found) {
    const Frame frame = frames_.back();
    const VertexId here = now.at(frame.robot);
    const RobotId partner = frame.partner;
    const bool pulls =
        is_found && partner != nobody && frame.k == frame.first && places_[frame.k].vertex != here;
    if (pulls && is_idle(now, partner) && claim_[index(here)] == nobody &&
        edge_to(now, partner, here) >= 0 && problem_.may_drive(partner, now.at(partner), here)) {
        pull(now, partner, here);
    }
    places_.resize(frame.first);
    frames_.pop_back();
    if (!is_found) {
        take(now, frame.robot, here);
    }
    return is_found ? Choice::found : Choice::failed;
}

// Whether the robot stays; a shortcut without a ranking of places, for most waiting robots. True if
// staying is forbidden and no neighbour is open, or if staying is allowed, no neighbour that may
// rank before it is open, and there is no swap. A swap is excluded if moving robots have booked all
// those neighbours, because moving robots go first.
bool Pibt::has_to_wait(const FleetState& now, RobotId robot) {
    const Outlook& ahead = outlook(now, robot);
    const auto heads = problem_.graph().heads(ahead.here);
    const std::int32_t* steps = steps_beside(robot);
    bool are_booked = true;
    for (std::size_t k = 0; k < heads.size(); ++k) {
        if (steps[k] <= ahead.steps) {
            if (is_open(now, robot, heads[k])) {
                return false;
            }
            are_booked = are_booked && is_booked(now, robot, heads[k]);
        }
    }
    if (is_open(now, robot, ahead.here)) {
        return are_booked || !has_partner(now, robot);
    }
    return std::none_of(heads.begin(), heads.end(),
                        [&](VertexId head) { return is_open(now, robot, head); });
}

bool Pibt::has_partner(const FleetState& now, RobotId robot) {
    const Outlook& ahead = outlook_[index(robot)];
    const std::size_t n_heads = problem_.graph().heads(ahead.here).size();
    const std::int32_t* steps = steps_beside(robot);
    Place best = place(now, robot, n_heads);
    for (std::size_t k = 0; k < n_heads; ++k) {
        if (steps[k] <= ahead.steps) {  // the others rank after staying
            best = std::min(best, place(now, robot, k), ranks_before);
        }
    }
    return Swaps(Choosing{*this, now}).partner(robot, best.vertex) != nobody;
}

// Lets the partner follow the robot, if no other robot is in its way.
void Pibt::pull(const FleetState& now, RobotId partner, VertexId place) {
    const auto stays = [&](RobotId other) { return !moves(now, other); };
    if (!is_open(now, partner, place) || any_ahead(now, partner, place, stays)) {
        return;
    }
    take(now, partner, place);
    if (closes_rotation(now, partner)) {
        release(now, partner);
        next_[index(partner)] = nowhere;
        chosen_.pop_back();
    }
}

bool Pibt::is_idle(const FleetState& now, RobotId robot) const {
    return next_[index(robot)] == nowhere && !now.is_busy(robot);
}

std::int32_t Pibt::way(const FleetState& now, RobotId robot, VertexId vertex) {
    return tables_.steps(stage_table_[index(now.stage(robot))], vertex);
}

// The earliest arrival at a place if a free robot there leaves at once.
Tick Pibt::soonest(const FleetState& now, RobotId robot, VertexId place, Tick drive) const {
    Tick left = -problem_.rules().headway;
    any_near(now, robot, place, [&](std::int32_t resource, std::int32_t size, bool) {
        const RobotId other = now.here(resource);
        const bool is_held = other != nobody && other != robot && problem_.first_row(other) == size;
        left = std::max(left, !is_held             ? now.left(resource)
                              : now.is_busy(other) ? now.ready(other)
                                                   : 0);
        return false;
    });
    return std::max(now.now() + drive, left + problem_.gap(drive));
}

// When a free robot can begin to drive along an edge: it turns as soon as it is free.
Tick Pibt::turned(const FleetState& now, RobotId robot, EdgeId edge) const {
    const Tick turn = turns_[index(robot)].between(now.came_by(robot), edge);
    return turn == 0 ? now.now() : std::max(now.now(), now.ready(robot) + turn);
}

// The steps to the target from the robot's vertex and its neighbours; cached for waiting robots.
const Pibt::Outlook& Pibt::outlook(const FleetState& now, RobotId robot) {
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

// The candidate over the k-th edge of the robot's vertex, or the vertex itself. The next vertex of
// the preferred path counts as one step nearer and wins ties; other ties are random.
Pibt::Place Pibt::place(const FleetState& now, RobotId robot, std::size_t k) const {
    const Outlook& ahead = outlook_[index(robot)];
    const EdgeId edge = problem_.graph().indptr[index(ahead.here)] + static_cast<EdgeId>(k);
    const bool stays = edge == problem_.graph().indptr[index(ahead.here + 1)];
    const VertexId vertex = stays ? ahead.here : problem_.graph().indices[index(edge)];
    const Tick there = stays ? now.now() + pace_[index(robot)]
                             : soonest(now, robot, vertex, problem_.drive(robot, edge));
    const Tick way_on = (stays ? ahead.steps : steps_beside(robot)[k]) * pace_[index(robot)];
    const bool is_first = !stays && vertex == ahead.preferred;
    const std::uint64_t draw = draw_ + (k + 1) * draw_step;
    std::uint64_t tie = (draw ^ (draw >> 30)) * 0xbf58476d1ce4e5b9U;
    tie ^= tie >> 27;
    return {2 * (there - now.now() + way_on) - (is_first ? 1 : 0),
            static_cast<std::uint32_t>(tie * 0x94d049bb133111ebU >> 32), vertex};
}

bool Pibt::ranks_before(const Place& left, const Place& right) {
    return left.cost != right.cost ? left.cost < right.cost
           : left.tie != right.tie ? left.tie < right.tie
                                   : left.vertex < right.vertex;
}

// Pushes all candidates, earliest arrival at the target first.
void Pibt::push_places(const FleetState& now, RobotId robot) {
    const auto begin = static_cast<std::ptrdiff_t>(places_.size());
    const std::size_t n_places = problem_.graph().heads(outlook(now, robot).here).size() + 1;
    for (std::size_t k = 0; k < n_places; ++k) {
        places_.push_back(place(now, robot, k));
    }
    draw_ += n_places * draw_step;
    std::sort(places_.begin() + begin, places_.end(), ranks_before);
}

bool Pibt::settle_arrivals(const FleetState& now) {
    for (const RobotId robot : chosen_) {
        if (next_[index(robot)] == now.at(robot)) {
            continue;
        }
        if (arrival_[index(robot)] == unsettled && !settle_queue(now, robot)) {
            return false;
        }
        decisions_.push_back({robot, next_[index(robot)], arrival_[index(robot)]});
    }
    return true;
}

// Follows the queues to their fronts and computes the arrivals from there. False if a robot ahead
// stays, or if a queue is a cycle and rotations are forbidden.
bool Pibt::settle_queue(const FleetState& now, RobotId last) {
    queue_.assign(1, last);
    arrival_[index(last)] = in_queue;
    while (!queue_.empty()) {
        const RobotId robot = queue_.back();
        const VertexId place = next_[index(robot)];
        RobotId in_rotation = nobody;
        const bool is_behind = any_ahead(now, robot, place, [&](RobotId other) {
            if (now.is_busy(other) || arrival_[index(other)] >= 0) {
                return false;
            }
            if (arrival_[index(other)] == in_queue || !moves(now, other)) {
                in_rotation = other;
                return false;
            }
            arrival_[index(other)] = in_queue;
            queue_.push_back(other);
            return true;
        });
        if (is_behind) {
            continue;
        }
        if (in_rotation != nobody && (!moves(now, in_rotation) || !settle_rotation(now, robot))) {
            return false;
        }
        queue_.pop_back();
        if (arrival_[index(robot)] != in_queue) {
            continue;  // part of a rotation
        }
        const EdgeId edge = edge_to(now, robot, place);
        const Tick drive = problem_.drive(robot, edge);
        Tick left = -problem_.rules().headway;
        any_near(now, robot, place, [&](std::int32_t resource, std::int32_t, bool) {
            left = std::max(left, now.left(resource));
            return false;
        });
        any_ahead(now, robot, place, [&](RobotId other) {
            left = std::max(left, now.is_busy(other) ? now.ready(other) : arrival_[index(other)]);
            return false;
        });
        arrival_[index(robot)] =
            std::max(turned(now, robot, edge) + drive, left + problem_.gap(drive));
    }
    return true;
}

bool Pibt::settle_rotation(const FleetState& now, RobotId member) {
    if (!problem_.may_rotate()) {
        return false;
    }
    Tick latest = 0;
    RobotId robot = member;
    do {
        const EdgeId edge = edge_to(now, robot, next_[index(robot)]);
        latest = std::max(latest, turned(now, robot, edge) + problem_.drive(robot, edge));
        robot = now.here(next_[index(robot)]);
    } while (robot != member);
    do {
        arrival_[index(robot)] = latest;
        robot = now.here(next_[index(robot)]);
    } while (robot != member);
    return true;
}

void Pibt::forget(const FleetState& now) {
    for (const RobotId robot : chosen_) {
        claim_[index(next_[index(robot)])] = nobody;
        claim_[index(now.at(robot))] = nobody;
        if (problem_.edges_exclude() && moves(now, robot)) {
            claim_[index(problem_.n_vertices() + edge_to(now, robot, next_[index(robot)]))] =
                nobody;
        }
        next_[index(robot)] = nowhere;
        arrival_[index(robot)] = unsettled;
    }
    chosen_.clear();
    fixed_.clear();
}

}  // namespace rightofway

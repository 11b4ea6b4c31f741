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
      claim_(static_cast<std::size_t>(problem.graph().n_vertices()), nobody),
      next_(static_cast<std::size_t>(problem.n_robots()), nowhere),
      arrival_(static_cast<std::size_t>(problem.n_robots()), unsettled) {
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

void Pibt::fix(RobotId robot, VertexId vertex) { fixed_.push_back({robot, vertex}); }

bool Pibt::choose(const FleetState& now, std::span<const RobotId> order) {
    decisions_.clear();
    const bool found = take_fixed(now) && choose_all(now, order) && settle_arrivals(now);
    forget(now);
    return found;
}

bool Pibt::take_fixed(const FleetState& now) {
    return std::all_of(fixed_.begin(), fixed_.end(), [&](const Fixed& fixed) {
        if (!is_open(now, fixed.robot, fixed.vertex)) {
            return false;
        }
        take(fixed.robot, fixed.vertex);
        return true;
    });
}

bool Pibt::choose_all(const FleetState& now, std::span<const RobotId> order) {
    const auto choose_next = [&](RobotId r) { return next_[r] != nowhere || choose_one(now, r); };
    return std::all_of(order.begin(), order.end(), choose_next) &&
           std::all_of(fixed_.begin(), fixed_.end(), [&](const Fixed& fixed) {
               const RobotId other = now.here(fixed.vertex);  // maybe a robot that has arrived
               return other == nobody || now.is_busy(other) || choose_next(other);
           });
}

void Pibt::take(RobotId robot, VertexId vertex) {
    if (next_[robot] == nowhere) {
        chosen_.push_back(robot);
    }
    claim_[vertex] = robot;
    next_[robot] = vertex;
}

// Whether no other robot enters the place, and the robot there neither works nor wants to swap.
bool Pibt::is_open(const FleetState& now, RobotId robot, VertexId place) const {
    if (now.comes(place) != nobody || claim_[place] != nobody) {
        return false;
    }
    const RobotId other = now.here(place);
    if (other == nobody || other == robot) {
        return true;
    }
    const bool is_at_work = now.is_busy(other) && now.to(other) == place;
    return !is_at_work && next_[other] != now.at(robot);
}

bool Pibt::closes_circle(const FleetState& now, RobotId robot, VertexId place) const {
    RobotId other = now.here(place);
    while (other != nobody && other != robot && next_[other] != nowhere &&
           next_[other] != now.at(other)) {
        other = now.here(next_[other]);
    }
    return other == robot;
}

bool Pibt::choose_one(const FleetState& now, RobotId robot) {
    ++n_choices_;
    const VertexId here = now.at(robot);
    if (has_to_wait(now, robot)) {
        draw_ +=
            draw_step * (problem_.graph().heads(here).size() + 1);  // as after a ranking of places
        const bool may_stay = is_open(now, robot, here);
        take(robot, here);
        return may_stay;
    }
    const std::size_t first = places_.size();
    push_places(now, robot);
    const Choosing fleet{*this, now};
    const RobotId partner = Swaps(fleet).partner(robot, places_[first].vertex);
    if (partner != nobody) {
        std::reverse(places_.begin() + static_cast<std::ptrdiff_t>(first), places_.end());
    }
    const bool found = try_places(now, robot, first, partner);
    places_.resize(first);
    if (!found) {
        take(robot, here);
    }
    return found;
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
            are_booked = are_booked && now.comes(heads[k]) != nobody;
        }
    }
    if (is_open(now, robot, ahead.here)) {
        return are_booked || !has_partner(now, robot);
    }
    return std::none_of(heads.begin(), heads.end(),
                        [&](VertexId head) { return is_open(now, robot, head); });
}

bool Pibt::has_partner(const FleetState& now, RobotId robot) {
    const Outlook& ahead = outlook_[robot];
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

bool Pibt::try_places(const FleetState& now, RobotId robot, std::size_t first, RobotId partner) {
    const VertexId here = now.at(robot);
    const std::size_t end = places_.size();
    for (std::size_t k = first; k < end; ++k) {
        const VertexId place = places_[k].vertex;
        const RobotId other = now.here(place);
        if (!is_open(now, robot, place) ||
            (!problem_.may_rotate() && place != here && closes_circle(now, robot, place))) {
            continue;
        }
        take(robot, place);
        if (other != robot && other != nobody && is_idle(now, other) && !choose_one(now, other)) {
            continue;  // `other` stays, so the place is occupied
        }
        const bool pulls = partner != nobody && k == first && place != here;
        if (pulls && is_idle(now, partner) && claim_[here] == nobody &&
            problem_.graph().edge(now.at(partner), here) >= 0) {
            take(partner, here);
        }
        return true;
    }
    return false;
}

bool Pibt::is_idle(const FleetState& now, RobotId robot) const {
    return next_[robot] == nowhere && !now.is_busy(robot);
}

std::int32_t Pibt::way(const FleetState& now, RobotId robot, VertexId vertex) {
    return tables_.steps(stage_table_[now.stage(robot)], vertex);
}

// The earliest arrival at a place if a free robot there leaves at once.
Tick Pibt::soonest(const FleetState& now, RobotId robot, VertexId place, Tick drive) const {
    const RobotId other = now.here(place);
    const bool drives_away = other != nobody && other != robot && now.is_busy(other);
    const Tick left = drives_away ? now.ready(other) : other == nobody ? now.left(place) : 0;
    return std::max(now.now() + drive, left + problem_.gap(drive));
}

// The steps to the target from the robot's vertex and its neighbours; cached for waiting robots.
const Pibt::Outlook& Pibt::outlook(const FleetState& now, RobotId robot) {
    Outlook& outlook = outlook_[robot];
    const VertexId here = now.at(robot);
    const std::int32_t stage = now.stage(robot);
    if (outlook.here == here && outlook.stage == stage) {
        return outlook;
    }
    outlook.here = here;
    outlook.stage = stage;
    outlook.steps = way(now, robot, here);
    outlook.preferred = paths_.next(stage, here);
    std::int32_t* beside = steps_beside_.data() + static_cast<std::size_t>(robot) * most_heads_;
    for (const VertexId head : problem_.graph().heads(here)) {
        *beside++ = head == outlook.preferred ? outlook.steps - 1 : way(now, robot, head);
    }
    return outlook;
}

// The candidate over the k-th edge of the robot's vertex, or the vertex itself. The next vertex of
// the preferred path counts as one step nearer and wins ties; other ties are random.
Pibt::Place Pibt::place(const FleetState& now, RobotId robot, std::size_t k) const {
    const Outlook& ahead = outlook_[robot];
    const EdgeId edge = problem_.graph().indptr[ahead.here] + static_cast<EdgeId>(k);
    const bool stays = edge == problem_.graph().indptr[ahead.here + 1];
    const VertexId vertex = stays ? ahead.here : problem_.graph().indices[edge];
    const Tick there =
        stays ? now.now() + pace_[robot] : soonest(now, robot, vertex, problem_.drive(robot, edge));
    const Tick way_on = (stays ? ahead.steps : steps_beside(robot)[k]) * pace_[robot];
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
        if (next_[robot] == now.at(robot)) {
            continue;
        }
        if (arrival_[robot] == unsettled && !settle_queue(now, robot)) {
            return false;
        }
        decisions_.push_back({robot, next_[robot], arrival_[robot]});
    }
    return true;
}

// Follows the queue to its front and computes the arrivals from there. False if the queue is a
// circle and rotations are forbidden.
bool Pibt::settle_queue(const FleetState& now, RobotId last) {
    queue_.clear();
    RobotId robot = last;
    while (robot != nobody && next_[robot] != nowhere && arrival_[robot] == unsettled) {
        arrival_[robot] = in_queue;
        queue_.push_back(robot);
        robot = now.here(next_[robot]);
    }
    if (robot != nobody && arrival_[robot] == in_queue && !settle_circle(now, robot)) {
        return false;
    }
    for (; !queue_.empty(); queue_.pop_back()) {
        const RobotId next = queue_.back();
        if (arrival_[next] != in_queue) {
            continue;  // part of a circle
        }
        const VertexId place = next_[next];
        const RobotId ahead = now.here(place);
        const Tick left = ahead == nobody      ? now.left(place)
                          : now.is_busy(ahead) ? now.ready(ahead)
                                               : arrival_[ahead];
        const Tick drive = problem_.drive(next, problem_.graph().edge(now.at(next), place));
        arrival_[next] = std::max(now.now() + drive, left + problem_.gap(drive));
    }
    return true;
}

bool Pibt::settle_circle(const FleetState& now, RobotId member) {
    if (!problem_.may_rotate()) {
        return false;
    }
    Tick slowest = 0;
    RobotId robot = member;
    do {
        slowest = std::max<Tick>(
            slowest, problem_.drive(robot, problem_.graph().edge(now.at(robot), next_[robot])));
        robot = now.here(next_[robot]);
    } while (robot != member);
    do {
        arrival_[robot] = now.now() + slowest;
        robot = now.here(next_[robot]);
    } while (robot != member);
    return true;
}

void Pibt::forget(const FleetState& now) {
    for (const RobotId robot : chosen_) {
        claim_[next_[robot]] = nobody;
        claim_[now.at(robot)] = nobody;
        next_[robot] = nowhere;
        arrival_[robot] = unsettled;
    }
    chosen_.clear();
    fixed_.clear();
}

}  // namespace rightofway

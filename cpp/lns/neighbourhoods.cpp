#include "lns/neighbourhoods.hpp"

#include <algorithm>

namespace rightofway {
namespace {

constexpr std::int32_t walks = 10;
constexpr std::size_t places_around = 40;
constexpr std::size_t visits_around = 12;

struct Drive {
    VertexId next = -1;
    std::int32_t ticks = 0;
};

// A drive from a vertex, at random among those after which the way to the end of a stage, the drive
// included, is as asked for; none if there is none.
template <typename Fits>
Drive random_drive(const Roads& roads, const Trip& trip, std::size_t stage, VertexId place,
                   Random& random, const Fits& fits) {
    Drive drive;
    std::size_t n_ways = 0;
    for (EdgeId e = roads.graph.indptr[index(place)]; e < roads.graph.indptr[index(place + 1)];
         ++e) {
        const std::int32_t ticks = trip.pace[index(roads.length_class[index(e)])];
        const VertexId head = roads.graph.indices[index(e)];
        const Tick rest = trip.to_stage[stage].from(head);
        if (ticks != barred && rest >= 0 && fits(ticks + rest) && random.below(++n_ways) == 0) {
            drive = {head, ticks};
        }
    }
    return drive;
}

}  // namespace

Neighbourhoods::Neighbourhoods(SharedDistances& distances, const FleetPlan& plan,
                               std::span<const Tick> alone)
    : problem_(distances.problem()),
      plan_(plan),
      alone_(alone),
      reader_(distances),
      is_chosen_(alone.size(), 0) {}

const std::vector<RobotId>& Neighbourhoods::choose(NeighbourhoodKind kind, std::size_t size,
                                                   Random& random) {
    for (const RobotId robot : chosen_) {
        is_chosen_[index(robot)] = 0;
    }
    chosen_.clear();
    size = std::min(size, is_chosen_.size());
    switch (kind) {
        case NeighbourhoodKind::blockers:
            blockers(size, random);
            break;
        case NeighbourhoodKind::delay:
            delay(size, random);
            break;
        case NeighbourhoodKind::congestion:
            congestion(size, random);
            break;
        case NeighbourhoodKind::segment:
            segment(size, random);
            break;
        case NeighbourhoodKind::window:
            window(size, random);
            return chosen_;
        case NeighbourhoodKind::random:
            break;
    }
    if (kind == NeighbourhoodKind::random || chosen_.size() < 2) {
        fill_up(size, random);
    }
    return chosen_;
}

void Neighbourhoods::add(RobotId robot) {
    auto& is_chosen = is_chosen_[index(robot)];
    if (is_chosen == 0) {
        is_chosen = 1;
        chosen_.push_back(robot);
    }
}

// Adds the robots with a booking that overlaps [start, end) and excludes the first robot chosen
// from the vertex.
void Neighbourhoods::add_all(VertexId vertex, Tick start, Tick end, std::size_t size) {
    const auto here = plan_.bookings().at(problem_.vertex_row(chosen_.front(), vertex));
    BookingTable::any_overlap(here, {start, end}, [&](const BookedBy& one) {
        if (chosen_.size() < size && one.robot != nobody) {
            add(one.robot);
        }
        return chosen_.size() >= size;
    });
}

void Neighbourhoods::fill_up(std::size_t size, Random& random) {
    while (chosen_.size() < size) {
        add(static_cast<RobotId>(random.below(is_chosen_.size())));
    }
}

// A robot drawn with probability proportional to its delay; any robot if none is late. For a
// makespan every other time one of the robots that complete last.
RobotId Neighbourhoods::late_robot(Random& random) {
    if (plan_.objective() != Objective::flowtime && random.below(2) == 0) {
        return last_robot(random);
    }
    const Tick all = plan_.cost();
    Tick bound = 0;
    for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
        bound += problem_.weight(robot) * alone_[index(robot)];
    }
    if (all <= bound) {
        return static_cast<RobotId>(random.below(alone_.size()));
    }
    Tick left = static_cast<Tick>(random.below(static_cast<std::size_t>(all - bound)));
    RobotId robot = 0;
    while ((left -= problem_.weight(robot) * (plan_.track(robot).cost - alone_[index(robot)])) >=
           0) {
        ++robot;
    }
    return robot;
}

// One of the robots that complete last.
RobotId Neighbourhoods::last_robot(Random& random) const {
    const Tick makespan = plan_.makespan();
    RobotId last = 0;
    std::size_t n_last = 0;
    for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
        if (plan_.track(robot).cost == makespan && random.below(++n_last) == 0) {
            last = robot;
        }
    }
    return last;
}

// Continues from a random visit as if alone and adds the robots met.
void Neighbourhoods::blockers(std::size_t size, Random& random) {
    const RobotId robot = late_robot(random);
    add(robot);
    const auto& visits = plan_.track(robot).visits;
    const Trip& trip = reader_.read(robot);
    completion(trip, visits, &stage_of_);
    for (std::int32_t walk = 0; walk < walks && chosen_.size() < size; ++walk) {
        const std::size_t first = random.below(visits.size());
        VertexId place = visits[first].vertex;
        auto stage = index(stage_of_[first]);
        if (stage == trip.n_stages() || first + 1 == visits.size()) {
            continue;
        }
        const Tick served = first == 0 || stage_of_[first] == stage_of_[first - 1]
                                ? 0
                                : trip.stage_work[stage - 1] + trip.stage_turn[stage - 1];
        Tick now = visits[first].enter + served;
        while (stage < trip.n_stages() && chosen_.size() < size) {
            const Tick way = trip.to_stage[stage].from(place);
            if (way == 0) {
                const Tick until = now + trip.stage_work[stage] + trip.stage_turn[stage];
                const bool is_last = stage + 1 == trip.n_stages();
                add_all(place, now, is_last ? never : until + 1, size);
                now = until;
                ++stage;
                continue;
            }
            const auto [next, drive] = random_drive(problem_.roads(), trip, stage, place, random,
                                                    [&](Tick rest) { return rest == way; });
            add_all(next, now + (problem_.rules().books_ahead ? 0 : drive), now + drive + 1, size);
            now += drive;
            place = next;
        }
    }
}

// Walks at random from a random visit while the robot could still complete earlier than planned;
// adds the robots met.
void Neighbourhoods::delay(std::size_t size, Random& random) {
    const RobotId robot = late_robot(random);
    add(robot);
    const auto& track = plan_.track(robot);
    const Trip& trip = reader_.read(robot);
    completion(trip, track.visits, &stage_of_);
    for (std::int32_t walk = 0; walk < walks && chosen_.size() < size; ++walk) {
        const std::size_t first = random.below(track.visits.size());
        VertexId place = track.visits[first].vertex;
        const auto stage = index(stage_of_[first]);
        if (stage == trip.n_stages()) {
            continue;
        }
        const std::size_t last =
            std::min(first + 1 + random.below(visits_around), track.visits.size() - 1);
        const Tick until =
            track.visits[last].enter + trip.to_stage[stage].from(track.visits[last].vertex);
        Tick now = track.visits[first].enter;
        for (;;) {
            const auto [next, drive] = random_drive(problem_.roads(), trip, stage, place, random,
                                                    [&](Tick rest) { return now + rest < until; });
            if (next < 0 || chosen_.size() >= size) {
                break;
            }
            add_all(next, now, now + drive + 1, size);
            now += drive;
            place = next;
        }
    }
}

// Adds the robots that pass near a random visit, nearest vertices first.
void Neighbourhoods::congestion(std::size_t size, Random& random) {
    const RobotId robot = static_cast<RobotId>(random.below(alone_.size()));
    add(robot);
    const auto& visits = plan_.track(robot).visits;
    add_around(visits[random.below(visits.size())], 3 * problem_.slowest_edge(robot), size);
}

// Adds the robots that pass near a visit, nearest vertices first.
void Neighbourhoods::add_around(const Visit& middle, Tick around, std::size_t size) {
    const Graph& graph = problem_.graph();
    ring_.assign(1, middle.vertex);
    for (std::size_t k = 0; k < ring_.size() && k < places_around && chosen_.size() < size; ++k) {
        add_all(ring_[k], middle.enter - around, middle.enter + around, size);
        for (const VertexId head : graph.heads(ring_[k])) {
            if (ring_.size() < places_around &&
                std::find(ring_.begin(), ring_.end(), head) == ring_.end()) {
                ring_.push_back(head);
            }
        }
    }
}

// Adds the robots that drive edges around a random visit the opposite way, nearest in time first.
void Neighbourhoods::segment(std::size_t size, Random& random) {
    const RobotId robot = late_robot(random);
    add(robot);
    const auto& visits = plan_.track(robot).visits;
    const std::size_t middle = random.below(visits.size());
    const std::size_t begin = middle > visits_around ? middle - visits_around : 0;
    const std::size_t end = std::min(middle + visits_around, visits.size() - 1);
    std::vector<std::pair<Tick, RobotId>> opposite;
    for (std::size_t k = begin; k < end; ++k) {
        const auto here = plan_.bookings().at(problem_.vertex_row(robot, visits[k].vertex));
        const auto there = plan_.bookings().at(problem_.vertex_row(robot, visits[k + 1].vertex));
        const std::int32_t now = BookingTable::started(here, visits[k].enter);
        const std::int32_t from = std::max(now - 8, 0);
        const std::int32_t to = std::min(now + 8, static_cast<std::int32_t>(here.size()));
        for (std::int32_t j = from; j < to; ++j) {
            const BookedBy& one = here[index(j)];
            if (one.robot == robot || one.robot == nobody) {
                continue;
            }
            // The robot that was at the next vertex just before.
            std::int32_t i = BookingTable::started(there, one.time.start);
            for (; i > 0 && there[index(i - 1)].reach >= one.time.start; --i) {
                if (there[index(i - 1)].robot == one.robot &&
                    there[index(i - 1)].time.end >= one.time.start) {
                    opposite.emplace_back(std::abs(one.time.start - visits[k].enter), one.robot);
                    break;
                }
            }
        }
    }
    std::sort(opposite.begin(), opposite.end());
    for (const auto& [away, other] : opposite) {
        if (chosen_.size() < size) {
            add(other);
        }
    }
}

// Adds the robots that pass the route of a late robot around a random visit, nearest visits first,
// then those near that visit.
void Neighbourhoods::window(std::size_t size, Random& random) {
    const RobotId robot = late_robot(random);
    add(robot);
    const auto& visits = plan_.track(robot).visits;
    const std::size_t middle = random.below(visits.size());
    const Tick around = 3 * problem_.slowest_edge(robot);
    middle_ = visits[middle].enter;
    for (std::size_t away = 0; away <= visits_around && chosen_.size() < size; ++away) {
        for (const std::size_t k : {middle - std::min(away, middle), middle + away}) {
            if (k < visits.size()) {
                add_all(visits[k].vertex, visits[k].enter - around, visits[k].enter + around, size);
            }
        }
    }
    add_around(visits[middle], around, size);
}

}  // namespace rightofway

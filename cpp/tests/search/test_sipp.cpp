#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <span>
#include <stdexcept>
#include <tuple>

#include "core/random.hpp"
#include "corridors.hpp"
#include "search/sipp.hpp"

namespace rightofway {
namespace {

using Ticks = std::vector<Tick>;
using Vertices = std::vector<VertexId>;

struct FoundTrack {
    Vertices vertices;
    Ticks enter;
    Tick cost = -1;
};

// One robot on its way from `home` past stages, among bookings.
struct Case {
    test::Roads roads;
    BookingTable table{4};
    BookingRules rules{0, false};
    VertexId home = 0;
    Vertices stages{};
    Ticks work{};
    Ticks prices{};
    Tick limit = never;
    Ticks earliest{};  // empty: stages have no times
    Ticks latest{};
    Tick ready = 0;

    SearchEnd run(FoundTrack& found) const {
        const std::vector<std::int32_t> classes(roads.heads.size(), 0);
        const std::vector<std::int32_t> pace{1};
        const Ticks turn(stages.size(), 0);
        std::vector<std::vector<std::int32_t>> tables;
        for (const VertexId stage : stages) {
            tables.push_back(stage == none ? std::vector<std::int32_t>(4, 0) : roads.table(stage));
        }
        Trip trip{home, stages, work, turn, pace, {}, {}, {}, {}};
        if (!earliest.empty()) {
            trip.times = {earliest, latest};
            trip.times.ready = ready;
            trip.times.n_places = 4;
        }
        for (const auto& one : tables) {
            trip.to_stage.emplace_back(one.data(), 1);
        }
        const Roads all{roads.graph(), classes};
        require_trip(all, trip);
        SafeIntervalSearch search(all, rules);
        const SearchEnd end = search.run({trip, table, prices, limit}, test::no_deadline);
        std::vector<Visit> visits;
        search.track(visits);
        found = {};
        for (const Visit& visit : visits) {
            found.vertices.push_back(visit.vertex);
            found.enter.push_back(visit.enter);
        }
        found.cost = end == SearchEnd::found ? search.cost() : -1;
        return end;
    }
};

struct Booked {
    VertexId vertex;
    Tick start;
    Tick end;
    RobotId robot;
};

// The least completion with prices, found by trying every tick: Dijkstra's algorithm over tick,
// vertex, stages done, since when the robot is free to go, and bookings of the vertex it has paid.
class EveryTick {
  public:
    EveryTick(const Case& one, std::span<const Booked> booked) : one_(one), booked_(booked) {}

    Tick least_cost(Tick horizon) {
        const std::uint32_t met = overlaps(one_.home, 0, 1 + one_.rules.headway);
        add(price(met), {0, one_.home, 0, 0, met});
        Tick best = never;
        while (!open_.empty()) {
            const auto [cost, state] = *open_.begin();
            open_.erase(open_.begin());
            if (known_.insert(state).second && std::get<0>(state) <= horizon) {
                best = std::min(best, cost + to_completion(state));
                expand(cost, state);
            }
        }
        return best;
    }

  private:
    using State = std::tuple<Tick, VertexId, std::size_t, Tick, std::uint32_t>;

    std::uint32_t overlaps(VertexId vertex, Tick start, Tick end) const {
        std::uint32_t found = 0;
        for (std::size_t k = 0; k < booked_.size(); ++k) {
            const Booked& b = booked_[k];
            found |= b.vertex == vertex && b.start < end && start < b.end ? 1U << k : 0U;
        }
        return found;
    }

    Tick price(std::uint32_t bookings) const {
        Tick sum = 0;
        for (std::size_t k = 0; k < booked_.size(); ++k) {
            sum += (bookings >> k & 1U) != 0 ? one_.prices[index(booked_[k].robot)] : 0;
        }
        return sum;
    }

    // The prices of robots that leave the head for the tail at this very tick.
    Tick swaps(VertexId tail, VertexId head, Tick tick) const {
        std::set<RobotId> robots;
        for (const Booked& out : booked_) {
            for (const Booked& in : booked_) {
                if (out.vertex == head && out.end == tick && in.vertex == tail &&
                    in.start == tick && in.robot == out.robot) {
                    robots.insert(in.robot);
                }
            }
        }
        Tick sum = 0;
        for (const RobotId robot : robots) {
            sum += one_.prices[index(robot)];
        }
        return sum;
    }

    Tick to_completion(const State& state) const {
        const auto& [tick, vertex, stage, busy_until, paid] = state;
        Tick work = 0;
        for (std::size_t k = stage; k < one_.stages.size(); ++k) {
            if (one_.stages[k] != vertex) {
                return never / 2;
            }
            work += one_.work[k];
        }
        return std::max(tick, busy_until) + work + price(overlaps(vertex, tick, never) & ~paid);
    }

    void expand(Tick cost, const State& state) {
        const auto& [tick, vertex, stage, busy_until, paid] = state;
        const auto& [headway, books_ahead, rotations] = one_.rules;
        const std::uint32_t met = overlaps(vertex, tick, tick + 2 + headway);
        add(cost + price(met & ~paid), {tick + 1, vertex, stage, busy_until, paid | met});
        if (stage + 1 < one_.stages.size() && one_.stages[stage] == vertex) {
            const Tick until = std::max(tick, busy_until) + one_.work[stage];
            add(cost, {tick, vertex, stage + 1, until, paid});
        }
        if (tick < busy_until) {
            return;
        }
        for (const VertexId head : one_.roads.graph().heads(vertex)) {
            const Tick enter = tick + 1;
            const std::uint32_t here = overlaps(vertex, tick, enter + headway) & ~paid;
            const std::uint32_t there =
                overlaps(head, enter - (books_ahead ? 1 : 0), enter + 1 + headway);
            const bool may_swap = here == 0 && headway == 0 && !books_ahead;
            const Tick paid_swaps = may_swap ? swaps(vertex, head, enter) : 0;
            add(cost + price(here) + price(there) + paid_swaps, {enter, head, stage, 0, there});
        }
    }

    void add(Tick cost, const State& state) {
        if (!known_.contains(state)) {
            open_.insert({cost, state});
        }
    }

    const Case& one_;
    std::span<const Booked> booked_;
    std::set<std::pair<Tick, State>> open_;
    std::set<State> known_;
};

TEST_CASE("with prices for overlaps, the search finds the cheapest track there is") {
    Random random(0);
    const auto at_most = [&](std::size_t most) {
        return static_cast<Tick>(random.below(most + 1));
    };
    for (int round = 0; round < 400; ++round) {
        const bool has_bay = random.below(2) == 0;
        Case one{has_bay ? test::corridor_with_bay() : test::corridor()};
        one.rules.books_ahead = random.below(2) == 0;
        one.home = static_cast<VertexId>(random.below(4));
        one.stages = {static_cast<VertexId>(random.below(4)), one.home};
        one.work = {at_most(2), 0};
        std::vector<Booked> booked;
        for (RobotId robot = 0; robot < static_cast<RobotId>(1 + random.below(5)); ++robot) {
            const Tick start = at_most(12);
            booked.push_back(
                {static_cast<VertexId>(random.below(4)), start, start + 1 + at_most(5), robot});
            const Booked& last = booked.back();
            one.table.insert(last.vertex, {last.start, last.end}, robot);
            one.prices.push_back(at_most(9));
        }
        FoundTrack found;
        REQUIRE(one.run(found) == SearchEnd::found);
        CHECK(found.cost == EveryTick(one, booked).least_cost(40));
    }
}

TEST_CASE("alone, a robot works at its stop and comes home") {
    FoundTrack found;
    const Case one{test::corridor(), BookingTable(4), {0, false}, 0, {3, 0}, {2, 0}};
    CHECK(one.run(found) == SearchEnd::found);
    CHECK(found.vertices == Vertices{0, 1, 2, 3, 2, 1, 0});
    // In 3 from tick 3, two ticks of work and one of driving.
    CHECK(found.enter == Ticks{0, 1, 2, 3, 6, 7, 8});
}

TEST_CASE("a robot waits until the vertex ahead is free, and the headway is over") {
    FoundTrack found;
    Case one{test::corridor(), BookingTable(4), {0, false}, 0, {3}, {0}};
    one.table.book(2, {1, 6}, 9);
    CHECK(one.run(found) == SearchEnd::found);
    CHECK(found.enter == Ticks{0, 1, 6, 7});
    one.rules.books_ahead = true;  // 2 is booked while driving there, from tick 6 on
    CHECK(one.run(found) == SearchEnd::found);
    CHECK(found.enter == Ticks{0, 1, 7, 8});
}

TEST_CASE("a robot steps aside where it cannot stay") {
    FoundTrack found;
    Case one{test::corridor_with_bay(), BookingTable(4), {0, false}, 0, {0}, {0}};
    one.table.book(0, {3, 5}, 9);  // somebody comes through 1 to the robot's home and goes back
    one.table.book(1, {2, 3}, 9);
    one.table.book(1, {5, 6}, 9);
    CHECK(one.run(found) == SearchEnd::found);
    CHECK(found.vertices.front() == 0);
    CHECK(found.vertices.back() == 0);
    CHECK(found.enter.back() >= 7);  // 1 is free again from 6 on
}

TEST_CASE("two robots do not change places") {
    FoundTrack found;
    Case one{test::corridor(), BookingTable(4), {0, false}, 0, {2}, {0}};
    // Robot 9 stands in 1 until tick 1 and in 0 from then until tick 5: it comes the other way.
    one.table.book(1, {0, 1}, 9);
    one.table.book(0, {1, 5}, 9);
    CHECK(one.run(found) == SearchEnd::proven_none);
    // Where it is somebody else who comes to 0, from elsewhere, the robot may go.
    Case other{test::corridor(), BookingTable(4), {0, false}, 0, {2}, {0}};
    other.table.book(1, {0, 1}, 9);
    other.table.book(0, {1, 5}, 8);
    CHECK(other.run(found) == SearchEnd::found);
    CHECK(found.enter == Ticks{0, 1, 2});
}

TEST_CASE("without an end that stays free there is no track, and that is proven") {
    FoundTrack found;
    Case one{test::corridor(), BookingTable(4), {0, false}, 0, {3}, {0}};
    one.table.book(3, {50, never}, 9);
    CHECK(one.run(found) == SearchEnd::proven_none);
    CHECK(found.vertices.empty());
}

TEST_CASE("a robot overlaps others where that is cheaper than to wait, and says what it cost") {
    FoundTrack found;
    Case one{test::corridor(), BookingTable(4), {0, false}, 0, {3}, {0}};
    one.table.insert(2, {1, 6}, 0);
    one.prices = {2};
    CHECK(one.run(found) == SearchEnd::found);
    CHECK(found.enter == Ticks{0, 1, 2, 3});
    CHECK(found.cost == 5);
    one.prices = {5};  // waiting in 1 until 6 costs 4
    CHECK(one.run(found) == SearchEnd::found);
    CHECK(found.enter == Ticks{0, 1, 6, 7});
    CHECK(found.cost == 7);
}

TEST_CASE("at a price a robot stays where somebody else comes, and changes places") {
    FoundTrack found;
    Case one{test::corridor(), BookingTable(4), {0, false}, 0, {1}, {3}};
    one.table.insert(1, {2, 3}, 0);
    one.table.insert(1, {4, 5}, 0);
    one.prices = {1};
    CHECK(one.run(found) == SearchEnd::found);
    // In 1 from tick 1 for ever, done at 4, both bookings paid; to wait until 5 would make it 8.
    CHECK(found.enter == Ticks{0, 1});
    CHECK(found.cost == 6);
    Case other{test::corridor(), BookingTable(4), {0, false}, 0, {2}, {0}};
    other.table.insert(1, {0, 1}, 0);
    other.table.insert(0, {1, never}, 0);
    other.prices = {9};
    CHECK(other.run(found) == SearchEnd::found);
    CHECK(found.enter == Ticks{0, 1, 2});
    CHECK(found.cost == 11);
}

TEST_CASE("tracks beyond the limit are of no use") {
    FoundTrack found;
    Case one{test::corridor(), BookingTable(4), {0, false}, 0, {3}, {0}};
    one.table.book(2, {1, 6}, 9);
    one.limit = 6;
    CHECK(one.run(found) == SearchEnd::proven_none);
    one.limit = 7;
    CHECK(one.run(found) == SearchEnd::found);
}

TEST_CASE("work waits for its earliest begin, and ends in time or not at all") {
    FoundTrack found;
    Case one{test::corridor(), BookingTable(4), {0, false}, 0, {2, 0}, {3, 0}};
    one.earliest = {10, 0};
    one.latest = {13, never};
    REQUIRE(one.run(found) == SearchEnd::found);
    CHECK(found.vertices == Vertices{0, 1, 2, 1, 0});
    CHECK(found.enter == Ticks{0, 1, 2, 14, 15});  // works from 10 to 13
    CHECK(found.cost == 15);
    one.ready = 9;  // it comes at 11 and would work until 14
    CHECK(one.run(found) == SearchEnd::proven_none);
}

TEST_CASE("a robot whose work has to wait leaves and comes back if others pass") {
    FoundTrack found;
    Case one{test::corridor_with_bay(), BookingTable(4), {0, false}, 0, {1, 0}, {2, 0}};
    one.table.book(1, {3, 5}, 9);  // and goes on to the home
    one.table.book(0, {5, 8}, 9);
    one.earliest = {6, 0};
    one.latest = {never, never};
    REQUIRE(one.run(found) == SearchEnd::found);
    CHECK(found.vertices[2] >= 2);               // one of the two other vertices
    CHECK(found.enter == Ticks{0, 1, 2, 5, 9});  // works from 6 to 8
}

TEST_CASE("a robot that ends anywhere completes with its last work, and then makes room") {
    FoundTrack found;
    Case one{test::corridor(), BookingTable(4), {0, false}, 0, {2, none}, {1, 0}};
    one.earliest = {0, 0};
    one.latest = {never, never};
    REQUIRE(one.run(found) == SearchEnd::found);
    CHECK(found.vertices == Vertices{0, 1, 2});
    CHECK(found.cost == 3);
    one.table.book(2, {5, never}, 9);
    REQUIRE(one.run(found) == SearchEnd::found);
    CHECK(found.vertices.size() == 4);
    CHECK(found.cost == 3);
}

TEST_CASE("one object serves many searches") {
    const test::Roads roads = test::corridor_with_bay();
    const std::vector<std::int32_t> classes(roads.heads.size(), 0);
    const std::vector<std::int32_t> pace{1};
    const auto table = roads.table(2);
    const Vertices stage{2};
    const Ticks nothing{0};
    const Trip trip{0, stage, nothing, nothing, pace, {}, {}, {}, {{table.data(), 1}}};
    SafeIntervalSearch search({roads.graph(), classes}, {0, false});
    BookingTable bookings(4);
    for (Tick k = 0; k < 1500; ++k) {  // the table of states has to grow on the way
        bookings.book(2, {2 * k + 2, 2 * k + 3}, 5);
        REQUIRE(search.run({trip, bookings}, test::no_deadline) == SearchEnd::found);
        CHECK(search.completion() == 2 * k + 3);
    }
}

// A ring of places, of which every second one is taken at every second time.
TEST_CASE("where somebody else comes to the end late, the search does not look at all until then") {
    constexpr VertexId n = 40;
    std::vector<EdgeId> indptr{0};
    Vertices heads;
    for (VertexId v = 0; v < n; ++v) {
        heads.insert(heads.end(), {(v + n - 1) % n, (v + 1) % n});
        indptr.push_back(static_cast<EdgeId>(heads.size()));
    }
    const std::vector<std::int32_t> classes(heads.size(), 0);
    const std::vector<std::int32_t> pace{1};
    std::vector<std::int32_t> table;
    for (VertexId v = 0; v < n; ++v) {
        table.push_back(std::min(v < 5 ? 5 - v : v - 5, v < 5 ? n - 5 + v : n + 5 - v));
    }
    const Vertices stage{5};
    const Ticks nothing{0};
    const Trip trip{0, stage, nothing, nothing, pace, {}, {}, {}, {{table.data(), 1}}};
    SafeIntervalSearch search({{indptr, heads}, classes}, {0, false});
    BookingTable bookings(n);
    for (Tick k = 10; k < 100; ++k) {
        for (VertexId v = 10; v < n; v += 2) {
            bookings.book(v, {4 * k, 4 * k + 2}, v);
        }
    }
    bookings.book(5, {398, 400}, 50);
    REQUIRE(search.run({trip, bookings}, test::no_deadline) == SearchEnd::found);
    CHECK(search.completion() == 400);
    CHECK(search.n_expanded() < 20);
    const std::int64_t before = search.n_expanded();
    CHECK(search.run({trip, bookings, {}, 399}, test::no_deadline) == SearchEnd::proven_none);
    CHECK(search.n_expanded() == before);
}

TEST_CASE("arrays that do not fit together are refused") {
    FoundTrack found;
    const Case far{test::corridor(), BookingTable(4), {0, false}, 7, {3}, {0}};
    CHECK_THROWS_AS(far.run(found), std::invalid_argument);
    const Case uneven{test::corridor(), BookingTable(4), {0, false}, 0, {3}, {0, 0}};
    CHECK_THROWS_AS(uneven.run(found), std::invalid_argument);
}

}  // namespace
}  // namespace rightofway

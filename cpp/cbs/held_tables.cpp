#include "cbs/held_tables.hpp"

#include <algorithm>
#include <iterator>

namespace rightofway {

// Calls `use` with each vertex at which a robot cannot be while it books a vertex.
template <class Use>
void HeldTables::for_each_left(const Constraint& hold, const Use& use) const {
    const Graph& roads = problem_.graph();
    const VertexId held = hold.held_row();
    for (VertexId vertex = 0; vertex < problem_.n_vertices(); ++vertex) {
        const bool is_near = problem_.rules().books_ahead &&
                             (roads.edge(vertex, held) >= 0 || roads.edge(held, vertex) >= 0);
        if (vertex != held && !is_near) {
            use(vertex);
        }
    }
}

void HeldTables::insert(const Constraint& hold, BookingTable& table) const {
    for_each_left(hold, [&](std::int32_t row) {
        table.insert(row, {hold.start, hold.end}, nobody);
    });
}

void HeldTables::erase(const Constraint& hold, BookingTable& table) const {
    for_each_left(hold, [&](std::int32_t row) { table.erase(row, hold.start, nobody); });
}

// Of equal starts in a row, a table erases the latest, and closures came first.
BookingTable& HeldTables::at(RobotId robot, std::span<const Constraint> holds) {
    Entry& entry = entry_of(robot);
    std::vector<Constraint> changed;  // first those to take out, then those to put in
    std::set_difference(entry.holds.begin(), entry.holds.end(), holds.begin(), holds.end(),
                        std::back_inserter(changed));
    for (const Constraint& hold : changed) {
        erase(hold, entry.table);
    }
    changed.clear();
    std::set_difference(holds.begin(), holds.end(), entry.holds.begin(), entry.holds.end(),
                        std::back_inserter(changed));
    for (const Constraint& hold : changed) {
        insert(hold, entry.table);
    }
    entry.holds.assign(holds.begin(), holds.end());
    return entry.table;
}

HeldTables::Entry& HeldTables::entry_of(RobotId robot) {
    auto entry = std::find_if(entries_.begin(), entries_.end(),
                              [&](const Entry& one) { return one.robot == robot; });
    if (entry == entries_.end() && entries_.size() < most_tables) {
        entry = entries_.insert(entry, {robot, {}, closed_, 0});
    } else if (entry == entries_.end()) {
        entry = std::min_element(
            entries_.begin(), entries_.end(),
            [](const Entry& left, const Entry& right) { return left.last_use < right.last_use; });
    }
    entry->robot = robot;
    entry->last_use = ++n_uses_;
    return *entry;
}

}  // namespace rightofway

#include "search/rotations.hpp"

namespace rightofway {
namespace {

struct Departure {
    RobotId robot = nobody;
    VertexId head = none;
};

class MovesOfInstant {
  public:
    MovesOfInstant(const Graph& graph, const BookingTable& table, std::int32_t first_row,
                   const InstantMove& move)
        : graph_(graph), table_(table), first_row_(first_row), move_(move) {}

    // A robot that leaves a vertex at the instant, and where it drives.
    Departure from(VertexId vertex) const {
        const auto here = table_.at(first_row_ + vertex);
        for (std::int32_t k = BookingTable::started(here, move_.tick - 1);
             k > 0 && here[index(k - 1)].reach >= move_.tick; --k) {
            const BookedBy& left = here[index(k - 1)];
            if (left.time.end == move_.tick && left.robot != nobody && left.robot != move_.robot) {
                for (const VertexId head : graph_.heads(vertex)) {
                    if (enters(left.robot, head)) {
                        return {left.robot, head};
                    }
                }
            }
        }
        return {};
    }

  private:
    bool enters(RobotId robot, VertexId vertex) const {
        const auto there = table_.at(first_row_ + vertex);
        for (std::int32_t k = BookingTable::started(there, move_.tick);
             k > 0 && there[index(k - 1)].time.start == move_.tick; --k) {
            if (there[index(k - 1)].robot == robot) {
                return true;
            }
        }
        return false;
    }

    const Graph& graph_;
    const BookingTable& table_;
    std::int32_t first_row_;
    const InstantMove& move_;
};

}  // namespace

RobotId find_rotation_ahead(const Graph& graph, const BookingTable& table, std::int32_t first_row,
                            const InstantMove& move) {
    const MovesOfInstant moves(graph, table, first_row, move);
    const Departure first = moves.from(move.head);
    if (first.robot == nobody || first.head == move.tail) {
        return nobody;  // nobody leaves the head, or it is a swap
    }
    // Overlaps may lead round a circle without the tail: the number of steps is bounded.
    VertexId at = first.head;
    for (VertexId n = 0; n < graph.n_vertices(); ++n) {
        const Departure next = moves.from(at);
        if (next.robot == nobody) {
            return nobody;
        }
        if (next.head == move.tail) {
            return first.robot;
        }
        at = next.head;
    }
    return nobody;
}

}  // namespace rightofway

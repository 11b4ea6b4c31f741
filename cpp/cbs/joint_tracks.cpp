#include "cbs/joint_tracks.hpp"

#include <algorithm>

namespace rightofway {
namespace {

std::uint64_t mixed(std::uint64_t hash, std::int64_t part) {
    hash = (hash ^ static_cast<std::uint64_t>(part)) * 0x9E3779B97F4A7C15U;
    return hash ^ (hash >> 29);
}

// Whether two phases that overlap in time may not be in one plan.
bool exclude(const Problem& problem, const TrackGraph::Phase& left,
             const TrackGraph::Phase& right) {
    for (const std::int32_t row : left.row) {
        if (row < 0) {
            continue;
        }
        for (const std::int32_t other : right.row) {
            if (other < 0) {
                continue;
            }
            if (!problem.has_sizes()) {
                if (row == other) {
                    return true;
                }
                continue;
            }
            const auto excluded = problem.excluded(row);
            if (std::find(excluded.begin(), excluded.end(), other) != excluded.end()) {
                return true;
            }
        }
    }
    return left.tail >= 0 && left.end == right.end && left.tail == right.head &&
           left.head == right.tail;  // a swap
}

}  // namespace

// What one build needs.
class TrackGraph::Builder {
  public:
    Builder(TrackGraph& graph, const Problem& problem, const SearchRequest& request, RobotId robot,
            SafeIntervalSearch& search)
        : graph_(graph),
          problem_(problem),
          request_(request),
          trip_(request.trip),
          robot_(robot),
          search_(search) {
        search_.measure(trip_);
    }

    // Makes the phases with which a visit begins: the last visit, drives at once, and stays, each
    // with the drives after it.
    void expand(std::int32_t number) {
        const Arrival visit = graph_.visits_[index(number)];
        auto& drives = graph_.drives_;  // by start
        drives.clear();
        const Graph& roads = problem_.graph();
        for (EdgeId edge = roads.indptr[index(visit.vertex)];
             edge < roads.indptr[index(visit.vertex + 1)]; ++edge) {
            add_drives(visit, edge);
        }
        std::sort(drives.begin(), drives.end());
        const auto first_phase = static_cast<std::int32_t>(graph_.phases_.size());
        add_last_visit(visit);
        for (auto one = drives.begin(); one != drives.end();) {
            const Tick start = one->first;
            if (start == visit.enter) {
                ++one;
                continue;
            }
            const std::size_t first = graph_.numbers_.size();
            for (; one != drives.end() && one->first == start; ++one) {
                graph_.numbers_.push_back(one->second);
            }
            graph_.phases_.push_back({.start = visit.enter,
                                      .end = start,
                                      .row = {problem_.vertex_row(robot_, visit.vertex), -1, -1},
                                      .tail = none,
                                      .head = visit.vertex,
                                      .completion = -1,
                                      .after = add_list(first)});
        }
        const std::size_t first = graph_.numbers_.size();
        for (const auto& [start, phase] : drives) {
            if (start == visit.enter) {
                graph_.numbers_.push_back(phase);
            }
        }
        for (auto phase = first_phase; index(phase) < graph_.phases_.size(); ++phase) {
            graph_.numbers_.push_back(phase);
        }
        graph_.first_of_visit_[index(number)] = add_list(first);
    }

    bool is_free(std::int32_t resource, Tick start, Tick end) const {
        const auto here = request_.bookings.at(trip_.first_row + resource);
        const auto k = BookingTable::started(here, end - 1);
        return k == 0 || here[index(k - 1)].reach <= start;
    }

  private:
    void add_drives(const Arrival& visit, EdgeId edge) {
        const std::int32_t drive = problem_.drive(robot_, edge);
        if (drive < 0) {
            return;
        }
        const VertexId head = problem_.graph().indices[index(edge)];
        const Tick turn = trip_.turns.between(visit.edge, edge);
        const std::int32_t last_stage = stage_after(visit.stage, visit.vertex, never);
        for (Tick start = visit.enter + turn; start <= request_.latest; ++start) {
            const std::int32_t stage =
                stage_after(visit.stage, visit.vertex, start - turn - visit.enter);
            const Tick enter = start + drive;
            const Tick rest = search_.rest(head, edge, stage);
            const bool is_late = rest < 0 || enter + rest > request_.latest;
            if ((is_late && stage == last_stage) || !is_free(visit.vertex, visit.enter, enter)) {
                return;
            }
            if (is_late || !may_drive(edge, head, start, enter)) {
                continue;
            }
            const EdgeId heading = trip_.turns.take_time() ? edge : none;
            graph_.drives_.emplace_back(start, static_cast<std::int32_t>(graph_.phases_.size()));
            graph_.phases_.push_back({.start = start,
                                      .end = enter,
                                      .row = rows_of(visit.vertex, edge, head),
                                      .tail = visit.vertex,
                                      .head = head,
                                      .completion = -1,
                                      .after = graph_.visit({enter, head, heading, stage, drive})});
        }
    }

    void add_last_visit(const Arrival& visit) {
        if (index(visit.stage) < trip_.first_stage_at_end() ||
            visit.vertex != trip_.stage_vertex.back() ||
            !is_free(visit.vertex, visit.enter, never)) {
            return;
        }
        Tick completion = visit.enter;
        for (auto stage = index(visit.stage); stage < trip_.n_stages(); ++stage) {
            completion += trip_.stage_work[stage];
        }
        const Tick booked = visit.enter - problem_.approach(visit.drive);
        if (completion < request_.ends_from || completion > request_.latest ||
            booked < request_.stays_from) {
            return;
        }
        graph_.phases_.push_back({.start = visit.enter,
                                  .end = never,
                                  .row = {problem_.vertex_row(robot_, visit.vertex), -1, -1},
                                  .tail = none,
                                  .head = visit.vertex,
                                  .completion = completion});
    }

    std::int32_t add_list(std::size_t first) {
        graph_.lists_.emplace_back(first, graph_.numbers_.size());
        return static_cast<std::int32_t>(graph_.lists_.size()) - 1;
    }

    std::int32_t stage_after(std::int32_t stage, VertexId vertex, Tick spare) const {
        return static_cast<std::int32_t>(trip_.stage_after(index(stage), vertex, spare));
    }

    bool may_drive(EdgeId edge, VertexId head, Tick start, Tick enter) const {
        const std::int32_t resource = problem_.n_vertices() + edge;
        return (!problem_.rules().books_ahead || is_free(head, start, enter)) &&
               (request_.bookings.n_rows() <= problem_.n_vertices() ||
                is_free(resource, start, enter));
    }

    std::array<std::int32_t, 3> rows_of(VertexId tail, EdgeId edge, VertexId head) const {
        std::array<std::int32_t, 3> rows{problem_.vertex_row(robot_, tail), -1, -1};
        if (problem_.rules().books_ahead) {
            rows[1] = problem_.vertex_row(robot_, head);
        }
        if (problem_.has_sizes() && problem_.edges_exclude()) {
            rows[2] = problem_.edge_row(robot_, edge);
        }
        return rows;
    }

    TrackGraph& graph_;
    const Problem& problem_;
    const SearchRequest& request_;
    const Trip& trip_;
    RobotId robot_;
    SafeIntervalSearch& search_;
};

// The number of a visit, which is new or known.
std::int32_t TrackGraph::visit(const Arrival& arrival) {
    std::uint64_t hash = 0;
    for (const std::int64_t part : {arrival.enter, Tick{arrival.vertex}, Tick{arrival.edge},
                                    Tick{arrival.stage}, Tick{arrival.drive}}) {
        hash = mixed(hash, part);
    }
    const auto fresh = static_cast<std::int32_t>(visits_.size());
    const std::int32_t number = known_.find_or_add(
        hash, fresh, [&](std::int32_t other) { return visits_[index(other)] == arrival; });
    if (number == fresh) {
        visits_.push_back(arrival);
        first_of_visit_.push_back(none);
    }
    return number;
}

bool TrackGraph::build(const Problem& problem, const SearchRequest& request, RobotId robot,
                       SafeIntervalSearch& search, std::size_t most_phases) {
    phases_.clear();
    visits_.clear();
    first_of_visit_.clear();
    lists_.clear();
    numbers_.clear();
    known_.clear();
    Builder builder(*this, problem, request, robot, search);
    visit({0, request.trip.home, none, 0, 0});
    // A visit is expanded after it was reached; visits only grow in number.
    for (std::int32_t number = 0; index(number) < visits_.size(); ++number) {
        builder.expand(number);
        if (phases_.size() > most_phases) {
            return false;
        }
    }
    return true;
}

bool JointTracks::search(const Problem& problem, const TrackGraph& first, const TrackGraph& second,
                         bool any, std::size_t most_pairs, const StopCondition& is_over) {
    constexpr std::size_t pairs_between_questions = 4096;
    completions_.clear();
    pairs_.clear();
    open_.clear();
    known_.clear();
    const auto reach = [&](std::int32_t left, std::int32_t right) {
        const TrackGraph::Phase& one = first.at(left);
        const TrackGraph::Phase& other = second.at(right);
        const bool overlap = one.start < other.end && other.start < one.end;
        if (overlap && exclude(problem, one, other)) {
            return;
        }
        const auto fresh = static_cast<std::int32_t>(pairs_.size());
        const std::int32_t number = known_.find_or_add(
            mixed(mixed(0, left), right), fresh,
            [&](std::int32_t known) { return pairs_[index(known)] == std::pair(left, right); });
        if (number == fresh) {
            pairs_.emplace_back(left, right);
            open_.push_back(number);
        }
    };
    for (const std::int32_t left : first.first()) {
        for (const std::int32_t right : second.first()) {
            reach(left, right);
        }
    }
    for (std::size_t step = 1; !open_.empty(); ++step) {
        if (pairs_.size() > most_pairs) {
            return false;
        }
        if (step % pairs_between_questions == 0 && is_over()) {
            throw Stopped{};
        }
        const auto [left, right] = pairs_[index(open_.back())];
        open_.pop_back();
        const TrackGraph::Phase& one = first.at(left);
        const TrackGraph::Phase& other = second.at(right);
        if (one.end >= never && other.end >= never) {
            completions_.push_back({one.completion, other.completion});
            if (any) {
                return true;
            }
        } else if (one.end <= other.end) {
            for (const std::int32_t next : first.next(left)) {
                reach(next, right);
            }
        } else {
            for (const std::int32_t next : second.next(right)) {
                reach(left, next);
            }
        }
    }
    std::sort(completions_.begin(), completions_.end());
    completions_.erase(std::unique(completions_.begin(), completions_.end()), completions_.end());
    return true;
}

}  // namespace rightofway

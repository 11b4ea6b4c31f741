#include "precedence/retiming.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace rightofway {
namespace {

// What a visit waits for: the robot's own visit before, and the leave of another at this vertex.
struct Waits {
    Tick own;       // least ticks from the visit before; unused for a first visit
    VisitId other;  // its enter is that leave
    Tick gap;
};

// Each stage but the last is served in the first visit to its vertex that lasts long enough.
void set_own(const Trips& trips, const Tracks& tracks, RobotId robot, std::vector<Waits>& waits) {
    std::int32_t stage = trips.first_stage[robot];
    const VisitId end = tracks.first_visit[robot + 1];
    for (VisitId x = tracks.first_visit[robot] + 1; x < end; ++x) {
        const Tick drive =
            trips.drive(robot, trips.graph.edge(tracks.vertex[x - 1], tracks.vertex[x]));
        Tick least = drive;
        while (!trips.is_last(robot, stage) && trips.stage_vertex[stage] == tracks.vertex[x - 1] &&
               least + trips.stage_dwell[stage] <= tracks.enter[x] - tracks.enter[x - 1]) {
            least += trips.stage_dwell[stage++];
        }
        waits[x] = {least, none, trips.gap(drive)};
    }
}

void set_others(const Trips& trips, const Tracks& tracks, std::span<const VisitId> in_order,
                std::vector<Waits>& waits) {
    std::vector<RobotId> robot(tracks.vertex.size());
    for (RobotId r = 0; r < trips.n_robots(); ++r) {
        std::fill(robot.begin() + tracks.first_visit[r], robot.begin() + tracks.first_visit[r + 1],
                  r);
    }
    std::vector<VisitId> last(static_cast<std::size_t>(trips.graph.n_vertices()), none);
    for (const VisitId x : in_order) {
        VisitId& before = last[tracks.vertex[x]];
        if (before != none && robot[before] != robot[x]) {
            waits[x].other = before + 1;
        }
        before = x;
    }
}

// What the robots of a fleet have to do, as trips.
class TripsOf {
  public:
    explicit TripsOf(const Problem& fleet) : roads_(fleet.roads()), rules_(fleet.rules()) {
        for (RobotId robot = 0; robot < fleet.n_robots(); ++robot) {
            const auto pace = fleet.pace(robot);
            const auto stages = fleet.stages(robot);
            home_.push_back(fleet.home(robot));
            class_ticks_.insert(class_ticks_.end(), pace.begin(), pace.end());
            stage_vertex_.insert(stage_vertex_.end(), stages.begin(), stages.end());
            for (std::size_t k = 0; k < stages.size(); ++k) {
                stage_dwell_.push_back(fleet.works(robot)[k] + fleet.turns(robot)[k]);
            }
            first_stage_.push_back(static_cast<std::int32_t>(stage_vertex_.size()));
        }
    }

    Trips view() const {
        const bool may_rotate = rules_.headway == 0 && !rules_.books_ahead;
        return {roads_.graph,       roads_.length_class, home_,        first_stage_,
                stage_vertex_,      stage_dwell_,        class_ticks_, rules_.headway,
                rules_.books_ahead, may_rotate};
    }

  private:
    Roads roads_;
    BookingRules rules_;
    std::vector<VertexId> home_;
    std::vector<std::int32_t> first_stage_{0};
    std::vector<VertexId> stage_vertex_;
    std::vector<Tick> stage_dwell_;
    std::vector<std::int32_t> class_ticks_;
};

}  // namespace

void retime(const Trips& trips, Tracks& tracks) {
    if (tracks.vertex.empty()) {
        return;
    }
    std::vector<Waits> waits(tracks.vertex.size(), {0, none, 0});
    for (RobotId r = 0; r < trips.n_robots(); ++r) {
        set_own(trips, tracks, r, waits);
    }
    std::vector<VisitId> in_order(tracks.vertex.size());
    std::iota(in_order.begin(), in_order.end(), 0);
    std::sort(in_order.begin(), in_order.end(), [&](VisitId left, VisitId right) {
        return tracks.enter[left] != tracks.enter[right] ? tracks.enter[left] < tracks.enter[right]
                                                         : left < right;
    });
    set_others(trips, tracks, in_order, waits);
    std::vector<Tick> earliest(tracks.enter.size(), 0);
    const auto push = [&](VisitId x) {
        const Waits& wait = waits[x];
        Tick enter = wait.own > 0 ? earliest[x - 1] + wait.own : 0;
        if (wait.other != none) {
            enter = std::max(enter, earliest[wait.other] + wait.gap);
        }
        const bool is_raised = enter > earliest[x];
        earliest[x] = std::max(earliest[x], enter);
        return is_raised;
    };
    for (std::size_t first = 0, end = 0; first < in_order.size(); first = end) {
        const Tick instant = tracks.enter[in_order[first]];
        while (end < in_order.size() && tracks.enter[in_order[end]] == instant) {
            ++end;
        }
        bool has_changed = true;
        while (has_changed) {
            has_changed = false;
            for (std::size_t k = first; k < end; ++k) {
                has_changed = push(in_order[k]) || has_changed;
            }
        }
    }
    tracks.enter = std::move(earliest);
}

void retime(const Problem& fleet, FleetPlan& plan) {
    Tracks tracks = plan.tracks();
    retime(TripsOf(fleet).view(), tracks);
    TripReader reader(fleet);
    FleetPlan retimed(fleet);
    for (RobotId robot = 0; robot < fleet.n_robots(); ++robot) {
        TimedTrack track = plan.track(robot);
        for (std::size_t k = 0; k < track.visits.size(); ++k) {
            track.visits[k].enter = tracks.enter[tracks.first_visit[robot] + k];
        }
        track.completion = reader.completion(robot, track.visits);
        retimed.exchange(robot, track);
    }
    plan = std::move(retimed);
}

}  // namespace rightofway

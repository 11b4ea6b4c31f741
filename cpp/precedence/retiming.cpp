#include "precedence/retiming.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "core/types.hpp"

namespace rightofway {
namespace {

// The latest end of the bookings that exclude a row, and the latest of any other robot.
struct LatestEnd {
    Tick end = 0;
    Tick end_of_others = 0;
    RobotId robot = nobody;

    Tick before(RobotId own) const { return robot == own ? end_of_others : end; }

    void add(RobotId own, Tick ends) {
        if (robot == own) {
            end = std::max(end, ends);
        } else if (ends > end) {
            *this = {ends, end, own};
        } else {
            end_of_others = std::max(end_of_others, ends);
        }
    }
};

struct Drive {
    Tick start;
    VisitId visit;  // that it leads to
    RobotId robot;
};

// Sorts drives by their starts, those of one start as before: by counting, from the last digits to
// the first.
void sort_by_start(std::vector<Drive>& drives, Poll& poll) {
    constexpr int bits = 11;
    constexpr std::size_t n_digits = std::size_t{1} << bits;
    Tick latest = 0;
    for (const Drive& drive : drives) {
        latest = std::max(latest, drive.start);
    }
    std::vector<Drive> sorted(drives.size());
    for (int shift = 0; shift < std::numeric_limits<Tick>::digits && latest >> shift > 0;
         shift += bits) {
        const auto digit = [shift](const Drive& drive) {
            return static_cast<std::size_t>(drive.start >> shift) % n_digits;
        };
        std::array<std::size_t, n_digits + 1> place{};
        for (const Drive& drive : drives) {
            ++place[digit(drive) + 1];
        }
        std::partial_sum(place.begin(), place.end(), place.begin());
        for (const Drive& drive : drives) {
            poll();
            sorted[place[digit(drive)]++] = drive;
        }
        drives.swap(sorted);
    }
}

class Retiming {
  public:
    Retiming(const Problem& problem, Tracks& tracks, Poll& poll)
        : problem_(problem),
          tracks_(tracks),
          poll_(poll),
          ways_(tracks.vertex.size()),
          latest_(static_cast<std::size_t>(problem.n_rows())) {
        drives_.reserve(tracks.vertex.size());
        for (RobotId robot = 0; robot < problem.n_robots(); ++robot) {
            measure(robot);
        }
        sort_by_start(drives_, poll_);
    }

    // A visit begins when its robot is ready and all earlier bookings of other robots that exclude
    // it are over. In the order in which drives start these are known, because the robot that ends
    // a booking started to drive off earlier. Where robots may follow each other at one instant,
    // it can start at the same tick: such drives are repeated until no time changes. Times only
    // rise in these rounds, so the last ones are the least.
    void run() {
        for (std::size_t first = 0, end = 0; first < drives_.size(); first = end) {
            while (end < drives_.size() && drives_[end].start == drives_[first].start) {
                ++end;
            }
            bool has_changed = true;
            while (has_changed) {
                has_changed = false;
                for (std::size_t k = first; k < end; ++k) {
                    poll_();
                    has_changed |= shift(drives_[k]);
                }
                has_changed &= problem_.may_follow() && end - first > 1;
            }
        }
    }

  private:
    struct Way {  // from a visit to the next one
        EdgeId edge = -1;
        Tick least = 1;  // from enter to enter
        Tick approach = 0;
        std::size_t first_stage = 0;  // served by the visit, if stages have times
        std::size_t end_stage = 0;    // exclusive
    };

    void measure(RobotId robot) {
        const Itinerary itinerary = problem_.itinerary(robot);
        std::size_t stage = 0;
        EdgeId before = -1;
        const VisitId last = tracks_.first_visit[index(robot + 1)] - 1;
        for (VisitId x = tracks_.first_visit[index(robot)]; x < last; ++x) {
            poll_();
            Way& way = ways_[index(x)];
            way.edge = problem_.graph().edge(vertex(x), vertex(x + 1));
            const Tick drive = problem_.drive(robot, way.edge);
            way.least = drive + itinerary.turns.between(before, way.edge);
            way.approach = problem_.approach(drive);
            before = way.edge;
            const std::size_t end =
                itinerary.stage_after(stage, vertex(x), enter(x), enter(x + 1) - way.least);
            if (problem_.has_times()) {
                way.first_stage = std::exchange(stage, end);
                way.end_stage = end;
            }
            for (; stage < end; ++stage) {
                way.least += itinerary.stage_work[stage] + itinerary.stage_turn[stage];
            }
            drives_.push_back({enter(x + 1) - way.approach, x + 1, robot});
        }
    }

    // Moves the end of a drive to the earliest time; returns whether it has changed.
    bool shift(const Drive& drive) {
        const VisitId x = drive.visit;
        const Way& way = ways_[index(x - 1)];
        const std::array rows = {problem_.vertex_row(drive.robot, vertex(x)),
                                 problem_.vertex_row(drive.robot, vertex(x - 1)),
                                 problem_.edge_row(drive.robot, way.edge)};
        const std::size_t n_rows = problem_.books_edges() ? 3 : 2;
        Tick soonest = (problem_.has_times() ? serve(drive) : enter(x - 1)) + way.least;
        for (std::size_t k = 0; k < n_rows; k += 2) {
            soonest = std::max(soonest, latest_[index(rows[k])].before(drive.robot) + way.approach);
        }
        const bool has_changed = soonest != tracks_.enter[index(x)];
        tracks_.enter[index(x)] = soonest;
        for (std::size_t k = 1; k < n_rows; ++k) {
            for (const std::int32_t mark : problem_.excluded(rows[k])) {
                latest_[index(mark)].add(drive.robot, soonest + problem_.rules().headway);
            }
        }
        return has_changed;
    }

    // When the visit before a drive has served its stages and turned for that, where stages have
    // times.
    Tick serve(const Drive& drive) const {
        const Itinerary itinerary = problem_.itinerary(drive.robot);
        const Way& way = ways_[index(drive.visit - 1)];
        Tick now = std::max(enter(drive.visit - 1), itinerary.times.ready);
        for (std::size_t stage = way.first_stage; stage < way.end_stage; ++stage) {
            now = itinerary.end_of(stage, now);
        }
        return way.first_stage == way.end_stage ? now
                                                : now + itinerary.stage_turn[way.end_stage - 1];
    }

    VertexId vertex(VisitId visit) const { return tracks_.vertex[index(visit)]; }
    Tick enter(VisitId visit) const { return tracks_.enter[index(visit)]; }

    const Problem& problem_;
    Tracks& tracks_;
    Poll& poll_;
    std::vector<Way> ways_;          // of each visit
    std::vector<Drive> drives_;      // by their starts, then by their visits
    std::vector<LatestEnd> latest_;  // of each row
};

}  // namespace

void retime(const Problem& problem, Tracks& tracks, const StopCondition& interrupt) {
    Poll poll(interrupt);
    Retiming(problem, tracks, poll).run();
}

}  // namespace rightofway

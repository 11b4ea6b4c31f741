// The tour of one robot: its stops in order, their times, and the cost of a change.
//
// Insertions are evaluated in constant time per position, without battery exactly. Up to each gap
// the tour keeps when the robot leaves, its load and its cost so far; from each gap on, as
// functions of the arrival, the latest feasible one, the completion and the cost of service. Where
// stops neither wait nor are late, these functions have one piece.
//
// Vidal, Crainic, Gendreau & Prins, "A unified solution framework for multi-attribute vehicle
// routing problems", European Journal of Operational Research 2014 (concatenation of segments);
// Savelsbergh, "The vehicle routing problem with time windows: minimizing route duration", ORSA
// Journal on Computing 1992 (forward slack).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/types.hpp"
#include "tours/charging.hpp"
#include "tours/tour_problem.hpp"

namespace rightofway {

class Tour {
  public:
    Tour(const TourProblem& problem, RobotId robot) : problem_(&problem), robot_(robot) {}

    RobotId robot() const { return robot_; }
    std::size_t size() const { return stops_.size(); }
    bool is_empty() const { return stops_.empty(); }
    std::span<const std::int32_t> stops() const { return stops_; }
    std::vector<std::int32_t>& edit() { return stops_; }  // call `schedule` afterwards

    // Computes all times. `releases`: ticks before which the jobs must not begin. False if a load,
    // `latest` or the battery does not allow the tour; an empty tour is always allowed.
    bool schedule(std::span<const Tick> releases, ChargePlanner& charges);
    // Computes what a change would cost. `limits`: ticks after which jobs must not end.
    void prepare(std::span<const Tick> releases, std::span<const Tick> limits);

    // With charges:
    Tick completion() const { return times_.completion; }
    std::int64_t service() const { return times_.service; }
    const TourTimes& times() const { return times_; }

    // Without charges, up to gap k: before stop k, or before the end.
    Tick leave(std::size_t gap) const { return leave_[gap]; }
    std::int32_t load(std::size_t gap) const { return load_[gap]; }
    std::int64_t service_before(std::size_t gap) const { return service_before_[gap]; }
    std::int32_t place_before(std::size_t gap) const {
        return gap == 0 ? problem_->robot(robot_).start : problem_->stop(stops_[gap - 1]).place;
    }
    // Where the robot drives after gap k: to itself if it rests there.
    std::int32_t place_after(std::size_t gap, std::int32_t at) const {
        if (gap < stops_.size()) {
            return problem_->stop(stops_[gap]).place;
        }
        const std::int32_t end = problem_->robot(robot_).end;
        return end < 0 ? at : end;
    }
    Tick earliest(std::size_t stop) const { return earliest_[stop]; }

    // Without charges, from gap k on, if the robot arrives after it at this tick:
    Tick latest(std::size_t gap) const { return latest_[gap]; }
    Tick completion_from(std::size_t gap, Tick arrival) const {
        return std::max(floor_[gap], arrival + rest_[gap]);
    }
    std::int64_t service_from(std::size_t gap, Tick arrival) const;
    // The least completion and service without charges.
    Tick bare_completion() const { return bare_completion_; }
    std::int64_t bare_service() const { return service_before_.back(); }

  private:
    struct Piece {  // of a function of the arrival, from this tick on
        Tick from;
        std::int64_t value;
        std::int64_t slope;
    };

    bool has_battery() const { return problem_->robot(robot_).battery >= 0; }
    void find_earliest(std::span<const Tick> releases);
    bool drive_all();
    void prepare_service(std::size_t gap, Tick drive);
    std::span<const Piece> pieces(std::size_t gap) const {
        return {pieces_.data() + first_piece_[gap], last_piece_[gap] - first_piece_[gap]};
    }

    const TourProblem* problem_;
    RobotId robot_;
    std::vector<std::int32_t> stops_;
    TourTimes times_;
    std::vector<Tick> earliest_;
    std::vector<Tick> leave_;
    std::vector<std::int32_t> load_;
    std::vector<std::int64_t> service_before_;
    Tick bare_completion_ = 0;
    std::vector<Tick> latest_;
    std::vector<Tick> floor_;
    std::vector<Tick> rest_;
    std::vector<Piece> pieces_;
    std::vector<std::size_t> first_piece_;
    std::vector<std::size_t> last_piece_;
};

}  // namespace rightofway

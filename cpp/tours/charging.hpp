// Charges in the tour of a robot with a battery: where, and for how long.
//
// The order of stops is given. Labels carry a time and a state of charge from stop to stop; each
// leg may lead over a charging place. The ticks of the last charge of a label stay open: they grow
// when the charge turns out to be needed later, and over waiting, which costs no time. All charging
// places of a robot fill at one rate, so charging longer than needed before the next charge never
// helps.
//
// Froger, Mendoza, Jabali & Laporte, "Improved formulations and algorithmic components for the
// electric vehicle routing problem with nonlinear charging functions", Computers & Operations
// Research 2019 (labels with open charges, for a fixed order of stops).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/types.hpp"
#include "tours/tour_problem.hpp"

namespace rightofway {

struct TourCharge {
    std::int32_t gap;  // before the stop of this index in the tour
    std::int32_t place;
    Tick begin;
    Tick ticks;
};

// When each stop of a tour begins and ends, and what that costs.
struct TourTimes {
    std::vector<Tick> begin;
    std::vector<Tick> end;
    std::vector<TourCharge> charges;
    Tick completion = 0;
    std::int64_t service = 0;
};

class ChargePlanner {
  public:
    explicit ChargePlanner(const TourProblem& problem) : problem_(problem) {}

    // Computes early times of a tour, with charges where the battery needs them. `releases`: ticks
    // before which the jobs must not begin. False if none were found; keeps `latest` and the soc.
    bool plan(RobotId robot, std::span<const std::int32_t> stops, std::span<const Tick> releases,
              TourTimes& times);

  private:
    // Just before a leg: the robot is at a place at time t with a state of charge.
    struct Label {
        Tick t = 0;
        std::int64_t soc = 0;
        std::int64_t room = 0;  // what its last charge could still add
        Tick slack = never;     // by how much the last charge may grow, for `latest`
        Tick ticks = 0;         // of the last charge
        double cost = 0;
        double slope = 0;            // what one more tick of the last charge costs
        std::int32_t charging = -1;  // the place of the last charge, -1: none yet
        std::int32_t gap = 0;
        std::int32_t parent = -1;  // index in `past_`: the label before the last charge
        bool is_low = false;       // below the reserve since `ready`: it has to charge first
    };

    bool drive(Label& label, std::int32_t from, std::int32_t to) const;
    bool serve(Label& label, std::int32_t stop, bool fills_waiting) const;
    bool must_wait(const Label& label, std::int32_t stop) const;
    Tick earliest(std::int32_t stop) const;
    bool rest(Label& label, std::int32_t place) const;
    bool reach(Label& label, std::int64_t soc) const;
    void grow(Label& label, Tick ticks) const;
    void forget_empty_charge(Label& label) const;
    bool begin_charge(Label& label, std::int32_t place, std::int32_t gap);
    void choose_places(std::int32_t from, std::int32_t to);
    void leave(const Label& label, std::int32_t gap, std::int32_t from, std::int32_t to);
    void keep(const Label& label, std::vector<Label>& labels) const;
    void end_tour(const Label& label, std::int32_t from);
    bool is_quick(TourTimes& times);
    bool time(const Label& last, TourTimes& times) const;
    std::int32_t place_before(std::size_t gap) const;
    double rank(const Label& label) const { return label.cost + weight_left_ * double(label.t); }
    std::int64_t potential(const Label& label) const;

    const TourProblem& problem_;
    const TourRobot* robot_ = nullptr;
    const TourBattery* battery_ = nullptr;
    std::span<const std::int32_t> stops_;
    std::span<const Tick> releases_;
    double weight_left_ = 1;  // of the jobs whose last stop is ahead
    std::vector<Label> labels_;
    std::vector<Label> arrived_;
    std::vector<Label> ended_;
    std::vector<Label> past_;
    std::vector<std::int32_t> places_;
};

}  // namespace rightofway

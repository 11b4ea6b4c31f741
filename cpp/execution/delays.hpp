// What goes otherwise than planned in one run on the floor: random delays, robots that stand still.
//
// Every robot has a pace (1 as planned, 1.5 half as slow again), every stay and drive is lengthened
// at random, and at some moments robots stand still, for a while or for ever. Durations are whole
// ticks; what is left over of a tick is carried to the robot's next duration, and the first carry
// is random, so that nothing is lost on average.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/random.hpp"
#include "execution/adg.hpp"

namespace rightofway {

// Where a and b stand for:
enum class DelayKind : std::int32_t {
    exponential,  // mean a, as a part of the visit's time
    uniform,      // between the parts a and b of it
    normal,       // mean a, standard deviation b, as parts of it
    stops,        // with chance a, a stop of b ticks
    breaks,       // with chance a, once in the plan, for ever
};

struct Delay {
    DelayKind kind;
    double a;
    double b;
};

// A robot does nothing for some ticks, from a tick on; for ever if they are `never`.
struct Stoppage {
    Tick tick;
    Tick ticks;
};

// What one run meets; reused from run to run.
struct DelaySample {
    std::vector<Tick> dwell;                     // of each visit, at least 0
    std::vector<Tick> drive;                     // into each visit, at least 1 where one is driven
    std::vector<std::int32_t> first_standstill;  // robots + 1
    std::vector<Stoppage> standstills;           // of each robot, by tick; none overlap
};

class Delays {
  public:
    // `pace` has one entry for each robot; `standstills` those that come in every run, as
    // Setbacks has them. Throws std::invalid_argument.
    Delays(const ActionDependencyGraph& plan, std::span<const double> pace,
           std::vector<Delay> delays, std::vector<std::int32_t> first_standstill,
           std::vector<Stoppage> standstills);

    // The same for the same seed and run, whatever was drawn before. What befalls the n-th visit of
    // a robot depends on n alone, not on where it is or what others do: who goes another way takes
    // his luck along.
    void draw(std::uint64_t seed, std::uint64_t run, DelaySample& out) const;

  private:
    void check(std::size_t n_robots) const;
    void draw_standstills(RobotId robot, Random& random, DelaySample& out) const;
    void draw_durations(RobotId robot, Random& random, DelaySample& out) const;
    std::pair<double, Tick> draw_visit(Random& random) const;

    const ActionDependencyGraph& plan_;
    std::vector<double> pace_;
    std::vector<Delay> delays_;
    std::vector<std::int32_t> first_standstill_;
    std::vector<Stoppage> standstills_;
    Tick makespan_ = 0;
};

}  // namespace rightofway

// Random delays and stoppages of one run.
//
// Every robot has a pace (1 as planned, 1.5 half as slow again), every stay and drive is lengthened
// at random, and robots stand still at some ticks, for a time or for ever. Durations are whole
// ticks; the rest of a tick is carried to the robot's next duration, and the first carry is random,
// so that durations are exact on average.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/random.hpp"
#include "execution/adg.hpp"

namespace rightofway {

// The meaning of a and b:
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

// A robot stands still from a tick on, for some ticks; for ever if they are `never`.
struct Stoppage {
    Tick tick;
    Tick ticks;
};

// The delays of one run; reused from run to run.
struct DelaySample {
    std::vector<Tick> dwell;                   // of each visit, at least 0
    std::vector<Tick> drive;                   // into each visit, at least 1 where one is driven
    std::vector<std::int32_t> first_stoppage;  // robots + 1
    std::vector<Stoppage> stoppages;           // of each robot, by tick; none overlap
};

// Throws std::invalid_argument unless robot r can own stoppages first[r] .. first[r + 1] - 1.
void require_stoppages(std::span<const std::int32_t> first, std::size_t n_robots,
                       std::size_t n_stoppages);

class Delays {
  public:
    // `pace` has one entry for each robot; `stoppages` are those of every run, as in DelaySample.
    // Throws std::invalid_argument.
    Delays(const ActionDependencyGraph& plan, std::span<const double> pace,
           std::vector<Delay> delays, std::vector<std::int32_t> first_stoppage,
           std::vector<Stoppage> stoppages);

    // Depends on the seed and the run alone. The delay of the n-th visit of a robot depends on n,
    // not on its vertex or on other robots: a robot on another route keeps its delays.
    void draw(std::uint64_t seed, std::uint64_t run, DelaySample& out) const;

  private:
    void draw_stoppages(RobotId robot, Random& random, DelaySample& out) const;
    void draw_durations(RobotId robot, Random& random, DelaySample& out) const;
    std::pair<double, Tick> draw_visit(Random& random) const;

    const ActionDependencyGraph& plan_;
    std::vector<double> pace_;
    std::vector<Delay> delays_;
    std::vector<std::int32_t> first_stoppage_;
    std::vector<Stoppage> stoppages_;
    Tick makespan_ = 0;
};

}  // namespace rightofway

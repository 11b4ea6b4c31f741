// The delay model of a fleet: draws random delays and stoppages, one delay sample per run.
//
// Every robot has a pace (1: as planned; 1.5: durations times 1.5), every stay and drive is
// lengthened at random, and robots stop at some ticks, for some time or for ever. Durations are
// whole ticks; the fraction of a tick is carried to the robot's next duration, and the first carry
// is random, so that durations are exact on average.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/random.hpp"
#include "execution/adg.hpp"

namespace rightofway {

// Distributions of a delay, with parameters a and b.
enum class DelayKind : std::int32_t {
    exponential,  // mean a, relative to the planned time
    uniform,      // from a to b, relative to the planned time
    normal,       // mean a, standard deviation b, relative to the planned time
    stops,        // per visit: with probability a, a stop of b ticks
    breaks,       // per robot: with probability a, a breakdown during the plan
};

struct Delay {
    DelayKind kind;
    double a;
    double b;
};

// A robot stands still from `tick` on for `ticks` ticks; `never`: a breakdown.
struct Stoppage {
    Tick tick;
    Tick ticks;
};

// The delays of one run; reused from run to run.
struct DelaySample {
    std::vector<Tick> dwell;                   // of each visit, at least 0
    std::vector<Tick> drive;                   // into each visit, at least 1; first visits: 0
    std::vector<std::int32_t> first_stoppage;  // robots + 1
    std::vector<Stoppage> stoppages;           // of each robot, by tick, without overlap
};

// Throws std::invalid_argument unless robot r can own stoppages first[r] .. first[r + 1] - 1, by
// tick, from tick 0 on.
void require_stoppages(std::span<const std::int32_t> first, std::size_t n_robots,
                       std::span<const Stoppage> stoppages);

class Delays {
  public:
    // `pace`: one entry per robot; `stoppages`: part of every run, arranged as in DelaySample.
    // Throws std::invalid_argument on an invalid argument.
    Delays(const ActionDependencyGraph& plan, std::span<const double> pace,
           std::vector<Delay> delays, std::vector<std::int32_t> first_stoppage,
           std::vector<Stoppage> stoppages);

    // Deterministic for a seed and a run. The delay of the n-th visit of a robot depends on n, not
    // on its vertex or on other robots: a robot on a new route keeps its delays.
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

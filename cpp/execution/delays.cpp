#include "execution/delays.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>

#include "core/reject.hpp"

namespace rightofway {
namespace {

constexpr std::uint64_t stream = 0xF1008;  // distinguishes the uses of a seed
constexpr double least_factor = 0.01;      // lower limit of actual / planned duration
constexpr double most_factor = 1e6;        // upper limit: no sum of durations overflows
constexpr Tick longest_stop = Tick{1} << 40;

void require_real(const char* name, std::size_t index, double value, double least, double most) {
    if (!(value >= least && value <= most)) {
        std::ostringstream text;
        text << name << '[' << index << "]: " << value << " is not in " << least << ".." << most;
        throw std::invalid_argument(text.str());
    }
}

void require_delay(const Delay& delay, std::size_t k) {
    const bool is_chance = delay.kind == DelayKind::stops || delay.kind == DelayKind::breaks;
    const bool is_stop = delay.kind == DelayKind::stops;
    const double most = is_stop ? static_cast<double>(longest_stop) : most_factor;
    const bool is_positive = is_stop || delay.kind == DelayKind::normal;
    require_real("delay_a", k, delay.a, is_chance ? 0 : -most_factor, is_chance ? 1 : most_factor);
    require_real("delay_b", k, delay.b, is_positive ? 0 : -most, most);
}

// In (0, 1], so that the logarithm is finite.
double unit(Random& random) { return (static_cast<double>(random.next() >> 11) + 1) * 0x1p-53; }

double exponential(Random& random, double mean) { return -mean * std::log(unit(random)); }

// Box and Muller, "A note on the generation of random normal deviates", 1958.
double normal(Random& random, double mean, double deviation) {
    const double radius = std::sqrt(-2 * std::log(unit(random)));
    return mean + deviation * radius * std::cos(2 * std::numbers::pi * unit(random));
}

// Merges stoppages that overlap.
void merge(std::vector<Stoppage>& stoppages, std::size_t first) {
    std::size_t end = first;
    for (std::size_t k = first; k < stoppages.size(); ++k) {
        const Stoppage next = stoppages[k];
        if (end == first || stoppages[end - 1].tick + stoppages[end - 1].ticks < next.tick) {
            stoppages[end++] = next;
            continue;
        }
        Stoppage& last = stoppages[end - 1];
        const Tick until = std::max(last.tick + last.ticks, next.tick + next.ticks);
        last.ticks = std::min(until - last.tick, never);
    }
    stoppages.resize(end, {});
}

// Rounds durations to whole ticks, carrying the remainder.
class Rounding {
  public:
    explicit Rounding(double carry) : carry_(carry) {}

    Tick lengthen(Tick ticks, double factor, Tick least) {
        carry_ += static_cast<double>(ticks) * (factor - 1);
        const Tick whole = std::max(static_cast<Tick>(std::floor(carry_)), least - ticks);
        carry_ -= static_cast<double>(whole);
        return ticks + whole;
    }

  private:
    double carry_;
};

}  // namespace

Delays::Delays(const ActionDependencyGraph& plan, std::span<const double> pace,
               std::vector<Delay> delays, std::vector<std::int32_t> first_stoppage,
               std::vector<Stoppage> stoppages)
    : plan_(plan),
      pace_(pace.begin(), pace.end()),
      delays_(std::move(delays)),
      first_stoppage_(std::move(first_stoppage)),
      stoppages_(std::move(stoppages)) {
    require_length("pace", pace_.size(), static_cast<std::size_t>(plan.n_robots()));
    for (std::size_t r = 0; r < pace_.size(); ++r) {
        require_real("pace", r, pace_[r], 0, most_factor);
    }
    for (std::size_t k = 0; k < delays_.size(); ++k) {
        require_delay(delays_[k], k);
    }
    require_stoppages(first_stoppage_, pace_.size(), stoppages_);
    for (RobotId r = 0; r < plan.n_robots(); ++r) {
        makespan_ = std::max(makespan_, plan.planned_completion(r));
    }
}

void require_stoppages(std::span<const std::int32_t> first, std::size_t n_robots,
                       std::span<const Stoppage> stoppages) {
    require_length("first_stoppage", first.size(), n_robots + 1);
    require_lists("first_stoppage", first, stoppages.size(), "stoppages");
    for (std::size_t k = 0; k < stoppages.size(); ++k) {
        require_range("stoppage_tick[" + std::to_string(k) + "]", stoppages[k].tick, 0, never - 1);
        require_range("stoppage_ticks[" + std::to_string(k) + "]", stoppages[k].ticks, 0, never);
    }
    for (std::size_t r = 0; r < n_robots; ++r) {
        for (auto k = index(first[r]) + 1; k < index(first[r + 1]); ++k) {
            if (stoppages[k].tick < stoppages[k - 1].tick) {
                reject_entry("stoppage_tick", k, stoppages[k].tick,
                             "is before the stoppage before it");
            }
        }
    }
}

void Delays::draw(std::uint64_t seed, std::uint64_t run, DelaySample& out) const {
    const auto n_visits = static_cast<std::size_t>(plan_.n_visits());
    out.dwell.resize(n_visits);
    out.drive.resize(n_visits);
    out.first_stoppage.assign(1, 0);
    out.stoppages.clear();
    for (RobotId r = 0; r < plan_.n_robots(); ++r) {
        Random random(seed, stream + (static_cast<std::uint64_t>(r) << 32), run);
        draw_stoppages(r, random, out);
        draw_durations(r, random, out);
    }
}

void Delays::draw_stoppages(RobotId robot, Random& random, DelaySample& out) const {
    const auto first = static_cast<std::ptrdiff_t>(out.stoppages.size());
    out.stoppages.insert(out.stoppages.end(), stoppages_.begin() + first_stoppage_[index(robot)],
                         stoppages_.begin() + first_stoppage_[index(robot + 1)]);
    for (const Delay& delay : delays_) {
        if (delay.kind == DelayKind::breaks && unit(random) <= delay.a) {
            const double share = unit(random);
            out.stoppages.push_back(
                {static_cast<Tick>(share * static_cast<double>(makespan_)), never});
        }
    }
    std::stable_sort(
        out.stoppages.begin() + first, out.stoppages.end(),
        [](const Stoppage& left, const Stoppage& right) { return left.tick < right.tick; });
    merge(out.stoppages, index(first));
    out.first_stoppage.push_back(static_cast<std::int32_t>(out.stoppages.size()));
}

void Delays::draw_durations(RobotId robot, Random& random, DelaySample& out) const {
    Rounding rounding(unit(random));
    for (VisitId x = plan_.first_of(robot); x <= plan_.last_of(robot); ++x) {
        const auto [more, stop] = draw_visit(random);
        const double factor =
            std::clamp(pace_[index(robot)] * (1 + more), least_factor, most_factor);
        const bool is_done = plan_.is_last(x) && plan_.dwell(x) == 0;
        out.dwell[index(x)] = rounding.lengthen(plan_.dwell(x), factor, 0) + (is_done ? 0 : stop);
        if (plan_.is_first(x)) {
            out.drive[index(x)] = 0;
        }
        if (!plan_.is_last(x)) {
            out.drive[index(x + 1)] = rounding.lengthen(plan_.drive(x + 1), factor, 1);
        }
    }
}

// The delay of a visit relative to its planned time, and the ticks of additional stops.
std::pair<double, Tick> Delays::draw_visit(Random& random) const {
    double more = 0;
    Tick stop = 0;
    for (const Delay& delay : delays_) {
        switch (delay.kind) {
            case DelayKind::exponential:
                more += exponential(random, delay.a);
                break;
            case DelayKind::uniform:
                more += delay.a + (delay.b - delay.a) * unit(random);
                break;
            case DelayKind::normal:
                more += normal(random, delay.a, delay.b);
                break;
            case DelayKind::stops:
                stop += unit(random) <= delay.a ? static_cast<Tick>(delay.b) : 0;
                break;
            case DelayKind::breaks:
                break;
        }
    }
    return {more, stop};
}

}  // namespace rightofway

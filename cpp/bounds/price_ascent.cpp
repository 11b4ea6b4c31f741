#include "bounds/price_ascent.hpp"

#include <algorithm>
#include <cmath>

namespace rightofway {
namespace {

// How much the latest step counts in the mean of the robots that are too many.
constexpr double latest = 0.7;
// The target of steps is first this part above the bound.
constexpr double first_hope = 0.002;
// The target moves away with each gain by this factor.
constexpr double growth = 1.1;
// After so many steps without a gain the target comes nearer, each time after one step more: the
// first target may be far too high, later ones are about right.
constexpr int first_patience = 3;
constexpr int most_patience = 12;
// Steps end where the target is this near to the bound [parts of a tick].
constexpr double least_hope = parts_per_tick / 64.0;

}  // namespace

PriceAscent::PriceAscent(const Problem& problem)
    : problem_(problem),
      distances_(problem),
      search_(problem),
      prices_(problem),
      best_prices_(prices_),
      tracks_(static_cast<std::size_t>(problem.n_robots())),
      stays_(static_cast<std::size_t>(problem.n_vertices())),
      drives_(prices_.lanes().size()),
      patience_(first_patience) {
    problem.refuse_times("prices");
    trips_.reserve(tracks_.size());
    for (RobotId robot = 0; robot < problem.n_robots(); ++robot) {
        trips_.emplace_back(distances_);
    }
}

bool PriceAscent::run(std::int64_t steps, const StopCondition& is_over) {
    for (; steps > 0 && !is_done_; --steps) {
        if (!price(is_over)) {
            return false;
        }
        ++n_steps_;
        if (value_ > best_) {
            if (best_ < 0) {
                hoped_ = first_hope * static_cast<double>(value_);
            }
            best_ = value_;
            best_prices_ = prices_;
            hoped_ *= n_idle_ == 0 ? growth : 1;
            n_idle_ = 0;
        } else if (++n_idle_ >= patience_) {
            n_idle_ = 0;
            hoped_ /= 2;
            patience_ = std::min(patience_ + 1, most_patience);
            prices_ = best_prices_;
            is_done_ = hoped_ < least_hope;
            continue;
        }
        count();
        find_conflicts();
        step();
    }
    return true;
}

// Finds the tracks of least priced cost, and the bound at these prices.
bool PriceAscent::price(const StopCondition& is_over) {
    Tick sum = 0;
    for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
        PricedTrack& track = tracks_[index(robot)];
        if (!search_.improve(robot, trips_[index(robot)].read(robot), prices_, track, is_over)) {
            return false;
        }
        sum += search_.priced(prices_, track);
    }
    for (std::vector<PricesOfPlace>* places : {&prices_.vertices(), &prices_.lanes()}) {
        for (const PricesOfPlace& place : *places) {
            for (const PricesOfPlace::Entry& entry : place.entries()) {
                sum -= entry.price;
            }
        }
    }
    value_ = sum;
    return true;
}

// Counts the robots that want each place that has prices.
void PriceAscent::count() {
    for (auto& stays : stays_) {
        stays.clear();
    }
    for (auto& drives : drives_) {
        drives.clear();
    }
    for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
        const PricedTrack& track = tracks_[index(robot)];
        for (std::size_t k = 0; k < track.visits.size(); ++k) {
            const PricedVisit& visit = track.visits[k];
            stays_[index(visit.vertex)].push_back({search_.booking(robot, track, k), robot});
            if (prices_.has_lanes() && visit.edge >= 0) {
                const auto lane = &prices_.along(visit.edge) - prices_.lanes().data();
                drives_[static_cast<std::size_t>(lane)].push_back(
                    {{visit.enter, visit.enter + 1}, robot});
            }
        }
    }
    const auto count_at = [](PricesOfPlace& place, const std::vector<Stay>& stays) {
        auto& entries = place.entries();
        for (PricesOfPlace::Entry& entry : entries) {
            entry.n = 0;
        }
        for (const Stay& stay : stays) {
            for (std::size_t k = place.from(stay.time.start);
                 k < entries.size() && entries[k].tick < stay.time.end; ++k) {
                ++entries[k].n;
            }
        }
    };
    for (std::size_t v = 0; v < stays_.size(); ++v) {
        count_at(prices_.vertices()[v], stays_[v]);
    }
    for (std::size_t lane = 0; lane < drives_.size(); ++lane) {
        count_at(prices_.lanes()[lane], drives_[lane]);
    }
}

// Gives the last tick of each overlap of two bookings an entry, at no price yet.
void PriceAscent::find_conflicts() {
    const auto find_at = [](PricesOfPlace& place, std::vector<Stay>& stays) {
        std::sort(stays.begin(), stays.end(), [](const Stay& left, const Stay& right) {
            return left.time.start != right.time.start ? left.time.start < right.time.start
                                                       : left.robot < right.robot;
        });
        auto& entries = place.entries();
        const std::size_t n_before = entries.size();
        Tick end = 0;  // of the bookings before
        for (const Stay& stay : stays) {
            if (stay.time.start < end) {
                // Where both stay for ever, the first tick stands for all.
                const Tick last = std::min(end, stay.time.end);
                const Tick tick = last >= never ? stay.time.start : last - 1;
                const auto known = std::lower_bound(
                    entries.begin(), entries.begin() + static_cast<std::ptrdiff_t>(n_before), tick,
                    [](const PricesOfPlace::Entry& entry, Tick value) {
                        return entry.tick < value;
                    });
                const bool is_known =
                    known != entries.begin() + static_cast<std::ptrdiff_t>(n_before) &&
                    known->tick == tick;
                const bool is_added = std::any_of(
                    entries.begin() + static_cast<std::ptrdiff_t>(n_before), entries.end(),
                    [&](const PricesOfPlace::Entry& entry) { return entry.tick == tick; });
                if (!is_known && !is_added) {
                    PricesOfPlace::Entry added{tick};
                    added.n = static_cast<std::int32_t>(
                        std::count_if(stays.begin(), stays.end(), [&](const Stay& other) {
                            return other.time.start <= tick && tick < other.time.end;
                        }));
                    entries.push_back(added);
                }
            }
            end = std::max(end, stay.time.end);
        }
        if (entries.size() > n_before) {
            std::sort(entries.begin(), entries.end(),
                      [](const PricesOfPlace::Entry& left, const PricesOfPlace::Entry& right) {
                          return left.tick < right.tick;
                      });
        }
    };
    for (std::size_t v = 0; v < stays_.size(); ++v) {
        find_at(prices_.vertices()[v], stays_[v]);
    }
    for (std::size_t lane = 0; lane < drives_.size(); ++lane) {
        find_at(prices_.lanes()[lane], drives_[lane]);
    }
}

// A step along the mean of the latest subgradients.
void PriceAscent::step() {
    double square = 0;
    const auto for_each = [&](const auto& use) {
        for (std::vector<PricesOfPlace>* places : {&prices_.vertices(), &prices_.lanes()}) {
            for (PricesOfPlace& place : *places) {
                use(place);
            }
        }
    };
    for_each([&](PricesOfPlace& place) {
        for (PricesOfPlace::Entry& entry : place.entries()) {
            entry.mean = latest * (entry.n - 1) + (1 - latest) * entry.mean;
            if (entry.price > 0 || entry.mean > 0) {
                square += entry.mean * entry.mean;
            }
        }
    });
    if (square <= 0) {
        is_done_ = true;
        return;
    }
    const double length = hoped_ / square;
    for_each([&](PricesOfPlace& place) {
        if (place.entries().empty()) {
            return;
        }
        for (PricesOfPlace::Entry& entry : place.entries()) {
            const auto change = static_cast<Tick>(std::llround(length * entry.mean));
            entry.price = std::max<Tick>(0, entry.price + change);
        }
        std::erase_if(place.entries(), [](const PricesOfPlace::Entry& entry) {
            return entry.price == 0 && entry.mean <= 0;
        });
        place.add_up();
    });
}

}  // namespace rightofway

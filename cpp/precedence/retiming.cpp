#include "precedence/retiming.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

#include "precedence/routes.hpp"
#include "precedence/timetable.hpp"

namespace rightofway {

void retime(const Problem& problem, Tracks& tracks) {
    std::vector<Tick> least(tracks.vertex.size(), 1);
    std::vector<Tick> approach(tracks.vertex.size(), 0);
    for (RobotId r = 0; r < problem.n_robots(); ++r) {
        const Itinerary itinerary = problem.itinerary(r);
        std::size_t stage = 0;
        for (VisitId x = tracks.first_visit[r]; x + 1 < tracks.first_visit[r + 1]; ++x) {
            const Tick drive = problem.drive(r, tracks.vertex[x], tracks.vertex[x + 1]);
            const Tick spare = tracks.enter[x + 1] - tracks.enter[x] - drive;
            least[x] = drive;
            for (const std::size_t end = itinerary.stage_after(stage, tracks.vertex[x], spare);
                 stage < end; ++stage) {
                least[x] += itinerary.stage_work[stage] + itinerary.stage_turn[stage];
            }
            approach[x + 1] = problem.rules().books_ahead ? drive : 0;
        }
    }
    const std::vector<std::uint8_t> active(static_cast<std::size_t>(problem.n_robots()), 1);
    const Routes routes({tracks.first_visit, tracks.vertex, least, approach,
                         problem.rules().headway, false, active});
    Timetable timetable(routes);
    if (timetable.keep_order(tracks.enter)) {
        tracks.enter.assign(timetable.enters().begin(), timetable.enters().end());
    }
}

}  // namespace rightofway

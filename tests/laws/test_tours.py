"""Tours keep every rule and cost what the search says, whatever the work."""

from __future__ import annotations

from hypothesis import strategies as st

from rightofway.assign import AssignmentSearch
from tests.builders.any_work import OBJECTIVES, draw_work
from tests.builders.laws import law, leave
from tests.oracles.tours import judge_tours

FLAGS = st.booleans()


@law(
    st.integers(0, 2**32),
    st.integers(1, 25),
    st.integers(1, 5),
    st.sampled_from(OBJECTIVES),
    st.tuples(FLAGS, FLAGS, FLAGS, FLAGS),
)
def test_every_assignment_keeps_the_rules_and_costs_what_the_search_says(
    seed: int, n_jobs: int, n_robots: int, objective: str, kinds: tuple[bool, bool, bool, bool]
) -> None:
    windows, batteries, after, begun = kinds
    work, travel = draw_work(
        seed,
        n_jobs=n_jobs,
        n_robots=n_robots,
        size=9,
        windows=windows,
        batteries=batteries,
        after=after,
        begun=begun,
        objective=objective,  # type: ignore[arg-type]
    )
    weights = [1 + robot % 3 for robot in range(n_robots)]
    search = AssignmentSearch(work, travel, weights=weights, seed=seed)

    for steps in (0, 1, 30, 100):
        if steps:
            search.improve(steps)
        else:
            search.construct()
        if search.cost.missing:
            leave("a begun job cannot be done")
        assert judge_tours(work, travel, weights, search.assignment) == search.cost[1:]

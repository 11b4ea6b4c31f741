"""Runs: queued, watched, stopped, compared, asked."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path
from typing import Any

import httpx
import pytest
from click.testing import CliRunner

from rightofway.cli.main import commands
from tests.builders.crowds import CROWD
from tests.builders.sentences import find_sentences
from tests.builders.studios import DOOR, over, planned, until


def events(client: httpx.Client, number: int) -> list[tuple[str, Any]]:
    text = client.get(f"/runs/{number}/events").text
    pairs = [block.split("\n") for block in text.split("\n\n") if block.startswith("event:")]
    return [(name[7:], json.loads(data[6:])) for name, data in pairs]


def begun(client: httpx.Client, **request: Any) -> int:
    """Begin a long run, and return its number when it has a plan."""
    body = {"document": CROWD, "planner": "lns", "time_limit": 60, **request}
    number: int = client.post("/runs", json=body).json()["number"]
    until(client, number, lambda run: run["has_plan"])
    return number


def flowtime(client: httpx.Client, run: dict[str, Any]) -> int:
    """Return the sum of completion times of the execution that a run plays."""
    floor = client.get(f"/runs/{run['number']}/payload").json()["floor"]
    return sum(robot["completion"] for robot in floor["robots"])


def test_a_plan_is_made_kept_and_played(client: httpx.Client) -> None:
    run = planned(client, planner="two-level", name="door")
    assert (run["state"], run["name"], run["kind"]) == ("done", "door", "plan")
    payload = client.get(f"/runs/{run['number']}/payload").json()
    assert payload["title"] == "door"
    assert payload["metrics"]["flowtime"] == run["figures"]["flowtime"]
    page = client.get(f"/runs/{run['number']}/page")
    assert page.text.startswith("<!doctype html>")
    assert "sandbox allow-scripts" in page.headers["content-security-policy"]


def test_plans_have_the_digest_of_the_scenario_that_they_are_of(client: httpx.Client) -> None:
    def digest(document: dict[str, Any]) -> str | None:
        body = {"document": document, "identifies": True}
        found: str | None = client.post("/survey", json=body).json()["scenario"]
        return found

    def done(**request: Any) -> dict[str, Any]:
        return over(client, client.post("/runs", json=request).json()["number"])

    plan = planned(client)
    late = done(kind="simulate", based_on=plan["number"], runs=5, time_limit=5)
    laps = done(kind="laps", document=DOOR, time_limit=5)
    better = done(kind="improve", based_on=plan["number"], time_limit=1)
    of_each = {run["figures"]["scenario"] for run in (plan, late, laps, better)}
    assert of_each == {digest(dict(reversed(DOOR.items())))}  # the order of keys is no content
    assert digest({**DOOR, "robots": DOOR["robots"][:1]}) not in {None, *of_each}
    assert digest({**DOOR, "robots": []}) is None
    assert "scenario" not in client.post("/survey", json={"document": DOOR}).json()


@pytest.mark.parametrize("part", ["payload", "losses", "page"])
def test_what_is_large_travels_compressed_to_whoever_takes_it(
    client: httpx.Client, part: str
) -> None:
    address = f"/runs/{planned(client)['number']}/{part}"
    packed = client.get(address, headers={"accept-encoding": "gzip"})
    assert packed.headers["content-encoding"] == "gzip"
    plain = client.get(address, headers={"accept-encoding": "identity"})
    assert "content-encoding" not in plain.headers
    assert plain.text == packed.text


def test_events_tell_the_flowtime_as_it_falls_and_end_with_the_run(client: httpx.Client) -> None:
    body = {"document": CROWD, "planner": "lns", "time_limit": 0.8}
    number = client.post("/runs", json=body).json()["number"]
    heard = events(client, number)
    flowtimes = [data["flowtime"] for _, data in heard if "flowtime" in data]
    assert flowtimes
    assert flowtimes == sorted(flowtimes, reverse=True)
    revisions = [data["revision"] for name, data in heard if name == "plan"]
    assert revisions == sorted(set(revisions))
    assert (heard[-1][0], heard[-1][1]["state"]) == ("run", "done")
    assert events(client, number) == heard[-1:]


def test_one_stream_tells_of_all_runs(client: httpx.Client) -> None:
    heard: list[tuple[str, Any]] = []
    with client.stream("GET", "/events") as stream:
        lines = stream.iter_lines()
        heard.append((next(lines)[7:], json.loads(next(lines)[6:])))
        run = planned(client, planner="two-level")
        client.delete(f"/runs/{run['number']}")
        for line in lines:
            if line.startswith("event: "):
                heard.append((line[7:], json.loads(next(lines)[6:])))
            if heard[-1][0] == "deleted":
                break
    assert heard[0][0] == "runs"
    states = [data["state"] for name, data in heard if name == "run"]
    assert states == ["queued", "running", "done"]
    assert {data["number"] for _, data in heard[1:]} == {run["number"]}


def test_stop_keeps_the_best_plan(client: httpx.Client) -> None:
    number = begun(client)
    client.post(f"/runs/{number}/stop")
    run = over(client, number)
    assert run["state"] == "stopped"
    assert run["status"][0] in {"interrupted", "stopped"}
    assert client.get(f"/runs/{number}/payload").json()["faults"]["count"] == 0


def test_a_cancelled_run_leaves_room_for_the_next(client: httpx.Client) -> None:
    number = begun(client)
    waiting = client.post("/runs", json={"document": DOOR}).json()
    assert waiting["state"] == "queued"
    client.post(f"/runs/{number}/cancel")
    assert over(client, number)["state"] == "cancelled"
    assert over(client, waiting["number"])["state"] == "done"


def test_a_run_that_waits_is_cancelled_without_being_begun(client: httpx.Client) -> None:
    number = begun(client)
    waiting = client.post("/runs", json={"document": DOOR}).json()["number"]
    client.post(f"/runs/{waiting}/cancel")
    client.post(f"/runs/{number}/cancel")
    assert over(client, waiting)["started"] is None


def test_a_run_fails_with_the_faults_of_its_document(client: httpx.Client) -> None:
    document = {**DOOR, "robots": [{"name": "R1", "home": "N3", "target": "N6"}]}
    run = planned(client, document)
    assert run["state"] == "failed"
    assert run["error"]["faults"][0]["named"] == "robots[0] (R1): home"


def test_a_fleet_without_a_plan_is_told_apart_from_giving_up(client: httpx.Client) -> None:
    robots = [
        {"name": "R1", "home": "N0", "target": "N2"},
        {"name": "R2", "home": "N2", "target": "N0"},
    ]
    document = {**DOOR, "map": {"grid": ["..."]}, "robots": robots}
    run = planned(client, document)
    assert run["error"]["kind"] == "no_plan"
    assert run["error"]["robots"] == ["R1", "R2"]


@pytest.mark.parametrize(
    ("wrong", "place"),
    [
        ({"planner": "lnss"}, "planner"),
        ({"options": {"iteration": 3}}, "options.iteration"),
        ({"time_limit": 0}, "time_limit"),
        ({"seed": -1}, "seed"),
        ({"kind": "plans"}, ""),
    ],
)
def test_a_wrong_setting_is_refused_before_it_is_queued(
    client: httpx.Client, wrong: dict[str, Any], place: str
) -> None:
    before = len(client.get("/runs").json()["runs"])
    refused = client.post("/runs", json={"document": DOOR, **wrong})
    assert refused.status_code == 422
    assert [fault["place"] for fault in refused.json()["error"]["faults"][:1]] in ([place], [])
    assert len(client.get("/runs").json()["runs"]) == before


def test_plans_are_improved_and_executed(client: httpx.Client) -> None:
    number = planned(client, planner="two-level")["number"]
    better = client.post("/runs", json={"kind": "improve", "based_on": number, "time_limit": 0.3})
    assert over(client, better.json()["number"])["state"] == "done"
    late = client.post("/runs", json={"kind": "simulate", "based_on": number, "runs": 20})
    done = over(client, late.json()["number"])
    assert done["state"] == "done"
    report = client.get(f"/runs/{done['number']}/report").json()
    assert report["runs"] == sum(report["spread"]["counts"]) == 20
    assert (report["collisions"], report["deadlocks"]) == (0, 0)
    assert report["spread"]["from"] <= report["spread"]["to"]
    assert "floor" in client.get(f"/runs/{done['number']}/payload").json()
    ranks = report["ranks"]
    assert (sorted(ranks["run"]), ranks["run"][-1]) == (list(range(20)), report["worst"])
    replayed = {"replay": report["worst"]}
    assert client.get(f"/runs/{done['number']}/payload", params=replayed).json()["floor"]
    refused = client.get(f"/runs/{done['number']}/payload", params={"replay": 20})
    assert refused.json()["error"]["message"].endswith("has no run 20 to play (it made 20)")
    body = {"kind": "simulate", "based_on": number, "runs": 20, "run": "worst"}
    worst = over(client, client.post("/runs", json=body).json()["number"])
    played = client.get(f"/runs/{worst['number']}/report").json()["played"]
    assert played == report["worst"]
    typical = client.get(f"/runs/{done['number']}/report").json()["played"]
    assert 0 <= played < 20
    assert flowtime(client, worst) > flowtime(client, done) or played == typical


def test_laps_have_a_period(client: httpx.Client) -> None:
    started = client.post("/runs", json={"kind": "laps", "document": DOOR})
    run = over(client, started.json()["number"])
    assert run["state"] == "done"
    report = client.get(f"/runs/{run['number']}/report").json()
    assert report["groups"][0]["period"]
    assert report["groups"][0]["why"] is None
    assert client.get(f"/runs/{run['number']}/payload").json()["steady"]


def test_laps_in_a_new_order_are_asked_for_another_value(client: httpx.Client) -> None:
    started = client.post("/runs", json={"kind": "laps", "document": DOOR})
    number = over(client, started.json()["number"])["number"]
    report = client.get(f"/runs/{number}/report").json()
    same = {"kind": "speed", "robot": "R1", "value": 1}
    found = client.post(f"/runs/{number}/laps", json=same).json()
    assert found["groups"][0]["period"] == report["groups"][0]["period"]
    assert found["throughput_per_hour"] == report["throughput_per_hour"]
    slower = {"kind": "work", "robot": "R1", "stop": 0, "value": "701/7"}
    then = client.post(f"/runs/{number}/laps", json=slower).json()
    assert Fraction(then["groups"][0]["period"]) > 100
    for wrong, why in (
        ({"kind": "speed", "robot": "R9", "value": 1}, "'R9' is no robot of this scenario"),
        ({"kind": "work", "robot": "R1", "stop": 4, "value": 1}, "R1 has no stop 4"),
        ({"kind": "headway", "value": "soon"}, "'soon' is not a number"),
        ({"kind": "speed", "robot": "R1", "value": 0}, "0 is not positive"),
        ({"kind": "headway", "value": -1}, "is negative"),
    ):
        refused = client.post(f"/runs/{number}/laps", json=wrong)
        assert refused.status_code == 422
        assert why in refused.json()["error"]["message"]


def test_a_wait_is_explained_and_its_right_of_way_flipped(client: httpx.Client) -> None:
    """R1 and R2 meet at the door; whoever waits, the other one waits after the flip."""
    number = planned(client, planner="two-level")["number"]
    (loss, *_) = client.get(f"/runs/{number}/losses").json()["losses"]
    assert f"{loss['robot']} waits" in loss["sentence"]
    assert loss["because"][0]["decision"]
    body = {"waits": loss["robot"], "goes_first": loss["for"], "tick": loss["end"]}
    flipped = client.post(f"/runs/{number}/flip", json=body).json()["run"]
    after = client.get(f"/runs/{flipped['number']}/losses").json()["losses"]
    assert loss["for"] in {each["robot"] for each in after}
    compared = client.get("/compare", params={"run": [number, flipped["number"]]}).json()
    assert [each["flowtime"] for each in compared["plans"]][1] == flipped["figures"]["flowtime"]
    assert [robot["name"] for robot in compared["robots"]] == ["R1", "R2"]


FOR_PEOPLE = {"message", "text", "sentence", "sentences", "decision", "reason", "name", "named"}
"""Keys of English sentences and names in answers; ``phrase`` next to them has kind and values."""


def test_answers_have_kinds_and_values_and_no_templates(client: httpx.Client) -> None:
    number = planned(client, planner="random-priority")["number"]
    asked = [
        {"kind": "simulate", "based_on": number, "runs": 5},
        {"kind": "laps", "document": DOOR},
    ]
    runs = [client.post("/runs", json=body).json()["number"] for body in asked]
    answers: dict[str, Any] = {str(k): over(client, k) for k in runs}
    addresses = [f"/runs/{each}/report" for each in (number, *runs)]
    addresses += [f"/runs/{number}/losses", f"/runs/{number}/changes", "/runs"]
    answers |= {address: client.get(address).json() for address in addresses}
    answers["survey"] = client.post("/survey", json={"document": DOOR}).json()
    answers["events"] = events(client, number)
    answers["compare"] = client.get("/compare", params={"run": [number, number]}).json()
    found = {place: find_sentences(answer, FOR_PEOPLE) for place, answer in answers.items()}
    assert {place: sentences for place, sentences in found.items() if sentences} == {}


def test_the_decisions_behind_a_wait_add_up_to_it(client: httpx.Client) -> None:
    """R1 waits 7 in N2: 5 for R2, by the first decision, and 2 more for R3, by the second."""
    document = {
        "format": "rightofway-scenario/1",
        "map": {"grid": [".......", "@@@.@@@", "......."]},
        "robots": [
            {"name": "R1", "home": "N1", "target": "N18"},
            {"name": "R2", "home": "N4", "target": "N17"},
            {"name": "R3", "home": "N14", "target": "N3"},
        ],
    }
    number = planned(client, document, planner="two-level")["number"]
    found = client.get(f"/runs/{number}/losses").json()["losses"]
    (loss,) = [loss for loss in found if loss["ticks"] == 7]
    assert [each["decision"].partition(". ")[2] for each in loss["because"]] == [
        "R1 waits 5 time units in N2 and lets R2 go first.",
        "R1 waits 2 time units in N2 and lets R3 go first.",
    ]


@pytest.mark.parametrize("case", ["door-1", "door-2", "cross-3"])
def test_movement_groups_are_those_of_the_table_of_a_decision(
    client: httpx.Client, tmp_path: Path, case: str
) -> None:
    """Each place, mark and sum is that of ``rightofway table --decision``."""
    document = client.get(f"/examples/paper/{case}").json()["document"]
    number = planned(client, document, planner="paper")["number"]
    plan = tmp_path / "plan.json"
    plan.write_text(client.get(f"/runs/{number}/export/json").text)
    decisions = len(json.loads(plan.read_text())["planner"]["decisions"])
    assert decisions
    for decision in range(1, decisions + 1):
        groups = client.get(f"/runs/{number}/decisions/{decision}").json()
        args = ["table", str(plan), "--decision", str(decision), "--json"]
        table = json.loads(CliRunner().invoke(commands, args).stdout)
        assert len(groups["times"]) == table["last_tick"] + 1
        for row, wanted in zip(groups["rows"], table["rows"], strict=True):
            assert (row["robot"], row["kind"]) == (wanted["robot"], wanted["kind"])
            cells = [
                (str(run["place"]), run["mark"])
                for run in wanted["runs"]
                for _ in range(run["start"], run["end"])
            ]
            assert list(zip(row["places"], row["marks"], strict=True)) == cells
        for pair, text in zip(table["completions"], groups["sums"], strict=True):
            assert f"{pair[0]} + {pair[1]}" in json.dumps(text)
    beyond = client.get(f"/runs/{number}/decisions/{decisions + 1}")
    assert beyond.status_code == 422
    assert f"the last one is {decisions}" in beyond.json()["error"]["message"]


def test_a_flip_of_an_unknown_robot_is_refused(client: httpx.Client) -> None:
    number = planned(client, planner="two-level")["number"]
    body = {"waits": "R1", "goes_first": "R3", "tick": 0}
    refused = client.post(f"/runs/{number}/flip", json=body).json()["error"]
    assert refused["faults"][0]["place"] == "goes_first"


def test_the_command_line_of_a_run_gives_the_same(client: httpx.Client, folder: Path) -> None:
    import shlex

    from click.testing import CliRunner

    from rightofway.cli.main import commands

    run = planned(client, planner="two-level", options={"routes": "shortest"}, source="door.yaml")
    command = client.get(f"/runs/{run['number']}/command").json()["command"]
    words = shlex.split(command.replace("door.yaml", str(folder / "door.yaml")))
    assert words[:2] == ["rightofway", "plan"]
    told = CliRunner().invoke(commands, [*words[1:], "--json"], catch_exceptions=False)
    assert json.loads(told.stdout)["planner"]["options"]["routes"] == "shortest"


@pytest.mark.parametrize("form", ["json", "xlsx", "html", "png", "gif", "lns2"])
def test_a_plan_is_exported(client: httpx.Client, form: str) -> None:
    number = planned(client, planner="two-level")["number"]
    exported = client.get(f"/runs/{number}/export/{form}")
    assert exported.status_code == 200
    assert exported.content


def test_a_run_is_repeated_with_the_same_result(client: httpx.Client) -> None:
    run = planned(client, planner="two-level", options={"routes": "shortest"}, name="door")
    again = over(client, client.post(f"/runs/{run['number']}/again").json()["number"])
    assert again["number"] != run["number"]
    assert (again["name"], again["request"]) == (run["name"], run["request"])
    exports = [client.get(f"/runs/{each['number']}/export/json").text for each in (run, again)]
    assert exports[0] == exports[1]


def test_a_run_is_named_and_deleted(client: httpx.Client) -> None:
    number = planned(client, planner="two-level")["number"]
    assert client.patch(f"/runs/{number}", json={"name": "mine"}).json()["name"] == "mine"
    assert client.delete(f"/runs/{number}").status_code == 200
    assert client.get(f"/runs/{number}").status_code == 404


def test_a_changed_document_is_planned_at_once_beside_a_long_plan(client: httpx.Client) -> None:
    first = planned(client, planner="two-level")
    long = begun(client)
    document = client.get(f"/runs/{first['number']}/document").json()["document"]
    document["robots"][1]["speed"] = "1/2"
    changed = planned(client, document, time_limit=0.5, based_on=first["number"])
    assert client.get(f"/runs/{long}").json()["state"] == "running"
    assert changed["based_on"] == first["number"]
    client.post(f"/runs/{long}/cancel")
    assert changed["figures"]["makespan"] > first["figures"]["makespan"]


def test_a_plan_of_a_changed_document_starts_from_the_plan_before(client: httpx.Client) -> None:
    first = planned(client, planner="two-level")["number"]
    document = client.get(f"/runs/{first}/document").json()["document"]
    document["robots"][1]["work"] = 5
    changed = planned(client, document, time_limit=1, start=first)
    assert changed["figures"]["start"]["routes"] == 2
    assert changed["figures"]["robots"] == 2
    command = client.get(f"/runs/{changed['number']}/command").json()["command"]
    assert f"--start run-{first}.json" in command
    again = client.post(f"/runs/{changed['number']}/again").json()["number"]
    assert over(client, again)["figures"] == changed["figures"]


def test_a_planner_that_cannot_start_from_a_plan_says_so(client: httpx.Client) -> None:
    first = planned(client, planner="two-level")["number"]
    failed = planned(client, planner="paper", start=first)
    assert failed["state"] == "failed"
    assert "paper cannot start from a plan (choose auto" in failed["error"]["message"]


def test_costs_are_compared_in_time_units_where_ticks_differ(client: httpx.Client) -> None:
    first, *others = DOOR["robots"]
    faster = {**DOOR, "robots": [{**first, "speed": 1.5}, *others]}
    runs = [planned(client, document)["number"] for document in (DOOR, faster)]
    found = client.get("/compare", params={"run": runs}).json()
    for place, plan in enumerate(found["plans"]):
        completions = [robot["completion"][place] for robot in found["robots"]]
        assert plan["time"] == pytest.approx(
            {"flowtime": sum(completions), "makespan": max(completions)}
        )
    ticks = [plan["flowtime"] / plan["time"]["flowtime"] for plan in found["plans"]]
    assert ticks[0] != ticks[1]


def test_plans_of_different_scenarios_are_compared_on_one_page(client: httpx.Client) -> None:
    first, *others = DOOR["robots"]
    faster = {**DOOR, "robots": [{**first, "speed": 1.5}, *others]}
    alone = {**DOOR, "robots": [first]}
    runs = [planned(client, document)["number"] for document in (DOOR, faster, alone)]
    found = client.get("/compare", params={"run": runs}).json()
    assert found["titles"] == [f"#{number}" for number in runs]
    plans = found["comparison"]["plans"]
    assert [[change["text"] for change in plan["changes"]] for plan in plans] == [
        [],
        ["R1: speed 1 → 1.5"],
        ["R2: removed"],
    ]
    assert all(plan["seconds"] > 0 for plan in plans)
    page = client.get(f"/runs/{runs[0]}/export/html", params={"other": runs[1:]})
    assert (
        f'filename="plan-{runs[0]}-{runs[1]}-{runs[2]}.html"' in page.headers["content-disposition"]
    )
    assert f'"others":[{{"title":"#{runs[1]}"' in page.text
    payload = client.get(f"/runs/{runs[0]}/payload", params={"other": runs[1:]}).json()
    assert [other["title"] for other in payload["others"]] == found["titles"][1:]
    refused = client.get(f"/runs/{runs[0]}/export/png", params={"other": runs[1]})
    assert refused.status_code == 422
    too_many = client.get("/compare", params={"run": [runs[0]] * 9})
    assert too_many.status_code == 422


def test_what_changed_since_the_run_before_is_said(client: httpx.Client) -> None:
    first, *others = DOOR["robots"]
    faster = {**DOOR, "robots": [{**first, "speed": 2}, *others]}
    documents = (DOOR, faster, faster)
    numbers = [planned(client, each, source="changing.yaml")["number"] for each in documents]
    found = [client.get(f"/runs/{number}/changes").json() for number in numbers]
    assert found[0] == {"before": None, "changes": []}
    assert found[1]["before"] == numbers[0]
    assert [change["text"] for change in found[1]["changes"]] == ["R1: speed 1 → 2"]
    assert found[2] == {"before": numbers[1], "changes": []}


def test_rules_delays_and_formats_are_listed_and_can_be_used(client: httpx.Client) -> None:
    choices = client.get("/choices").json()
    number = planned(client)["number"]
    for rule in choices["rules"]:
        started = client.post("/runs", json={"kind": "laps", "document": DOOR, "rule": rule})
        assert over(client, started.json()["number"])["state"] == "done"
    for form in choices["formats"]:
        assert client.get(f"/runs/{number}/export/{form}").status_code == 200
    assert choices["delays"]["default"] in choices["delays"]["examples"]

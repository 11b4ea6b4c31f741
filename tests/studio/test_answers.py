"""Answers of the API are what the types for the page say, key for key."""

from __future__ import annotations

from typing import Any

import pytest
from pydantic import TypeAdapter, ValidationError

from rightofway.studio.routes.answers import ANSWERS, BODIES
from tests.builders.studios import DOOR, Client, planned


def validate(method: str, path: str, answer: Any) -> None:
    """Raise `ValidationError` for a key or a value that the types do not have."""
    TypeAdapter(ANSWERS[method, path]).validate_python(answer, extra="forbid")


@pytest.mark.parametrize("path", ["/", "/files", "/drafts", "/examples", "/planners", "/choices"])
def test_each_list_has_the_declared_types(client: Client, path: str) -> None:
    validate("GET", path, client.get(path).json())


@pytest.mark.parametrize("document", [DOOR, {**DOOR, "robots": [{"name": "R1", "home": "N99"}]}])
def test_a_survey_has_the_declared_types(client: Client, document: dict[str, Any]) -> None:
    answer = client.post("/survey", json={"document": document, "identifies": True}).json()
    validate("POST", "/survey", answer)
    validate("POST", "/validate", client.post("/validate", json={"document": document}).json())


def test_a_draft_has_the_declared_types(client: Client) -> None:
    kept = client.put("/drafts/typed", json={"document": DOOR})
    validate("PUT", "/drafts/{name}", kept.json())
    validate("GET", "/drafts/{name}", client.get("/drafts/typed").json())
    validate("GET", "/drafts", client.get("/drafts").json())


def test_a_run_and_what_is_asked_of_it_have_the_declared_types(client: Client) -> None:
    number = planned(client, DOOR)["number"]
    path = f"/runs/{number}"
    validate("GET", "/runs/{number}", client.get(path).json())
    for part in ("document", "command", "losses", "changes"):
        validate("GET", f"/runs/{{number}}/{part}", client.get(f"{path}/{part}").json())
    validate("GET", "/runs", client.get("/runs").json())
    by_two_levels = planned(client, DOOR, planner="two-level")["number"]
    groups = client.get(f"/runs/{by_two_levels}/decisions/1")
    validate("GET", "/runs/{number}/decisions/{decision}", groups.json())
    compared = client.get("/compare", params={"run": [number, number]})
    validate("GET", "/compare", compared.json())


def test_a_key_that_no_type_has_is_found(client: Client) -> None:
    answer = client.get("/").json()
    with pytest.raises(ValidationError, match="age"):
        validate("GET", "/", {**answer, "age": 3})


def test_each_type_is_of_a_route(client: Client) -> None:
    """A route that is renamed takes its type along."""
    document = client.get("/openapi.json").json()
    routes = {
        (method.upper(), path.removeprefix("/api/v1") or "/")
        for path, operations in document["paths"].items()
        for method in operations
    }
    assert {*ANSWERS, *BODIES} <= routes

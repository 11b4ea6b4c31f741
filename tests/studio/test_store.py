"""Drafts and runs on the disk, and files of the folder."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from rightofway.errors import InputError
from rightofway.studio.errors import Refused
from rightofway.studio.store import FILE, Store
from rightofway.studio.workspace import Workspace
from tests.builders.studios import DOOR, planned, running


def test_what_is_kept_is_there_when_the_file_is_opened_again(tmp_path: Path) -> None:
    store = Store(tmp_path)
    number = store.add_run({"name": "one"})
    store.put_run(number, {"name": "two"}, [("plan", b"first"), ("report", b"{}")])
    store.put_run(number, {"name": "two"}, [("plan", b"second")])
    store.put_draft("hall", {"map": {}})
    store.close()
    again = Store(tmp_path)
    assert again.is_kept
    assert again.list_runs() == [(number, {"name": "two"})]
    assert (again.read_blob(number, "plan"), again.read_blob(number, "report")) == (
        b"second",
        b"{}",
    )
    found = again.read_draft("hall")
    assert found
    assert found["document"] == {"map": {}}
    again.close()


def test_a_run_is_added_with_its_blobs_in_one_piece(tmp_path: Path) -> None:
    """A studio that was killed in between had a run in its list that could not be planned."""
    with running(tmp_path) as client:
        said: list[str] = []
        client.studio.store._database.set_trace_callback(said.append)
        client.post("/runs", json={"document": DOOR}).raise_for_status()
        client.studio.store._database.set_trace_callback(None)
    [added] = [k for k, line in enumerate(said) if line.startswith("INSERT INTO runs")]
    kept = next(k for k, line in enumerate(said) if line.startswith("INSERT OR REPLACE INTO blobs"))
    assert "COMMIT" not in said[added:kept]


def test_a_deleted_run_takes_its_blobs_along_and_is_not_put_back(tmp_path: Path) -> None:
    store = Store(tmp_path)
    number = store.add_run({})
    store.put_run(number, {}, [("plan", b"plan")])
    store.delete_run(number)
    store.put_run(number, {}, [("plan", b"late")])
    assert store.list_runs() == []
    assert store.read_blob(number, "plan") is None
    store.close()


@pytest.mark.parametrize("content", [b"", b"no database at all" * 100])
def test_a_file_that_is_no_database_is_left_alone(tmp_path: Path, content: bytes) -> None:
    (tmp_path / FILE).write_bytes(content)
    store = Store(tmp_path)
    assert store.is_kept == (content == b"")
    store.put_draft("hall", {})
    store.close()
    if content:
        assert (tmp_path / FILE).read_bytes() == content


def test_a_folder_that_cannot_be_written_is_served_from_memory(tmp_path: Path) -> None:
    store = Store(tmp_path / "nowhere")
    assert not store.is_kept
    store.put_draft("hall", {})
    assert [each["name"] for each in store.list_drafts()] == ["hall"]
    store.close()


@pytest.mark.parametrize(
    "name",
    ["", "/", "//", ".", "..", "a/..", "./a", "a//b", "a/", "/a", "~", ".a", "a/.b", "a\0b", "a\\b",
     "a:b", "a\nb", "C:/a", "a.", "a ", "x" * 201],
)  # fmt: skip
def test_a_name_that_is_no_plain_path_is_refused(tmp_path: Path, name: str) -> None:
    workspace = Workspace(tmp_path)
    if name == "~":  # a plain name: nothing expands it
        assert workspace.find_path(name) == tmp_path / "~"
        return
    with pytest.raises(Refused):
        workspace.find_path(name)


def test_a_path_that_leads_through_a_link_is_refused(tmp_path: Path) -> None:
    outside, inside = tmp_path / "outside", tmp_path / "inside"
    outside.mkdir()
    inside.mkdir()
    (inside / "out").symlink_to(outside)
    (inside / "loop").symlink_to(inside / "loop")
    for name in ("out/new.yaml", "out", "loop", "loop/a"):
        with pytest.raises(Refused):
            Workspace(inside).write(name, b"")
    assert list(outside.iterdir()) == []


def test_a_file_in_a_folder_that_is_not_there_is_refused_in_the_words_of_the_library(
    tmp_path: Path,
) -> None:
    with pytest.raises(InputError, match="there is no directory"):
        Workspace(tmp_path).write("a/b.yaml", b"")


def test_a_list_of_a_large_folder_has_what_is_near_and_says_that_it_is_cut(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("rightofway.studio.workspace.MAX_FOLDERS", 3)
    for name in ("a/deep/far.yaml", "b/near.yaml", "top.yaml"):
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()
    entries, is_whole = Workspace(tmp_path).list_files()
    assert ([entry.path for entry in entries], is_whole) == (["b/near.yaml", "top.yaml"], False)


def test_a_full_disk_is_refused_with_words_and_leaves_what_was_there(tmp_path: Path) -> None:
    store = Store(tmp_path)
    store.put_draft("hall", {"walls": 1})
    store._database.execute("PRAGMA max_page_count = 10")
    with pytest.raises(Refused, match="disk is full") as refused:
        store.put_draft("hall", {"walls": "x" * 10**6})
    assert refused.value.status == 507
    found = store.read_draft("hall")
    assert found
    assert found["document"] == {"walls": 1}
    store.close()


def test_a_run_that_cannot_be_kept_fails_and_the_next_one_is_planned(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The disk is full while a plan is saved, and has room again afterwards."""
    with running(tmp_path) as client:
        studio = client.studio
        put, is_full = studio.store.put_run, [True]

        def fails(number: int, data: Any, blobs: Any = ()) -> None:
            if is_full[0] and any(kind == "plan" for kind, _ in blobs):
                raise Refused("drafts and runs cannot be kept: full (free some space)", 507)
            put(number, data, blobs)

        monkeypatch.setattr(studio.store, "put_run", fails)
        first = planned(client, planner="two-level")
        assert first["state"] == "failed"
        assert "cannot be kept" in first["error"]["message"]
        is_full[0] = False
        assert planned(client, planner="two-level")["state"] == "done"

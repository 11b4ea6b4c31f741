"""Drafts and runs on the disk, and files of the folder."""

from __future__ import annotations

import json
import os
import socket
import subprocess
import sys
import zlib
from pathlib import Path
from typing import Any
from urllib.parse import quote

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
    assert ("is damaged" in store.trouble) == (content != b"")
    store.put_draft("hall", {})
    store.close()
    if content:
        assert (tmp_path / FILE).read_bytes() == content


def make_file(folder: Path) -> bytes:
    """Write a file with drafts, a run and its plan, and return its content."""
    store = Store(folder)
    for name in "abc":
        store.put_draft(name, {"map": {"grid": ["." * 3000]}})
    store.add_run({"name": "one"}, [("plan", bytes(range(256)) * 40)])
    store.close()
    return (folder / FILE).read_bytes()


def damage(content: bytes, how: str) -> bytes:
    """Return the content of a file with one kind of damage."""
    page = content.index(b'{"name": "one"}')
    return {
        "header": b"x" * 100 + content[100:],
        "size": content[:5000],
        "schema": content.replace(b"CREATE TABLE drafts", b"CREATE TABEL drafts"),
        "column": content.replace(b"document TEXT", b"dokument TEXT"),
        "page": content[:4096] + b"\xff" * 4096 + content[8192:],
        "json": content[:page] + b"[" + content[page + 1 :],
        "text": content[:page] + b"\xff" + content[page + 1 :],
        "mapping": content.replace(b'{"name": "one"}', b'["name", "one"]'),
    }[how]


@pytest.mark.parametrize(
    "how", ["header", "size", "schema", "column", "page", "json", "text", "mapping"]
)
def test_a_damaged_file_is_named_as_damaged_and_left_alone(tmp_path: Path, how: str) -> None:
    content = damage(make_file(tmp_path), how)
    (tmp_path / FILE).write_bytes(content)
    store = Store(tmp_path)
    assert store.trouble.startswith(f"{FILE} is damaged: ")
    assert "move it away" in store.trouble
    store.put_draft("hall", {})
    assert [each["name"] for each in store.list_drafts()] == ["hall"]
    store.close()
    assert (tmp_path / FILE).read_bytes() == content


def test_a_damaged_plan_is_named_when_it_is_read(tmp_path: Path) -> None:
    content = make_file(tmp_path)
    packed = zlib.compress(bytes(range(256)) * 40, 1)
    broken = content.replace(packed[20:40], bytes(20))
    assert broken != content
    (tmp_path / FILE).write_bytes(broken)
    store = Store(tmp_path)
    assert store.trouble == ""
    with pytest.raises(Refused, match="the plan of run 1 is damaged"):
        store.read_blob(1, "plan")
    store.close()


def test_a_second_store_names_the_first_one(tmp_path: Path) -> None:
    one, other = Store(tmp_path), Store(tmp_path)
    assert (one.trouble, other.trouble[:31]) == ("", "another studio has the folder o")
    one.close()
    other.close()


def test_a_folder_that_cannot_be_written_is_served_from_memory(tmp_path: Path) -> None:
    store = Store(tmp_path / "nowhere")
    assert not store.is_kept
    assert store.trouble.startswith("the folder cannot be written: ")
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


NAMES = ["hall 12:30.yaml", "why?.yaml", 'a"b<c>|*.yaml', "a .yaml", "a\u00a0b.yaml",
         "x" * 240 + ".yaml", "%2e%41.yaml", "#1&2=3+4.yaml", "a;b,c.yaml",
         "12:30/plan?.yaml", "ends in a dot./a.yaml", "\N{ROCKET}.yaml"]  # fmt: skip


def make_odd_files(folder: Path) -> None:
    """Write a scenario under every odd name, and under names that no address can have."""
    for name in NAMES:
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(json.dumps(DOOR))
    for unnameable in (b"not utf-8 \xff.yaml", b"two\nlines.yaml", b"a\\b.yaml"):
        (folder / os.fsdecode(unnameable)).write_text(json.dumps(DOOR))


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such names")
def test_every_file_that_is_listed_is_opened_looked_at_and_saved(tmp_path: Path) -> None:
    make_odd_files(tmp_path)
    with running(tmp_path) as client:
        listed = [each["path"] for each in client.get("/files").json()["files"]]
        assert sorted(listed) == sorted(NAMES)
        for name in listed:
            address = quote(name)
            assert client.get(f"/glances/files/{address}").json().get("kind") == "scenario", name
            opened = client.get(f"/documents/{address}").json()
            body = {"document": opened["document"], "revision": opened["revision"]}
            assert client.put(f"/documents/{address}", json=body).status_code == 200, name
            assert client.get(f"/files/{address}").content, name


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such names")
@pytest.mark.parametrize("stem", ["12:30", "why?", "x" * 230, "ends in a dot."])
def test_a_layout_of_any_name_gets_a_name_under_which_it_can_be_saved(
    tmp_path: Path, stem: str
) -> None:
    (tmp_path / f"{stem}.map").write_text("type octile\nheight 1\nwidth 3\nmap\n...\n")
    with running(tmp_path) as client:
        opened = client.get(f"/documents/{quote(stem)}.map").json()
        body = {"document": opened["document"], "revision": ""}
        saved = client.put(f"/documents/{quote(opened['save_as'])}", json=body)
        assert saved.status_code == 200, saved.text


def make_special(path: Path, kind: str) -> None:
    """Make something at a path that is no regular file."""
    if kind == "pipe":
        os.mkfifo(path)
    elif kind == "socket":
        with socket.socket(socket.AF_UNIX) as listener:
            listener.bind(str(path))
    elif kind == "folder":
        path.mkdir()
    else:
        path.symlink_to("/dev/full")


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such files")
@pytest.mark.parametrize("kind", ["pipe", "socket", "folder", "link to a device"])
def test_what_is_no_regular_file_blocks_neither_its_request_nor_later_ones(
    tmp_path: Path, kind: str
) -> None:
    with running(tmp_path) as client:
        make_special(tmp_path / "special.yaml", kind)
        (tmp_path / "special.map").write_text("type octile\nheight 1\nwidth 3\nmap\n...\n")
        body = {"document": DOOR, "revision": None}
        content: dict[str, Any] = {
            "content": b"a: 1",
            "headers": {"content-type": "application/octet-stream"},
        }
        asked: list[tuple[str, str, dict[str, Any]]] = [
            ("PUT", "/files/special.yaml?replace=true", content),
            ("PUT", "/files/special.yaml", content),
            ("PUT", "/documents/special.yaml", {"json": body}),
            ("GET", "/documents/special.yaml", {}),
            ("GET", "/files/special.yaml", {}),
            ("GET", "/glances/files/special.yaml", {}),
        ]
        for method, address, given in asked:
            refused = client.request(method, address, timeout=10, **given)
            assert refused.status_code in {400, 404, 412, 422}, (method, address)
            assert refused.json()["error"]["message"]
        assert client.put("/documents/other.yaml", json=body).status_code == 200
        assert client.get("/documents/special.map").json()["save_as"] == "special2.yaml"


KILLED = """
import os, signal, sys
from pathlib import Path
from rightofway import files
files.os.fsync = lambda _: os.kill(os.getpid(), signal.SIGKILL)
files.write_whole(sys.argv[1], "half of what is new")
"""


def leave_part(target: Path) -> None:
    """Kill a program while it writes a file."""
    subprocess.run([sys.executable, "-c", KILLED, str(target)], check=False)


def list_parts(folder: Path) -> list[str]:
    """Return the names of files that are being written, or were."""
    return sorted(path.name for path in folder.rglob("*.part"))


@pytest.mark.skipif(sys.platform == "win32", reason="there is no SIGKILL")
def test_a_studio_removes_what_killed_programs_were_writing(tmp_path: Path) -> None:
    (tmp_path / "inside").mkdir()
    for name in ("hall.yaml", "inside/hall.yaml"):
        leave_part(tmp_path / name)
    assert len(list_parts(tmp_path)) == 2
    kept = [".mine.part", ".hall.yaml.x1.part", "hall.yaml.12.part"]
    for name in kept:
        (tmp_path / name).write_text("of another program")
    with running(tmp_path):
        assert list_parts(tmp_path) == sorted(kept)


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

"""The check of commit messages that `pre-commit` runs."""

import subprocess
from pathlib import Path

import pytest

CHECK = Path(__file__).parents[1] / ".ci" / "check_subject"


def check_message(folder: Path, message: str) -> str:
    """Return what the check prints: nothing if it passes."""
    written = folder / "message"
    written.write_text(message, encoding="utf-8")
    ended = subprocess.run([CHECK, written], capture_output=True, text=True, check=False)
    assert (ended.returncode == 0) == (ended.stderr == "")
    return ended.stderr


@pytest.mark.parametrize(
    "message",
    [
        "Reject orders whose id has too many digits",
        "Speed up the judge\n\nA round of 200 robots took 0.8 s.\n\n# comment of the editor\n",
        f"Cite a paper\n\nhttps://{'a' * 80}\n",
        "fixup! reject orders.",
    ],
)
def test_a_good_message_passes(tmp_path: Path, message: str) -> None:
    assert check_message(tmp_path, message) == ""


@pytest.mark.parametrize(
    ("message", "fault"),
    [
        ("reject orders", "capital letter"),
        ("Reject orders.", "full stop"),
        ("R" * 73, "73 characters"),
        ("Rejected orders", "no imperative"),
        ("Rejecting orders", "no imperative"),
        ("Reject orders\nof robots", "second line"),
        (f"Reject orders\n\n{'a' * 73}", "wrap it"),
    ],
)
def test_a_fault_of_a_message_is_named(tmp_path: Path, message: str, fault: str) -> None:
    assert fault in check_message(tmp_path, message)

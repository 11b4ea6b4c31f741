"""Completions of a shell: planners, their options, and files by their endings.

Click makes the scripts for the shells; `docs/command-line.md` says how to switch them on. Here is
completions of our arguments, and two repairs for Bash, which takes ``name=value`` for three words
and puts a blank after a folder.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import click
from click.shell_completion import BashComplete, CompletionItem, add_completion_class

from rightofway.planners import Feature, PlannerSpec, find_all

Completer = Callable[[click.Context, click.Parameter, str], "list[CompletionItem[str]]"]

SCENARIOS = (".yaml", ".yml", ".json", ".xlsx", ".scen")
"""Endings of the files that have a scenario."""

PLANS = (".json", ".txt", ".yaml")
"""Endings of the files that have a plan."""


def complete_files(*suffixes: str) -> Completer:
    """Return a function that completes files with these endings, and folders."""

    def complete(
        _context: click.Context, _parameter: click.Parameter, incomplete: str
    ) -> list[CompletionItem[str]]:
        folder, slash, stem = incomplete.rpartition("/")
        paths = sorted(Path(folder + slash or ".").glob(f"{_make_literal(stem)}*"))
        return [
            CompletionItem(f"{folder}{slash}{path.name}" + "/" * path.is_dir())
            for path in paths
            if path.is_dir() or path.suffix.lower() in suffixes
            if stem.startswith(".") or not path.name.startswith(".")
        ]

    return complete


def _make_literal(text: str) -> str:
    """Return a pattern that only the text itself fits."""
    return "".join(f"[{character}]" if character in "*?[" else character for character in text)


def complete_words(known: Callable[[], Iterable[str]]) -> Completer:
    """Return a function that completes words, which are looked up when Tab is pressed."""

    def complete(
        _context: click.Context, _parameter: click.Parameter, incomplete: str
    ) -> list[CompletionItem[str]]:
        return [CompletionItem(word) for word in known() if word.startswith(incomplete)]

    return complete


def complete_planners(*, improving: bool) -> Completer:
    """Return a function that completes names of planners, or of those that improve a plan."""

    def complete(
        _context: click.Context, _parameter: click.Parameter, incomplete: str
    ) -> list[CompletionItem[str]]:
        return [
            CompletionItem(spec.name, help=spec.summary)
            for spec in find_all().values()
            if spec.name.startswith(incomplete)
            and (not improving or Feature.IMPROVES in spec.features)
        ]

    return complete


def complete_planner_options(
    context: click.Context, _parameter: click.Parameter, incomplete: str
) -> list[CompletionItem[str]]:
    """Complete ``name=value`` for the planner that stands in the command so far."""
    spec: PlannerSpec | None = find_all().get(str(context.params.get("planner")))
    return [
        CompletionItem(pair, help=option.summary)
        for option in (spec.options if spec else ())
        for value in option.choices or (option.default,)
        if (pair := f"{option.name}={value}").startswith(incomplete)
    ]


@add_completion_class
class _Bash(BashComplete):
    """Completion for Bash, where ``=`` parts words and a folder is not the end of a word."""

    source_template = BashComplete.source_template.replace(
        "COMPREPLY+=($value)", "COMPREPLY+=($value); [[ $value == */ ]] && compopt -o nospace"
    )
    value_only = False

    def get_completion_args(self) -> tuple[list[str], str]:
        """Return the words before the cursor and the word at it, ``name = value`` made one."""
        args, incomplete = super().get_completion_args()
        if incomplete == "=" and args and not args[-1].startswith("-"):
            args, incomplete, self.value_only = args[:-1], f"{args[-1]}=", True
        elif args[-1:] == ["="] and len(args) > 1 and not args[-2].startswith("-"):
            args, incomplete, self.value_only = args[:-2], f"{args[-2]}={incomplete}", True
        return args, incomplete

    def format_completion(self, item: CompletionItem[Any]) -> str:
        """Return an item, or only its value where Bash has parted off the name."""
        if self.value_only:
            item = CompletionItem(str(item.value).partition("=")[2], type=item.type)
        return super().format_completion(item)

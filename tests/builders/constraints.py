"""``constraints.txt`` from pip's report: ``python -m tests.builders.constraints REPORT``.

`just constraints` makes the report, of what pip would install for all work on the package.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

CONSTRAINTS = Path(__file__).parents[2] / "constraints.txt"
HEAD = """\
# The versions that CI installs, written by `just constraints`: a release elsewhere turns CI red
# only when this file is refreshed. A package that is installed by its users has lower bounds alone.
"""


def pins(report: Path) -> list[str]:
    """Return ``name==version`` of each package of a report but our own, by name."""
    installs = json.loads(report.read_text("utf-8"))["install"]
    versions = {
        str(install["metadata"]["name"]).lower().replace("_", "-"): install["metadata"]["version"]
        for install in installs
    }
    return [f"{name}=={versions[name]}" for name in sorted(versions) if name != "rightofway"]


if __name__ == "__main__":
    CONSTRAINTS.write_text(HEAD + "\n".join([*pins(Path(sys.argv[1])), ""]), "utf-8")

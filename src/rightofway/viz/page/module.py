"""The scripts of the page as one ES module, for pages that are built around them."""

from __future__ import annotations

import re
from functools import cache

from rightofway.viz.page.document import SCRIPTS, asset, lean_script

NAMES = re.compile(r"^(?:async )?(?:class|function|const|let) (\w+)", re.MULTILINE)
"""What a script declares for the others: lines that are not indented."""


@cache
def viewer_module() -> str:
    """Return a module that exports every name that the scripts share, and starts nothing."""
    parts = [name for name in SCRIPTS if name != "main"]
    shared = sorted({name for part in parts for name in NAMES.findall(asset(f"{part}.js"))})
    scripts = (lean_script(part) for part in parts)
    return "\n".join([*scripts, f"export {{ {', '.join(shared)} }};", ""])

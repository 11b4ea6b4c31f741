"""The scripts of the page as one ES module, for pages that are built around them."""

from __future__ import annotations

import re
from functools import cache

from rightofway.viz.page.document import SCRIPTS, lean_script

NAMES = re.compile(r"^(?:async )?(?:class|function|const|let) (\w+)", re.MULTILINE)
"""What a script declares for the others."""


@cache
def viewer_module() -> str:
    """Return a module that exports every name that the scripts share, and starts nothing."""
    scripts = [lean_script(name) for name in SCRIPTS if name != "main"]
    names = sorted({name for script in scripts for name in NAMES.findall(script)})
    return "\n".join([*scripts, f"export {{ {', '.join(names)} }};", ""])

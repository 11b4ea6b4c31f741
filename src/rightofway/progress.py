"""Progress of long work, logged where a caller takes no facts on it."""

from __future__ import annotations

import sys

from rightofway.facts import Fact


def log_progress(fact: Fact | str) -> None:
    """Log a fact on progress by the logger ``rightofway``, at the level INFO.

    It becomes a sentence only if a handler writes it. A program that listens has imported
    `logging`; other programs do not need it for this.
    """
    logging = sys.modules.get("logging")
    if logging is not None:
        logging.getLogger("rightofway").info("%s", fact)

"""``rightofway studio``: draw, plan, watch and compare in a browser."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

import click

from rightofway.cli.completion import SCENARIOS, complete_files
from rightofway.cli.options import Whole
from rightofway.cli.terminal import complain
from rightofway.errors import InputError

EXAMPLES = """\b
Examples:
  rightofway studio
  rightofway studio examples/door.yaml
  rightofway studio . --api-only --port 8000
"""


@click.command(epilog=EXAMPLES, short_help="Draw, plan, watch and compare in a browser.")
@click.argument("path", type=click.Path(), default=".", metavar="[FILE|FOLDER]",
                shell_complete=complete_files(*SCENARIOS))  # fmt: skip
@click.option("--host", default="127.0.0.1", show_default=True, metavar="ADDRESS",
              help="Address to listen on. Other machines need the token in the"
              " printed address.")  # fmt: skip
@click.option("--port", type=Whole(1, 65535), metavar="PORT",
              help="Port to listen on; a free one by default.")  # fmt: skip
@click.option("--certificate", type=click.Path(dir_okay=False), metavar="FILE",
              help="Certificate in PEM format: the connection is encrypted (https).")  # fmt: skip
@click.option("--key", type=click.Path(dir_okay=False), metavar="FILE",
              help="Private key of the certificate; by default in the file of the"
              " certificate.")  # fmt: skip
@click.option("--planners", type=Whole(1, 64), default=1, show_default=True, metavar="N",
              help="Number of plans that are made at the same time, each in a"
              " process of its own.")  # fmt: skip
@click.option("--no-browser", is_flag=True, help="Do not open a browser.")
@click.option("--api-only", is_flag=True, help="Serve the API without the page.")
@click.option("--no-history", is_flag=True,
              help="Keep drafts and runs in memory instead of in the folder.")  # fmt: skip
def studio(
    *,
    path: str,
    host: str,
    port: int | None,
    certificate: str | None,
    key: str | None,
    planners: int,
    no_browser: bool,
    api_only: bool,
    no_history: bool,
) -> None:
    """Serve a page to draw floors and to make, play and compare plans, and its API.

    The studio has access to the files of FOLDER, or of the folder of FILE, and to no others. It
    needs the extra `studio`.
    """
    if not (find_spec("fastapi") and find_spec("uvicorn")):
        message = "needs packages that are not installed (pip install 'rightofway[studio]')"
        raise InputError.at("studio", message)
    from rightofway.studio.serve import serve, split_folder_and_file
    from rightofway.studio.session import Studio

    folder, file = split_folder_and_file(Path(path))
    serve(
        Studio(folder, file=file, planners=planners, keeps=not no_history),
        host=host,
        port=port,
        certificate=certificate,
        key=key,
        has_page=not api_only,
        opens_browser=not (no_browser or api_only),
        say=complain,
    )

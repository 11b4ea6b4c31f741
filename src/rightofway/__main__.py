"""``python -m rightofway``."""

from rightofway.cli import main

main()

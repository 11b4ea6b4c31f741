"""The command line: arguments in, words and exit codes out; the library does the work."""

from rightofway.cli.main import main

__all__ = ["main"]

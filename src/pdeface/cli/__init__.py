"""The command line: a thin skin over the library, one command a file.

Only what a command uses is imported, when it is used: ``pdeface --help`` must answer at once.
"""

from pdeface.cli.app import run

__all__ = ["run"]

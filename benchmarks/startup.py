"""What `import pdeface` costs beside `import numpy`, and when `pdeface --help` answers.

    python -m benchmarks.startup

Each in an interpreter of its own, warm, in turns; the best of many, since noise only adds.
"""

from __future__ import annotations

import subprocess
import sys

from benchmarks.timing import machine, side_by_side

COMMANDS = {
    "nothing": ["-c", "pass"],
    "import numpy": ["-c", "import numpy"],
    "import numpy, pdeface": ["-c", "import numpy, pdeface"],
    "import numpy, pdeface.PDESurface": ["-c", "import numpy, pdeface; pdeface.PDESurface"],
    "pdeface --help": ["-m", "pdeface", "--help"],
}


def main() -> None:
    print(f"Start-up. {machine()}")
    samples = side_by_side(
        {name: lambda c=command: run(c) for name, command in COMMANDS.items()}, seconds=20.0
    )
    numpy = min(samples["import numpy"])
    for name, times in samples.items():
        own = min(times)
        print(f"  {name:<34}{1e3 * own:8.0f} ms{1e3 * (own - numpy):+8.0f} ms over numpy")


def run(arguments: list[str]) -> None:
    subprocess.run([sys.executable, *arguments], check=True, stdout=subprocess.DEVNULL)


if __name__ == "__main__":
    main()

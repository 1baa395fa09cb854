"""`import granvof` as a program: reads a run directory. Exit code 2 with a line where it is none."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent.parent / "solver/python"))

import granvof  # noqa: E402

try:
    granvof.load(sys.argv[1])
except granvof.NotARun as error:
    sys.exit(print(f"load: {error}", file=sys.stderr) or 2)

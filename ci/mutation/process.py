"""One program with one fault in force: how it ended, within limits of time and memory."""

import os
import resource
import signal
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from night.together import ends_with_parent  # noqa: E402

MEMORY = 4 << 30  # bytes a faulty program may take
OUTPUT = 1 << 30  # bytes a faulty program may write into a file


@dataclass
class Ended:
    code: int | None  # None: it was stopped at its time limit
    output: str

    @property
    def how(self):
        if self.code is None:
            return "did not end"
        return f"ended by {signal.Signals(-self.code).name}" if self.code < 0 else f"exit code {self.code}"


def limited():
    ends_with_parent()
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_FSIZE, (OUTPUT, OUTPUT))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def run(command, directory, time_limit, scratch, environment=None):
    """`scratch`: where it finds its temporary files."""
    process = subprocess.Popen([str(part) for part in command], cwd=directory, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT, start_new_session=True, preexec_fn=limited,
                               env={**os.environ, "OMP_NUM_THREADS": "1", "TMPDIR": str(scratch), **(environment or {})})
    try:
        output, _ = process.communicate(timeout=time_limit)
        code = process.returncode
    except subprocess.TimeoutExpired:
        output, code = b"", None
    finally:
        try:
            os.killpg(process.pid, signal.SIGKILL)  # it, and whatever it left behind
        except ProcessLookupError:
            pass
        process.wait()
    return Ended(code, output.decode(errors="replace"))

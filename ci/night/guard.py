#!/usr/bin/python3
"""guard.py COMMAND...: runs a command, and ends everything it started when this process is asked to end.

A nightly run that is killed cannot end what its stages started: this process, which leads their group, is told by the
kernel and does. Exit code: that of the command.
"""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from night.together import ends_with_parent  # noqa: E402

GRACE = 10.0  # seconds between the polite and the hard end


def end_group(*_):
    signal.signal(signal.SIGTERM, signal.SIG_IGN)  # the group holds this process too
    os.killpg(0, signal.SIGTERM)
    deadline = time.monotonic() + GRACE
    while time.monotonic() < deadline and others():
        time.sleep(0.05)
    os.killpg(0, signal.SIGKILL)


def others():
    """Whether the group holds another process that lives."""
    me = os.getpid()
    for entry in Path("/proc").glob("[0-9]*/stat"):
        try:
            state, _, group = entry.read_text().rpartition(")")[2].split()[:3]
        except OSError:
            continue  # it ended just now
        if int(group) == me and int(entry.parent.name) != me and state != "Z":
            return True
    return False


def main(command):
    signal.signal(signal.SIGTERM, end_group)
    parent = os.getpid()
    try:
        code = subprocess.Popen(command, preexec_fn=lambda: ends_with_parent(parent)).wait()
    except OSError as error:
        print(error)
        return 127
    return 128 - code if code < 0 else code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

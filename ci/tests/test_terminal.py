"""What granvof says in a terminal, and not elsewhere."""

import fcntl
import os
import pty
import struct
import subprocess
import termios
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
RUN = [ROOT / "build/release/solver/granvof", "run", ROOT / "cases/canary.toml", "--set", "grid.dx=0.00025"]  # long: it is ended once it has plotted


def test_the_front_is_plotted_in_a_terminal_and_neither_in_a_pipe_nor_in_the_log(tmp_path):
    leader, follower = pty.openpty()
    fcntl.ioctl(follower, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 76, 0, 0))
    run = subprocess.Popen([*RUN, "--out", tmp_path / "run"], stdout=subprocess.DEVNULL, stderr=follower)
    os.close(follower)
    said = ""
    try:
        while "front ▁" not in said and (data := os.read(leader, 4096)):
            said += data.decode(errors="replace")
    except OSError:  # the run has closed the terminal
        pass
    run.terminate()
    while run.poll() is None:  # what it says on its way out has to go somewhere
        try:
            os.read(leader, 4096)
        except OSError:
            run.wait()
    os.close(leader)
    shown = [line.partition("\x1b[K")[0] for line in said.split("\r") if "left" in line]
    assert "front ▁" in said and shown and max(map(len, shown)) < 76, said
    assert "front ▁" not in (tmp_path / "run/run.log").read_text(encoding="utf-8")
    piped = subprocess.run([*RUN, "--stop-after", "2s", "--out", tmp_path / "piped"], capture_output=True, text=True, check=False)
    assert "▁" not in piped.stderr and "left" not in piped.stderr

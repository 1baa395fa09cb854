"""Processes that end with the one that started them, however it ends, and one user of a directory at a time."""

import atexit
import ctypes
import fcntl
import os
import signal
import sys
from pathlib import Path

PR_SET_PDEATHSIG = 1
LIBC = ctypes.CDLL(None, use_errno=True)


class Held(Exception):
    """Another process uses the directory: which one."""


def ends_with_parent(parent=None):
    """For preexec_fn: the new process is asked to end (SIGTERM) when the one that started it ends, even by SIGKILL."""
    parent = parent or os.getppid()
    LIBC.prctl(PR_SET_PDEATHSIG, signal.SIGTERM)
    if os.getppid() != parent:  # it ended between fork and prctl
        os._exit(143)


def end_cleanly_on_signals():
    """SIGTERM and SIGHUP end this program as an exception does, so that what it started is ended too. What the caller ignores
    (nohup) stays ignored, but SIGCHLD: how a child ended would not be told, and Python takes that for success."""
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    ends = (signal.SIGTERM, signal.SIGHUP)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, ends)
    for number in ends:
        if signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, lambda signum, frame: sys.exit(128 + signum))


class Holding:
    """A directory's lock, held until close(), the end of a `with`, or that of this process; the file goes with it."""

    def __init__(self, path, file):
        self.path, self.file, self.process = path, file, os.getpid()
        atexit.register(self.close)

    def close(self):
        if not self.file.closed and self.process == os.getpid():  # while it is held: nobody else's is removed
            self.path.unlink(missing_ok=True)
        self.file.close()

    def __enter__(self):
        return self

    def __exit__(self, *error):
        self.close()


def is_at(file, path):
    """Whether an open file is still the one of that name: who held it may have removed it meanwhile."""
    try:
        return os.path.samestat(os.fstat(file.fileno()), os.stat(path))
    except FileNotFoundError:
        return False


def hold(directory, who):
    """Takes `directory`/.lock, until the Holding that is returned is closed. Held where another process has it."""
    directory = Path(directory)
    directory.mkdir(parents=True, exist_ok=True)
    path = directory / ".lock"
    while True:
        lock = open(path, "a+", encoding="utf-8")  # inherited by nobody: closed on exec
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            lock.seek(0)
            holder = lock.read().strip() or "another process"
            lock.close()
            raise Held(f"{directory} is in use by {holder}") from None
        if is_at(lock, path):
            break
        lock.close()
    lock.truncate(0)
    lock.write(f"{who} (process {os.getpid()})\n")
    lock.flush()
    return Holding(path, lock)

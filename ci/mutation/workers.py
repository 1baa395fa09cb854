"""Several things at a time: each waits for a program of its own, so that threads do."""

import os
import queue
import threading
from pathlib import Path


def each(items, work, workers, scratch):
    """(item, work(item, directory)) of all items in the order in which they end, so many at a time; `directory` is the
    worker's own, below `scratch`. An exception of one is raised here. Workers do not outlive the program: their threads are
    daemons, and what they started ends with them (process.py)."""
    waiting, done = queue.SimpleQueue(), queue.SimpleQueue()
    items = list(items)
    for item in items:
        waiting.put(item)

    def run(directory):
        directory.mkdir(exist_ok=True)
        while True:
            try:
                item = waiting.get_nowait()
            except queue.Empty:
                return
            try:
                done.put((item, work(item, directory), None))
            except BaseException as error:  # raised by the caller's thread
                done.put((item, None, error))

    for number in range(min(workers, len(items))):
        threading.Thread(target=run, args=(Path(scratch) / f"worker-{number}",), daemon=True).start()
    for _ in items:
        item, result, error = done.get()
        if error is not None:
            raise error
        yield item, result


def as_many_as_cores():
    return len(os.sched_getaffinity(0))

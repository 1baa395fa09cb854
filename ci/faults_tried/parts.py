"""Tries shared out between processes: each does its part of every kind, and says what came of it."""

import multiprocessing
import resource
import time
import traceback

from faults_tried import kinds
from faults_tried.bench import NotTried, TableError
from night.together import ends_with_parent

# Of these each part would do all: they are one try, or use what there is once (a clone, a compiler).
UNDIVIDED = ("outputs", "locales", "long_runs", "thread_sanitizer", "orphans")


def done_by(kind, number, bench):
    """Whether a part does anything of the `number`-th kind."""
    return kind not in UNDIVIDED or number % bench.parts == bench.part


def core_seconds():
    used = (resource.getrusage(whose) for whose in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(one.ru_utime + one.ru_stime for one in used)


def try_kind(kind, entries, bench):
    """(results, reasons why some were not tried, faults of the table, seconds, core-seconds) of one kind."""
    results, left_out, broken, begun, used = [], [], [], time.monotonic(), core_seconds()
    bench.alone = kind in UNDIVIDED
    for entry in entries:
        try:
            results.extend(kinds.KINDS[kind](bench, entry))
        except NotTried as reason:
            left_out.append(str(reason))
        except TableError as error:  # the rest is tried all the same
            broken.append(f"{kind}: {error}")
            results.append(("the entry itself", str(error)))
        except Exception:  # of the tries themselves: no part may end with a hole
            broken.append(f"{kind}: {traceback.format_exc(limit=-1)}")
            results.append(("the entry itself", "the try ended with an exception"))
    return results, left_out, broken, time.monotonic() - begun, core_seconds() - used


def part_of(wanted, table, bench):
    """What a part makes of each kind, one after another."""
    for number, kind in enumerate(wanted):
        yield try_kind(kind, table[kind] if done_by(kind, number, bench) else [], bench)


def sent(wanted, table, bench, pipe):
    ends_with_parent()
    for made in part_of(wanted, table, bench):
        pipe.send(made)
    pipe.close()


def all_of(wanted, table, benches):
    """For each kind in turn, what all parts together make of it."""
    if len(benches) == 1:
        yield from part_of(wanted, table, benches[0])
        return
    context = multiprocessing.get_context("fork")
    pipes = []
    for bench in benches:
        ours, theirs = context.Pipe(duplex=False)
        context.Process(target=sent, args=(wanted, table, bench, theirs), daemon=True).start()
        theirs.close()
        pipes.append(ours)
    for kind in wanted:
        parts = []
        for pipe in pipes:
            try:
                parts.append(pipe.recv())
            except EOFError:
                parts.append(([("a part", "it ended before its end")], [], [f"{kind}: a part of the tries ended before its end"], 0.0, 0.0))
        results, left_out, broken = ([one for part in parts for one in part[column]] for column in range(3))
        yield results, list(dict.fromkeys(left_out)), broken, max(part[3] for part in parts), sum(part[4] for part in parts)

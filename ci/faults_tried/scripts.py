"""Odd surroundings of what is written in Python: they end as they do elsewhere."""

import shutil

from faults_tried.reading import Prepared

# Of a cluster's nodes, of containers, of cron: no home, no place for drafts, no words but ASCII, nothing on the path.
SURROUNDINGS = {"no home": {"HOME": "/nothing/there"}, "a home that is a device": {"HOME": "/dev/null"}, "an empty home": {"HOME": ""},
                "no place for temporary files": {"TMPDIR": "/nothing/there"}, "a device for temporary files": {"TMPDIR": "/dev/null"},
                "a read-only place for temporary files": {"TMPDIR": "/proc"},
                "words in ASCII alone": {"LC_ALL": "C", "PYTHONCOERCECLOCALE": "0", "PYTHONUTF8": "0", "PYTHONIOENCODING": "ascii"},
                "a locale that is none": {"LC_ALL": "nonsense"}, "nothing on the path": {"PATH": "/nothing"},
                "no room for plots' settings": {"MPLCONFIGDIR": "/proc/nothing", "HOME": "/proc"}, "a display that is none": {"MPLBACKEND": "TkAgg", "DISPLAY": ":99"},
                "a narrow terminal": {"COLUMNS": "1", "LINES": "0", "TERM": "nonsense"}, "modules of others": {"PYTHONPATH": "/proc", "PYTHONSTARTUP": "/dev/zero"},
                "no locks of HDF5": {"HDF5_USE_FILE_LOCKING": "FALSE"}, "optimised": {"PYTHONOPTIMIZE": "2", "PYTHONWARNINGS": "error::ResourceWarning"}}


def scripts(bench, entry):
    """A script in odd surroundings: the exit code of others, no traceback."""
    made = Prepared(bench, entry)
    tries = [(words, name) for words in entry["commands"] for name in entry["surroundings"]]
    codes = {}
    for words, name in bench.some(tries, entry["sample"]):
        if str(words) not in codes:
            place = bench.place()
            plain = bench.call(made.command(words, place), patience=600)
            codes[str(words)] = plain and plain.returncode
        place = bench.place()
        ended = bench.call(made.command(words, place), environment=SURROUNDINGS[name], patience=600)
        why = "no end" if ended is None else ""
        if not why and b"Traceback" in ended.stderr + ended.stdout:
            why = f"a traceback: {ended.stderr[-150:]!r}"
        if not why and ended.returncode != codes[str(words)]:
            why = f"exit code {ended.returncode} for {codes[str(words)]}: {ended.stderr[-200:]!r}"
        yield f"{' '.join(words[:2])}: {name}", why
        shutil.rmtree(place, ignore_errors=True)

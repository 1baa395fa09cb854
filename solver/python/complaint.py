"""What a script is given on its command line, and what it has to say of it: one line on stderr, fit for a terminal, whatever a
name holds; and how it ends where nobody can read what it prints."""

import argparse
import errno
import os
import signal
import sys
import unicodedata
from pathlib import Path

LEAST_DESCRIPTORS = 16  # beyond those that are open: a file and its folder, the two ends of what is read of another program
LONGEST = 1500  # characters; it holds the name of a directory
ESCAPED = ("Cc", "Cf", "Cs", "Zl", "Zp")  # controls, marks of direction, bytes that are no text, ends of lines and paragraphs


def printable(text, longest=LONGEST):
    """Characters that steer a terminal, and bytes that are no text, as escapes; of a longer text the beginning."""
    shown = "".join(f"\\u{ord(letter):04X}" if unicodedata.category(letter) in ESCAPED else letter for letter in text)
    return shown if len(shown) <= longest else f"{shown[:longest]}... ({len(text)} characters)"


def given_path(text):
    """For argparse: a path. Nothing ("--out "$OUT"" where OUT is not set) would be the folder that one is in."""
    if not text:
        raise argparse.ArgumentTypeError("'' given; a path is needed")
    return Path(text)


def complain(text):
    print(printable(str(text)), file=sys.stderr, flush=True)


def fill_streams():
    """A standard stream that the caller has closed: its number would be that of the next file opened. /dev/null, the other way
    round than the stream is used: what is read or printed there fails, messages are lost (as solver/output/standard_streams.hpp)."""
    for number, way in enumerate((os.O_WRONLY, os.O_RDONLY, os.O_RDWR)):
        try:
            os.fstat(number)
        except OSError:
            os.set_inheritable(os.open(os.devnull, way), True)
    if sys.stdout is None:
        sys.stdout = open(1, "w", closefd=False)
    if sys.stderr is None:
        sys.stderr = open(2, "w", closefd=False)


def has_descriptors(least=LEAST_DESCRIPTORS):
    """Whether so many files more can be opened; where not, that is said."""
    held = []
    try:
        for _ in range(least):
            held.append(os.open(os.devnull, os.O_RDONLY))
    except OSError as error:
        complain(f"{Path(sys.argv[0]).name}: {len(held)} files can be opened, needed: {least} (ulimit -n): {error.strerror}")
    for number in held:
        os.close(number)
    return len(held) == least


def ended(main, *arguments):
    """Exit code of a script: what `main` gives. Where its standard output cannot be written it is 1, after a line; where nobody
    reads it any more (`| head`), that of SIGPIPE, without a word. 2, after a line, where it may open too few files."""
    fill_streams()
    if not has_descriptors():
        return 2
    try:
        try:
            code = main(*arguments)
        except SystemExit as end:  # argparse has helped
            code = end.code
        sys.stdout.flush()
        return code
    except OSError as error:
        why = not_printable() if error.filename is None else None
        if why is None:
            raise
        with open(os.devnull, "w") as nowhere:  # for what is still to be written
            os.dup2(nowhere.fileno(), sys.stdout.fileno())
        if why.errno == errno.EPIPE:
            return 128 + signal.SIGPIPE
        complain(f"{Path(sys.argv[0]).name}: cannot write to standard output: {why.strerror}")
        return 1


def not_printable():
    """Why standard output takes nothing; None where it does."""
    try:
        sys.stdout.flush()
        os.write(sys.stdout.fileno(), b"\n")
    except OSError as error:
        return error
    return None

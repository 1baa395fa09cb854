"""What a script is given on its command line, and what it has to say of it: one line on stderr, fit for a terminal, whatever a
name holds; and how it ends where nobody can read what it prints."""

import argparse
import errno
import os
import signal
import sys
import unicodedata
from pathlib import Path

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


def ended(main, *arguments):
    """Exit code of a script: what `main` gives. Where its standard output cannot be written it is 1, after a line; where nobody
    reads it any more (`| head`), that of SIGPIPE, without a word."""
    try:
        try:
            code = main(*arguments)
        except SystemExit as end:  # argparse has helped
            code = end.code
        if sys.stdout is not None:  # closed by the caller
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

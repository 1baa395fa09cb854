"""What a script is given on its command line, and what it has to say of it: one line on stderr, fit for a terminal, whatever a
name holds."""

import argparse
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

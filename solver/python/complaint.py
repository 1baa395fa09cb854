"""What a program has to say of what it was given: one line on stderr, fit for a terminal, whatever a name holds."""

import sys
import unicodedata

LONGEST = 1500  # characters; it holds the name of a directory
ESCAPED = ("Cc", "Cf", "Cs", "Zl", "Zp")  # controls, marks of direction, bytes that are no text, ends of lines and paragraphs


def printable(text, longest=LONGEST):
    """Characters that steer a terminal, and bytes that are no text, as escapes; of a longer text the beginning."""
    shown = "".join(f"\\u{ord(letter):04X}" if unicodedata.category(letter) in ESCAPED else letter for letter in text)
    return shown if len(shown) <= longest else f"{shown[:longest]}... ({len(text)} characters)"


def complain(text):
    print(printable(str(text)), file=sys.stderr, flush=True)

"""All faults of a C++ file in one text, each behind a switch (switch.hpp), so that one build serves them all.

A fault changes a piece of text. The switch goes around the smallest whole expression, or else statement, that holds the
piece, once as it is and once with the fault: what the rest of the file means does not change.
"""

import re

SWITCH = "ci/mutation/switch.hpp"
INCLUDE = f'#include "{SWITCH}"\n'
SWITCHED = "GRANVOF_MUTATION_SWITCH"  # defined there
ASSIGNMENT = re.compile(r"(?<![=!<>+\-*/%&|^])[+\-*/%&|^]?=(?!=)|<<=|>>=|\+\+|--")
WORD = re.compile(r'"(?:\\.|[^"\\\n])*"|' r"[\w.]+|[+\-*/%&|<>=!^]+|[^\w\s]")
OPENING, CLOSING = "([{", ")]}"


class NoPlace(Exception):
    """Why a fault cannot be switched, in one line."""


def without_comments(text, strings=False):
    """The text with comments as blanks (and literal strings as one word each): every other character is where it was."""
    kinds = r'//[^\n]*|/\*.*?\*/' + (r"|\"(?:\\.|[^\"\\\n])*\"|(?<![\w])'(?:\\.|[^'\\\n])+'" if strings else r'|"(?:\\.|[^"\\\n])*"')

    def blank(match):
        piece = match.group()
        if piece.startswith("/"):
            return re.sub(r"[^\n]", " ", piece)
        return "_" * len(piece) if strings else piece

    return re.sub(kinds, blank, text, flags=re.DOTALL)


def matched(text, start, step, stop):
    """From `start` on, forwards or backwards, to the first place at the depth of the start where `stop` holds."""
    deeper, shallower = (OPENING, CLOSING) if step > 0 else (CLOSING, OPENING)
    depth, i = 0, start
    while 0 <= i < len(text):
        letter = text[i]
        if depth == 0 and (stop(i) or letter in shallower):
            return i
        depth += (letter in deeper) - (letter in shallower)
        i += step
    raise NoPlace("no end of the expression")


def ends_expression(text, conditional):
    """Where a whole expression ends; a `conditional` one goes on over its question mark and colon."""
    def stop(i):
        letter = text[i]
        if letter in ",;" or (not conditional and (letter == "?" or (letter == ":" and ":" not in (text[i - 1], text[i + 1])))):
            return True
        if letter == "}":  # of a block, and a statement begins behind it
            return re.match(r"}\s*\n\s*[A-Za-z_(*]", text[i:]) is not None
        return letter == "=" and bool(re.match(r"[^=!<>]=[^=]|[<>]{2}=[^=]", text[i - 1:i + 2]))
    return stop


def at_depth(piece, pattern):
    """Whether the pattern stands in the piece outside all brackets."""
    depth, level = 0, []
    for letter in piece:
        depth -= letter in CLOSING
        level.append(letter if depth == 0 else " ")
        depth += letter in OPENING
    return re.search(pattern, "".join(level)) is not None


def balanced(bare, start, end):
    """[start, end) enlarged until no bracket in it lacks its other half."""
    depth = least = 0
    for letter in bare[start:end]:
        depth += (letter in OPENING) - (letter in CLOSING)
        least = min(least, depth)
    for _ in range(-least):
        start = matched(bare, start - 1, -1, lambda i: False)
    for _ in range(depth - least):
        end = matched(bare, end, 1, lambda i: False) + 1
    return start, end


def whole(text, start, end):
    """(start, end, kind) of the smallest whole `expression`, `constant` or `statement` that holds [start, end)."""
    bare = without_comments(text, strings=True)
    start, end = balanced(bare, start, end)
    if at_depth(bare[start:end], ",") and not at_depth(bare[start:end], ";"):  # of several arguments: the call
        start, end = matched(bare, start - 1, -1, lambda i: False), matched(bare, end, 1, lambda i: False) + 1
    piece = bare[start:end]
    if not at_depth(piece, ASSIGNMENT.pattern + r"|;|\breturn\b|\bif\b|\bcontinue\b|\bbreak\b"):
        stop = ends_expression(bare, at_depth(piece, r"\?|(?<!:):(?!:)"))
        first = matched(bare, start - 1, -1, stop) + 1
        last = matched(bare, end, 1, stop)
        first = behind_keywords(bare, first, last)
        while bare[last - 1].isspace():
            last -= 1
        if last > end and bare[last - 1] in "+-*/%&|" and bare[last] == "=":  # the assignment's own operator
            raise NoPlace("in the left side of an assignment")
        head = bare[:first]
        if re.search(r"\b(?:if\s+constexpr|static_assert)\s*\(\s*$", head):
            raise NoPlace(f"{text[first:last]!r} is decided by the compiler")
        if re.search(r"\bconstexpr\b[^;()]*[={][^;()]*$", head):  # of one, or within a list of them
            return first, last, "constant"
        return first, last, "expression"
    first = begin_of_statement(bare, start)
    last = matched(bare, max(end - 1, start), 1, lambda i: bare[i] == ";") + 1 if piece.rstrip()[-1] != "}" else end
    first += len(re.match(r"\s*", bare[first:last]).group())
    return first, last, "statement"


def behind_keywords(bare, first, last):
    """Where the expression begins that a statement from `first` on returns, throws or decides by, behind conditions before it."""
    while True:
        first += len(re.match(r"\s*", bare[first:last]).group())
        head = re.match(r"(?:return|throw|else|case|(if(?:\s+constexpr)?|for|while)(?=\s*\())\b", bare[first:last])
        if head is None:
            return first
        first += head.end()
        if head.group(1):
            first = matched(bare, bare.index("(", first) + 1, 1, lambda i: False) + 1


def begin_of_statement(bare, start):
    """Behind the last `;` or closed block before `start`, or the brace around both."""
    depth = 0
    for i in range(start - 1, -1, -1):
        if depth == 0 and (bare[i] in ";}" or bare[i] in OPENING):
            return i + 1
        depth += (bare[i] in ")]") - (bare[i] in "([")
    raise NoPlace("no begin of the statement")


def differing(was, now):
    """(start, end, new): the piece of `was` that changes, and what it becomes: what both have in common at either end is context."""
    old, new = list(WORD.finditer(was)), list(WORD.finditer(now))
    first = 0
    while first < min(len(old), len(new)) and old[first].group() == new[first].group():
        first += 1
    last = 0
    while last < min(len(old), len(new)) - first and old[-1 - last].group() == new[-1 - last].group():
        last += 1
    middle = old[first:len(old) - last]
    start = middle[0].start() if middle else (old[first - 1].end() if first else 0)
    end = middle[-1].end() if middle else start
    kept = new[first:len(new) - last]
    return start, end, now[kept[0].start():kept[-1].end()] if kept else ""


def switched(text, faults):
    """The text with all faults in it. faults: (start, end, now, number). NoPlace where one cannot be switched."""
    pieces, reach, constants = [], 0, []
    for first, last, kind, members in wholes(text, faults):
        pieces += [text[reach:first], replaced(text, first, last, kind, members)]
        reach = last
        constants += [sum(map(len, pieces[:-1]))] if kind == "constant" else []
    result = "".join(pieces) + text[reach:]
    # No longer known to the compiler: set when the program starts. A list of several is one declaration.
    for at in sorted({result.rindex("constexpr", 0, place) for place in constants}, reverse=True):
        result = result[:at] + "const" + result[at + len("constexpr"):]
    return after_first_comment(result)


def wholes(text, faults):
    """(first, last, kind, faults in it) in the order of the text, one that lies within another as part of it."""
    found = []
    for fault in sorted(faults):
        first, last, kind = whole(text, *fault[:2])
        while found and first < found[-1][1]:
            outer = found.pop()
            if outer[0] > first or outer[1] < last:
                first, last, kind = min(first, outer[0]), max(last, outer[1]), kind if first <= outer[0] else outer[2]
            else:
                first, last, kind = outer[:3]
            fault = [*outer[3], *(fault if isinstance(fault, list) else [fault])]
        found.append((first, last, kind, fault if isinstance(fault, list) else [fault]))
    return found


def replaced(text, first, last, kind, members):
    own = text[first:last]
    with_fault = [(number, text[first:start] + now + text[end:last]) for start, end, now, number in members]
    if kind == "statement":
        # `;`: what is dropped may be all that a loop does
        arms = "".join(f"if (::granvof::mutation::on<0x{number}u>()) {{\n{changed}\n;\n}} else " for number, changed in with_fault)
        return f"{arms}{{\n{own}\n}}"
    on = "on_at_start" if kind == "constant" else "on"
    arms = "".join(f"::granvof::mutation::{on}<0x{number}u>() ? ({line_free(changed)}) : " for number, changed in with_fault)
    return f"({arms}({line_free(own)}))"


def where_switched(text, changed):
    """A header that is as it was, line by line, where the switch is not included: the preprocessor's text of what takes no fault
    stays the same. Its first line is a comment."""
    first, rest = text.split("\n", 1)
    if not first.startswith("//"):
        raise NoPlace("the first line of a header with faults is a comment")
    return f"#ifndef {SWITCHED}\n{rest}#else\n{changed}#endif\n"


def line_free(changed):
    return changed + "\n" if "//" in changed else changed


def after_first_comment(text):
    """With the switch included: before the first line that is neither comment nor empty nor #pragma once."""
    lines = text.splitlines(keepends=True)
    index = next((i for i, line in enumerate(lines) if line.startswith("#include")), len(lines))
    if index == len(lines):
        index = next(i for i, line in enumerate(lines) if line.strip() and not line.startswith(("//", "#")))
    return "".join(lines[:index]) + INCLUDE + "".join(lines[index:])

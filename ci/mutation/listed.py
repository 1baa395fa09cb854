"""The faults that are put in, from ci/mutants/*.toml: where each belongs, found by its text, and what it changes.

A table a file of the project, an entry a fault:

    ["solver/closures/drag/paper.hpp"]
    ergun-inertia-dropped = { was = "+ 1.75 * fluid.density", now = "+ 0.0 * fluid.density" }

`was` stands once in the file, in any spacing, comments left out; with `after`, once behind the first place of that
text. `why` says why no check can notice the fault. An entry whose place is not there, or not the only one, no longer
applies.
"""

import hashlib
import re
from dataclasses import dataclass

from granvof_files import toml_of
from mutation import cpp

FIELDS = {"was", "now", "after", "why"}


class ListError(Exception):
    """What is wrong with the list, in one line."""


def is_compiled(file):
    return file.endswith((".cpp", ".hpp"))


@dataclass(frozen=True)
class Mutant:
    file: str  # from the root of the project
    name: str
    was: str
    now: str
    after: str = ""
    why: str = ""  # no check can notice it: the reason

    @property
    def title(self):
        return f"{self.file}: {self.name}"

    @property
    def folder(self):
        return "/".join(self.file.split("/")[:2])

    @property
    def number(self):
        """Of eight hexadecimal digits, made of what the fault is: another fault has another, an edit elsewhere changes none."""
        return hashlib.sha1("\0".join((self.file, self.was, self.now, self.after)).encode()).hexdigest()[:8]

    @property
    def compiled(self):
        return is_compiled(self.file)


def read(directory):
    """All faults of the list, in its order. ListError where one is not as it should be."""
    found = []
    for path in sorted(directory.glob("*.toml")):
        try:
            table = toml_of(path)
        except (OSError, ValueError) as error:
            raise ListError(f"{path}: {' '.join(str(error).split())}") from error
        for file, entries in table.items():
            for name, entry in entries.items():
                if not isinstance(entry, dict) or not {"was", "now"} <= set(entry) <= FIELDS:
                    raise ListError(f"{path}: {file}: {name}: needs `was` and `now`, may have `after` and `why`")
                if not all(isinstance(value, str) for value in entry.values()) or not entry["was"].strip() or entry["was"] == entry["now"]:
                    raise ListError(f"{path}: {file}: {name}: all are texts, `was` is not empty, and `now` is another than `was`")
                found.append(Mutant(file, name, **entry))
    if not found:
        raise ListError(f"{directory}: no faults in it")
    seen = {}
    for mutant in found:
        if mutant.number in seen:
            raise ListError(f"{mutant.title} is the same as {seen[mutant.number].title}")
        seen[mutant.number] = mutant
    return found


def words(text):
    """A pattern of the text in any spacing."""
    return r"\s*".join(re.escape(word) for word in re.findall(r"\w+|[^\w\s]", text))


def place(mutant, text):
    """(start, end, new) in the file's text: the piece that changes, and what it becomes. ListError where it no longer applies."""
    seen = cpp.without_comments(text) if mutant.compiled else text
    start = 0
    if mutant.after:
        anchor = re.search(words(mutant.after), seen)
        if not anchor:
            raise ListError(f"{mutant.title} no longer applies: {mutant.after!r} is not there")
        start = anchor.end()
    places = list(re.finditer(bounded(mutant.was), seen[start:]))
    if not places:
        raise ListError(f"{mutant.title} no longer applies: {mutant.was!r} is not there")
    if len(places) > 1 and not mutant.after:
        raise ListError(f"{mutant.title} no longer applies: {mutant.was!r} stands there {len(places)} times")
    begin, end = start + places[0].start(), start + places[0].end()
    first, last, new = cpp.differing(text[begin:end], mutant.now)
    return begin + first, begin + last, new


def bounded(text):
    """The same, neither of its ends within a word or number."""
    before = r"(?<![\w.])" if re.match(r"[\w.]", text) else ""
    behind = r"(?![\w.])" if re.search(r"\d$", text) else r"(?!\w)" if re.search(r"\w$", text) else ""
    return before + words(text) + behind


def places(mutants, root):
    """Where each applies: {mutant: (start, end, new)}, and a sentence for each that no longer does."""
    texts, found, gone = {}, {}, []
    for mutant in mutants:
        try:
            if mutant.file not in texts:
                texts[mutant.file] = (root / mutant.file).read_text(encoding="utf-8")
            found[mutant] = place(mutant, texts[mutant.file])
        except OSError:
            gone.append(f"{mutant.title} no longer applies: there is no such file")
        except ListError as error:
            gone.append(str(error))
    return found, gone

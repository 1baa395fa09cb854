"""Whether what two versions of granvof gave can be compared: within one minor version (CHANGELOG.md)."""

import re

NOT_COMPARABLE = ", of an older minor version: not comparable"


def minor(text):
    """(MAJOR, MINOR) of the first version that a text states; None where it states none."""
    found = re.search(r"\b(\d+)\.(\d+)\.\d+", text or "")
    return (int(found[1]), int(found[2])) if found else None


def newest(texts):
    """The newest minor version stated in any of the texts; None where none is."""
    return max((found for text in texts if (found := minor(text))), default=None)


def remark(made, now):
    """What is to be said beside results made by the version in `made`, on a page of the minor version `now`; "" where nothing is."""
    of = minor(made)
    return NOT_COMPARABLE if of and now and of < now else ""


def named(made, now):
    """`made` with that remark."""
    return made + remark(made, now)

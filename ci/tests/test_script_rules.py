"""Rules that every script of ours keeps, read in its source."""

import ast
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
OF_THE_TREE = ("ci/mutation", "ci/mutate", "ci/tidy", "ci/faults_tried", "ci/night/guard.py",
               "compare/report/trust_table.py")  # they read sources and /proc, and what they made
READS = {"open", "read_text", "read_bytes", "File", "connect"}  # of pathlib, of h5py and sqlite3
BY_NAME = {"File", "connect", "Image.open"}  # of libraries that open by name
OPENERS = ("solver/python/granvof_files.py", "solver/python/complaint.py")  # the readers themselves, and /dev/null
NOT_TOLD = ("ci/mutation/", "ci/tidy", "ci/fuzz", "ci/manuals")  # what they start is ended as a group, or is a build


def scripts(left_out):
    """Name and tree of every script but those whose names begin so."""
    for folder in ("solver/python", "compare", "reference", "ci"):
        for path in sorted((ROOT / folder).rglob("*")):
            name = str(path.relative_to(ROOT))
            if path.is_file() and path.suffix in ("", ".py") and "/tests/" not in name and not name.startswith(left_out):
                text = path.read_text(encoding="utf-8", errors="replace")
                if path.suffix == ".py" or text.startswith("#!/usr/bin/python3"):
                    yield name, ast.parse(text)


def is_for_writing(call):
    modes = [word.value for word in (*call.args[:2], *(keyword.value for keyword in call.keywords)) if isinstance(word, ast.Constant)]
    return any(isinstance(mode, str) and mode and mode[0] in "wax" and len(mode) <= 3 for mode in modes)


def is_asked(call):
    """Whether what is opened is the kernel's, or a library's that goes through required()."""
    opened = [call.func] + call.args[:1]
    words = {getattr(part.func, "id", "") for whole in opened for part in ast.walk(whole) if isinstance(part, ast.Call)}
    texts = [part.value for whole in opened for part in ast.walk(whole) if isinstance(part, ast.Constant) and isinstance(part.value, str)]
    by_name = any(ast.unparse(call.func).endswith(name) for name in BY_NAME)
    return (by_name and "required" in words) or any(text.startswith("/proc") for text in texts)


def is_a_read(call):
    if isinstance(call.func, ast.Name):
        return call.func.id == "open"
    return isinstance(call.func, ast.Attribute) and call.func.attr in READS and not is_for_writing(call)


def test_every_script_asks_before_it_opens():
    """A reader that is added must not wait for a pipe either: opened(), text_of() and bytes_of() stand for open(), Path.open(),
    read_text() and their like; what a library opens by name takes required(path)."""
    unasked = [f"{name}:{call.lineno}" for name, tree in scripts((*OF_THE_TREE, *OPENERS)) for call in ast.walk(tree)
               if isinstance(call, ast.Call) and is_a_read(call) and not is_for_writing(call) and not is_asked(call)]
    assert unasked == []


def test_nobody_parses_without_asking_how_deep():
    """A reader that is added must not fall over depth either: json_in, json_of, toml_in and toml_of ask."""
    parsed = [f"{name}:{call.lineno}" for name, tree in scripts(OF_THE_TREE) for call in ast.walk(tree)
              if isinstance(call, ast.Call) and isinstance(call.func, ast.Attribute) and call.func.attr in ("load", "loads")
              and getattr(call.func.value, "id", "") in ("json", "tomllib") and name != "solver/python/granvof_files.py"]
    assert parsed == []


def starts(call):
    return isinstance(call.func, ast.Attribute) and call.func.attr in ("run", "Popen") and getattr(call.func.value, "id", "") == "subprocess"


def test_every_script_sees_to_the_end_of_what_it_starts():
    """Whatever is neither a question whose answer is waited for nor fed with all it reads is told when its parent ends: preexec_fn=ends_with_parent."""
    untold = [f"{name}:{call.lineno}" for name, tree in scripts(NOT_TOLD) for call in ast.walk(tree) if isinstance(call, ast.Call) and starts(call)
              if not {"preexec_fn", "capture_output", "input"} & {word.arg for word in call.keywords}]
    assert untold == []


def is_called(tree, name):
    return any(isinstance(call, ast.Call) and getattr(call.func, "id", "") == name for call in ast.walk(tree))


def test_every_program_ends_as_the_others_do():
    """Closed streams, output that cannot be written and too few descriptors are one line and an exit code: main goes through ended(). The
    night's guard ends with the code of what it guards."""
    programs = [name for name, tree in scripts(("ci/night/guard.py",)) if (ROOT / name).stat().st_mode & 0o100 and not is_called(tree, "ended")]
    assert programs == []

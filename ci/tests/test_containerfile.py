"""The Containerfile, step by step in a directory of its own: what needs no container is made, the rest is tried dry."""

import fnmatch
import shutil
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
# What a test may not do to this machine, or has no time for, and what is tried in its place.
IN_PLACE_OF = {"ci/setup": "ci/setup --check", "rm -rf /var/lib/apt/lists/*": "true",
               "cmake --build --preset release --target programs": "ninja -C build/release -n programs"}


def instructions(text):
    """(WORD, rest) of each, in order."""
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
    return [tuple(line.split(None, 1)) for line in "\n".join(lines).replace("\\\n", "").splitlines()]


def ignored(name, patterns):
    """Whether the file is no part of what is sent to the container: it, or a folder it lies in, matches a pattern."""
    parts = name.split("/")
    heads = ["/".join(parts[:count]) for count in range(1, len(parts) + 1)]
    return any(fnmatch.fnmatchcase(head, pattern) or (pattern.startswith("**/") and fnmatch.fnmatchcase(head.split("/")[-1], pattern[3:]))
               for head in heads for pattern in patterns)


def context(directory):
    """A clone in which something was built and run before."""
    subprocess.run(["git", "clone", "-q", "--no-hardlinks", ROOT, directory], check=True)
    for name in (".dockerignore", "Containerfile"):
        shutil.copy(ROOT / name, directory)
    for name in ("build/release/CMakeCache.txt", "out/runs/s1/run.json", "ci/__pycache__/a.pyc"):
        (directory / name).parent.mkdir(parents=True, exist_ok=True)
        (directory / name).write_text("CMAKE_HOME_DIRECTORY:INTERNAL=/elsewhere\n")
    return directory


def sent(directory):
    patterns = [line for line in (directory / ".dockerignore").read_text().splitlines() if line and not line.startswith("#")]
    return [name for name in (path.relative_to(directory).as_posix() for path in sorted(directory.rglob("*")) if path.is_file())
            if not ignored(name, patterns)]


def copy(source, destination, here, image):
    for name in sent(here):
        if source == "." or name == source or name.startswith(f"{source}/"):
            target = image / (name if source == "." else destination + name[len(source):])
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(here / name, target)


def test_nothing_that_was_built_or_run_here_is_sent(tmp_path):
    names = sent(context(tmp_path / "here"))
    assert "CMakePresets.json" in names and "cases/s1.toml" in names and "ci/build" in names
    assert [name for name in names if name.split("/")[0] in ("build", "out") or "__pycache__" in name] == []


def test_each_step_can_be_made(tmp_path):
    here, image, command = context(tmp_path / "here"), tmp_path / "image", None
    image.mkdir()
    made = []
    for word, rest in instructions((here / "Containerfile").read_text()):
        made.append(word)
        if word == "COPY":
            copy(*rest.split(), here, image)
        elif word == "RUN":
            for step in rest.split(" && "):
                ended = subprocess.run(["bash", "-ec", IN_PLACE_OF.get(step, step)], cwd=image, capture_output=True, text=True)
                assert ended.returncode == 0, f"{step}\n{ended.stdout}{ended.stderr}"
        elif word == "CMD":
            command = rest
    assert made == ["FROM", "WORKDIR", "COPY", "RUN", "COPY", "RUN", "CMD"]
    assert command == '["build/release/solver/granvof", "--help"]'
    listed = subprocess.run(["ninja", "-C", "build/release", "-t", "query", "solver/granvof"], cwd=image, capture_output=True, text=True)
    assert listed.returncode == 0, listed.stderr  # what the container starts is what was built

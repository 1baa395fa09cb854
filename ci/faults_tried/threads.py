"""Data races, by the thread sanitizer.

GCC's OpenMP library is not instrumented: its barriers and reductions would all be reported. So the solver is built by clang
with LLVM's library, whose tool interface (OMPT) lets Archer tell the sanitizer what a barrier orders; what happens inside
libraries that are not instrumented is left out, as Archer asks for (https://github.com/llvm/llvm-project, openmp/tools/archer).
"""

import os
import shutil
import subprocess
import time
from pathlib import Path

from faults_tried.bench import NotTried, TableError, told_of_our_end

FLAGS = ["-fsanitize=thread", "-O1", "-gline-tables-only", "-Wno-pass-failed"]  # what -O1 does not vectorise is none of our business
FOUND = 66  # exit code of a program in which the sanitizer has found something
PATIENCE = 3600.0

RACE = """#include <cstdio>
int main() {
  long sum = 0, shared = 0;
#pragma omp parallel for reduction(+ : sum) num_threads(2)
  for (int i = 0; i < 1000; ++i) sum += i;
#ifdef RACE
#pragma omp parallel for num_threads(2)
  for (int i = 0; i < 1000; ++i) shared += i;
#endif
  std::printf("%ld %ld\\n", sum, shared);
}
"""


def tools():
    """clang and the path of Archer; NotTried where one of them is missing."""
    archers = sorted(Path("/usr/lib").glob("llvm-*/lib/libarcher.so"))
    compiler = shutil.which("clang++")
    if not compiler or not archers:
        raise NotTried("clang++ and LLVM's OpenMP with Archer (libomp-dev) are not installed")
    return compiler, archers[-1]


def most_threads(process):
    """Waits for the end of a process, and says how many threads it had at most."""
    most = 0
    while process.poll() is None:
        try:
            status = Path(f"/proc/{process.pid}/status").read_text()
            most = max(most, *(int(line.split()[1]) for line in status.splitlines() if line.startswith("Threads:")))
        except (OSError, TypeError):
            pass  # it has ended
        time.sleep(0.02)
    return most


def threads_of(bench, command, archer, threads):
    """(exit code, what it said, threads at most) under the sanitizer, which has one of its own."""
    place = bench.place()
    environment = {**os.environ, **settings(archer, threads)}
    with open(place / "said", "wb") as said:
        process = subprocess.Popen([str(word) for word in command], cwd=bench.root, stdin=subprocess.DEVNULL, stdout=said, stderr=said,
                                   env=environment, preexec_fn=told_of_our_end())
        most = most_threads(process)
    return process.returncode, (place / "said").read_text(errors="replace"), most - 1


def settings(archer, threads):
    return {"OMP_TOOL_LIBRARIES": str(archer), "ARCHER_OPTIONS": "verbose=1", "OMP_NUM_THREADS": str(threads),
            "TSAN_OPTIONS": f"ignore_noninstrumented_modules=1 exitcode={FOUND}"}


def under_it(bench, command, archer, threads=2, alone=False):
    """How a program ends under the sanitizer; TableError where Archer was not there. `alone`: the program may do without OpenMP."""
    ended = bench.call(command, environment=settings(archer, threads), patience=PATIENCE)
    said = ended.stderr.decode(errors="replace") + ended.stdout.decode(errors="replace") if ended else ""
    if not alone and "Archer detected OpenMP application with TSan" not in said:
        raise TableError(f"Archer was not loaded: {said[-200:]!r}")
    return ended and ended.returncode, said


def races(code, said):
    return "" if code == 0 and "WARNING: ThreadSanitizer" not in said else \
        f"exit code {code}: " + said[max(0, said.find("WARNING: ThreadSanitizer")):][:300]


def seen(bench, compiler, archer):
    """Whether a race is told from a reduction: without it silence says nothing."""
    place = bench.place()
    (place / "race.cpp").write_text(RACE)
    for name, define, found in (("a race is seen", ["-DRACE"], True), ("a reduction is none", [], False)):
        built = subprocess.run([compiler, *FLAGS, "-fopenmp", *define, "race.cpp", "-o", "race"], cwd=place, capture_output=True, text=True)
        if built.returncode != 0:
            raise NotTried(f"clang++ with the thread sanitizer builds nothing: {built.stderr.strip()[:150]}")
        code, _ = under_it(bench, [place / "race"], archer)
        yield name, "" if (code == FOUND) == found else f"exit code {code}"


def built(bench, compiler, targets):
    """The build folder with these targets under the sanitizer. Seven files at a time, whose headers are then read once: four minutes
    of one core for the program, where each file alone takes a quarter of an hour."""
    build = bench.build.parent / "threads"
    configure = ["cmake", "-S", bench.root, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=None", f"-DCMAKE_CXX_COMPILER={compiler}",
                 f"-DCMAKE_CXX_FLAGS={' '.join(FLAGS)}", "-DGRANVOF_REFERENCE=OFF", "-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=7"]
    cached = {**os.environ, "CCACHE_BASEDIR": str(bench.root), "CCACHE_NOHASHDIR": "1"}
    for command in (configure, ["cmake", "--build", build, "--parallel", str(os.cpu_count()), "--target", *targets]):
        made = subprocess.run([str(word) for word in command], capture_output=True, text=True, env=cached)
        if made.returncode != 0:
            raise TableError(f"{command[0]} {command[1]}: {(made.stdout + made.stderr).strip()[-300:]}")
    return build


def thread_sanitizer(bench, entry):
    """Several threads under the thread sanitizer: silent. Not in a sample: it builds the solver a second time."""
    if bench.sample:
        return
    compiler, archer = tools()
    yield from seen(bench, compiler, archer)
    tests = entry.get("tests", [])
    build = built(bench, compiler, ["granvof_program", *tests])
    for threads in entry["threads"]:
        for case in entry.get("cases", []):
            sets = [word for override in entry["set"] for word in ("--set", override)]
            command = [build / "solver/granvof", "run", case, *sets, "--threads", str(threads), "--out", bench.place() / "run"]
            code, said, most = threads_of(bench, command, archer, threads)
            if not said.count("Archer detected OpenMP application with TSan"):
                raise TableError(f"Archer was not loaded: {said[-200:]!r}")
            why = races(code, said)
            # Short loops are done by one thread, of which silence says nothing.
            yield f"{case} with {threads} threads", why or ("" if most >= threads else f"it had {most} threads: the grid is too coarse for more")
        for test in tests:
            program = next(path for path in sorted(build.glob(f"solver/**/{test}")) if path.is_file())
            yield f"{test} with {threads} threads", races(*under_it(bench, [program], archer, threads, alone=True))

"""Memory of a command that reads a file: a limit while it reads, and none afterwards."""

import os
import subprocess
import sys

from app.processes.limits import lower_thread_priority
from tests.conftest import ROOT

READ = """
import resource
from app.processes import limits
limits.READING_MAX = 300_000_000
before = resource.getrlimit(resource.RLIMIT_AS)
with limits.reading():
    assert len(b"x" * 200_000_000) == 200_000_000
assert resource.getrlimit(resource.RLIMIT_AS) == before
assert 2e8 < limits.peak_memory() < 4e8
print(open("/proc/self/oom_score_adj").read().strip())
try:
    with limits.reading():
        bytes(400_000_000)
except limits.TooMuchWork as error:
    print(error)
assert len(bytes(400_000_000)) == 400_000_000
try:
    with limits.reading():
        raise KeyError
except KeyError:
    assert resource.getrlimit(resource.RLIMIT_AS) == before
"""


def test_reading_has_a_limit_and_the_process_is_the_first_to_end():
    done = subprocess.run([sys.executable, "-c", READ], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.stderr == ""
    assert done.stdout.splitlines() == [
        "1000",
        "the file must be simpler: reading it takes more than 1000 MB of memory",
    ]


def test_a_limit_that_is_lower_already_stays():
    limited = f"import resource\nresource.setrlimit(resource.RLIMIT_AS, (2_000_000_000,) * 2)\n{READ}"
    done = subprocess.run([sys.executable, "-c", limited], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


GRADE = """
import sys
import openpyxl
from app.command.main import app
from app.processes import limits
limits.READING_MAX = 8_000_000
sys.argv = ["bench-dragon", "grade", *sys.argv[1:]]
app()
"""


def test_a_student_whose_file_needs_too_much_memory_does_not_stop_the_others(tmp_path):
    (tmp_path / "a.csv").write_bytes(b"word," * 3_000_000)
    (tmp_path / "b.csv").write_text("a,b")
    words = [sys.executable, "-c", GRADE, str(tmp_path)]
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    text = " ".join(done.stdout.split())  # The lines are as wide as a terminal.
    assert text.count("The file was not read: that takes more than 8 MB of memory.") == 1
    assert "b.csv: unreadable" in text


def test_the_first_thread_of_a_process_keeps_its_priority():
    """Threads that a computation starts later would inherit a lower one."""
    before = os.nice(0)
    lower_thread_priority(os.getpid())
    assert os.nice(0) == before

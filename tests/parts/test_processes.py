"""Child processes: what they import, how they answer, and that none outlives its parent."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import process_functions
import pytest
from waiting import alive, until

from fe_models.errors import DiskFullError, InputError
from fe_models.processes import Child, ChildError, may_copy, performed_beside

HERE = str(Path(__file__).parent)

linux = pytest.mark.skipif(sys.platform != "linux", reason="no process is copied there")
way = pytest.mark.parametrize("copied", [pytest.param(True, marks=linux, id="copy"), False])


def child(name, copied=False, **options):
    """Return a child that performs one of `process_functions`."""
    function = getattr(process_functions, name)
    return Child(function if copied else f"process_functions:{name}", **options)


@way
def test_requests_are_answered_in_their_order(copied, capfd):
    reports = []
    with child("square", copied, progress=lambda *values: reports.append(values)) as squares:
        for x in range(20):
            squares.request(x)
        assert [squares.answer() for _ in range(20)] == [x * x for x in range(20)]
        assert squares.alive
    assert not squares.alive
    assert reports == [("squares", x) for x in range(20)]
    assert capfd.readouterr() == ("", "")


@way
def test_a_value_is_computed_beside_or_when_it_is_asked_for(copied, monkeypatch):
    monkeypatch.setattr("os.cpu_count", lambda: 2)
    monkeypatch.setattr("fe_models.processes.may_copy", lambda: copied)
    with performed_beside(lambda x: (x, os.getpid())) as begin:
        answers = [begin(x) for x in range(2)]
        for x, answer in enumerate(answers):
            value, process = answer()
            assert value == x and (process == os.getpid()) == (not copied)


@way
def test_a_child_goes_on_while_its_answers_wait(copied):
    """Answers that no pipe holds do not keep it from the next request."""
    with child("large", copied) as process:
        for _ in range(2):
            process.request(4)
        time.sleep(0.5)
        (first, number), (second, same) = process.answer(), process.answer()
    assert len(first) == len(second) == 4 and number == same == process.pid


@way
@pytest.mark.parametrize(
    ("name", "kind", "text"),
    [
        ("refuses", InputError, "no such thing"),
        ("fails", ChildError, "ValueError: no number"),
        ("mourns", ChildError, "exit status 7: about to go"),
        ("breaks_down", ChildError, "exit status 1: OSError: no more"),
        ("fills_a_disk", DiskFullError, "/small/file: cannot be written (No space left on device)"),
    ],
)
def test_what_goes_wrong_is_told(copied, name, kind, text):
    with child(name, copied) as process:
        process.request()
        with pytest.raises(kind) as told:
            process.answer()
    assert str(told.value) == text


ASKS = """
from fe_models.processes import Child, ChildError, may_copy, performed_beside
print("the script runs")
with Child("process_functions:folder_of_json") as child:
    child.request()
    print(*child.answer(), sep="\\n")
"""


@pytest.mark.parametrize("way", ["script", "-m", "-c"])
def test_a_child_runs_no_script_and_nothing_of_the_working_folder(way, tmp_path):
    """A json.py where one works is imported by nobody; folders that the user names are searched."""
    work, other = tmp_path / "work", tmp_path / "other"
    work.mkdir()
    other.mkdir()
    (work / "json.py").write_text("print('hostile')\n")
    (other / "asking.py").write_text(ASKS)
    command = {
        "script": [str(other / "asking.py")],
        "-m": ["-m", "asking"],
        "-c": ["-c", "import asking"],
    }[way]
    named = os.pathsep.join([HERE, str(other)])
    done = subprocess.run(
        [sys.executable, *command],
        env={**os.environ, "PYTHONPATH": named, "PYTHONSAFEPATH": ""},
        cwd=work,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    assert lines.count("the script runs") == 1
    assert Path(lines[-2]).parent.name == "json" and str(work) not in lines[-1]
    assert HERE in lines[-1] and str(other) in lines[-1]
    assert done.stdout.count("hostile") == 0


PARENT = """
import sys; sys.path[:] = {path!r}
import os, process_functions
from fe_models.processes import Child, ChildError, may_copy, performed_beside
function = process_functions.deaf if {copied} else "process_functions:deaf"
with Child(function) as child:
    child.request({mark!r})
    child.answer()
"""


@way
@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGTERM, signal.SIGHUP, signal.SIGSEGV])
def test_no_child_outlives_its_parent(copied, how, tmp_path):
    """Not even one in compiled code, in which no other thread of Python runs."""
    mark = tmp_path / "mark"
    code = PARENT.format(path=[HERE, *sys.path], copied=copied, mark=str(mark))
    parent = subprocess.Popen([sys.executable, "-c", code], stderr=subprocess.DEVNULL)
    end_with(parent, mark, how)


def end_with(parent, mark, how):
    """End a process by a signal once its child has left a mark, and wait for the child's end."""
    until(lambda: mark.exists() and mark.read_text(), 30.0)
    number = int(mark.read_text())
    assert parent.poll() is None and alive(number)
    parent.send_signal(how)
    parent.wait()
    until(lambda: not alive(number), 10.0)


def test_without_linux_a_closed_pipe_ends_a_child(tmp_path):
    """The portable way alone, as on systems that kill no orphans."""
    functions = tmp_path / "functions.py"
    functions.write_text(
        "import os, time\n"
        "def runs_on(mark):\n"
        "    import ctypes; ctypes.CDLL(None).prctl(1, 0)\n"  # nothing kills it
        "    open(mark, 'w').write(str(os.getpid()))\n"
        "    time.sleep(600.0)\n"
    )
    mark = tmp_path / "mark"
    code = (
        f"import sys; sys.path[:] = {[str(tmp_path), *sys.path]!r}\n"
        "from fe_models.processes import Child\n"
        "child = Child('functions:runs_on')\n"
        f"child.request({str(mark)!r}); child.answer()"
    )
    parent = subprocess.Popen([sys.executable, "-c", code])
    end_with(parent, mark, signal.SIGKILL)


def test_beside_ngsolve_there_is_no_copy(monkeypatch):
    monkeypatch.setitem(sys.modules, "ngsolve", object())
    assert not may_copy()

"""Runs of a program, for the tests of those in Python."""
import functools
import subprocess


def _run(program, case, *words, code=0):
    done = subprocess.run([program, "-case", case, *map(str, words)], capture_output=True, text=True)
    assert done.returncode == code, (words, done.returncode, done.stdout, done.stderr)
    return done.stdout if code == 0 else done.stderr


def _refused(program, case, code, messages, *words):
    text = _run(program, case, *words, code=code)
    messages = [messages] if isinstance(messages, str) else messages
    assert all(message in text for message in messages) and "Traceback" not in text, (messages, text)


def runs(program):
    """run(case, *words, code) returns what is printed; refused(case, code, messages, *words) asks for a message, or for each of several."""
    return functools.partial(_run, program), functools.partial(_refused, program)

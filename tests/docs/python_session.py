# SPDX-License-Identifier: MIT
"""One Python interpreter for the blocks of a page: what a block defines, the next one sees.

PythonSession is the side of the tests; run as a program, this file is the interpreter. Blocks go in
and output comes out as one line of JSON each."""

import io
import json
import os
import subprocess
import sys
import threading
import traceback
from contextlib import redirect_stderr, redirect_stdout


class PythonSession:
    """run(code) -> (exit code, what it printed); an uncaught exception is exit code 1."""

    def __init__(self, directory, environment: dict[str, str], seconds: float):
        self.seconds = seconds
        self.process = subprocess.Popen(
            [sys.executable, __file__], cwd=directory, env=environment, text=True,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE)

    def run(self, code: str) -> tuple[int, str]:
        watchdog = threading.Timer(self.seconds, self.process.kill)
        watchdog.start()
        try:
            self.process.stdin.write(json.dumps(code) + "\n")
            self.process.stdin.flush()
            answer = self.process.stdout.readline()
        finally:
            watchdog.cancel()
        if not answer:
            return self.process.wait(), "(the interpreter died, or was stopped for taking too long)"
        return tuple(json.loads(answer))

    def close(self):
        self.process.stdin.close()
        self.process.stdout.close()
        self.process.wait()


def interpreter():
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # what bypasses sys.stdout must not mix with the answers
    names = {"__name__": "__main__"}
    for line in sys.stdin:
        printed, status = io.StringIO(), 0
        with redirect_stdout(printed), redirect_stderr(printed):
            try:
                exec(compile(json.loads(line), "<stdin>", "exec"), names)
            except SystemExit as stop:
                status = stop.code if isinstance(stop.code, int) else 1
            except BaseException as error:
                # as an interpreter shows it: from the block on
                traceback.print_exception(type(error), error, error.__traceback__.tb_next)
                status = 1
        answers.write(json.dumps([status, printed.getvalue()]) + "\n")
        answers.flush()


if __name__ == "__main__":
    interpreter()

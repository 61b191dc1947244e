# SPDX-License-Identifier: MIT
"""What bash and zsh offer for a command line of polhode: at a Tab, and for every option."""

import os
import pty
import re
import select
import subprocess
import time

import pytest
from slowdown import SLOWDOWN

# bash has compopt within a completion alone; here it says which paths the shell would offer
ASKED = """
eval "$("$1" completion bash)"
shift
compopt() { echo "paths: $2"; }
COMP_WORDS=("$@")
COMP_CWORD=$(($# - 1))
_polhode
printf '%s\\n' "${COMPREPLY[@]}"
"""


@pytest.fixture(scope="module")
def offered(polhode):
    """offered("run", "--o") -> what bash would offer for the last word of `polhode run --o`."""

    def ask(*words):
        done = subprocess.run(["bash", "-c", ASKED, "bash", polhode, "polhode", *words], text=True,
                              capture_output=True)
        assert not done.stderr, done.stderr
        return done.stdout.split("\n")[:-1]

    return ask


def commands_of(text):
    return re.findall(r"(?m)^  ([a-z]+)  ", text[text.index("Subcommands:"):])


def options_of(text):
    """The options, long and short, that a help text lists."""
    lines = re.findall(r"(?m)^  (-[^ ]*)", text)
    return {name for line in lines for name in line.split(",")}


@pytest.fixture(scope="module")
def commands(run):
    return commands_of(run("--help").stdout)


def test_help_and_the_reference_name_every_command(commands, root):
    assert {"run", "map", "info", "schema", "completion"} <= set(commands)
    page = (root / "docs/reference/cli.md").read_text()
    for command in commands:
        assert f"| `polhode {command}" in page, f"docs/reference/cli.md has no row for {command}"


def test_bash_offers_the_commands_and_options_of_the_help(run, offered, commands):
    assert offered("") == commands
    assert set(offered("-")) == options_of(run("--help").stdout)
    assert offered("in") == [name for name in commands if name.startswith("in")]
    for command in commands:
        assert set(offered(command, "-")) == options_of(run(command, "--help").stdout), command


def test_bash_offers_what_an_option_takes(run, offered):
    for command, option, words in re.findall(
            r"(\S+) (--\S+) (\S+)",
            "nutation --planet earth,venus,mars nutation --axis momentum,figure,rotation"):
        assert offered(command, option, "") == words.split(",")
        assert offered(command, option, "=", words[:2]) == [words.split(",")[0]]
    assert offered("schema", "") == ["json", "keys", "units", "columns"]
    assert {"rotor", "andoyer", "aem"} <= set(offered("convert", "--from", ""))
    assert "csv" in offered("convert", "--from", "aem", "--to", "")
    assert offered("init", "gravity-g") == ["gravity-gradient"]
    kinds = run("init", "no-such-kind").stderr
    assert len(offered("init", "")) > 20
    assert not [word for word in offered("init", "") if not re.search(rf"[ (]{word}[,)]", kinds)]
    assert offered("run", "") == offered("run", "a.toml", "--out", "a") == ["paths: default", ""]
    assert offered("golden", "") == ["paths: dirnames", ""]
    assert offered("run", "--checkpoint", "") == [""]  # a number
    assert offered("run", "--resume", "a.t") == ["paths: default", ""]  # takes no value


# A shell at a terminal. `polhode` is then a function that says what it was called with.
SHELLS = {
    "bash": (["bash", "--norc", "--noprofile", "-i"], "", "complete -p polhode\n"),
    "zsh": (["zsh", "-f", "-i"], "autoload -U compinit && compinit -u -D\n",
            "print -r ${_comps[polhode]}\n"),
}
SAYS = "polhode() { echo \"<$*>\"; }\n"


class Terminal:
    def __init__(self, command, folder):
        self.ours, theirs = pty.openpty()
        self.shell = subprocess.Popen(
            command, stdin=theirs, stdout=theirs, stderr=theirs, cwd=folder, close_fds=True,
            start_new_session=True,
            env={"PATH": os.environ["PATH"], "TERM": "vt100", "HOME": str(folder), "PS1": "$ ",
                 "LANG": "C.UTF-8"})
        os.close(theirs)

    def said(self, keys, expected):
        """All that the shell shows, from these keys to the text that is expected."""
        os.write(self.ours, keys.encode())
        shown, end = "", time.monotonic() + 20 * SLOWDOWN
        while expected not in shown:
            ready, _, _ = select.select([self.ours], [], [], 1)
            assert time.monotonic() < end, f"expected {expected!r} after {keys!r}, got {shown!r}"
            if not ready:
                continue
            shown += os.read(self.ours, 4096).decode(errors="replace")
        return shown

    def close(self):
        self.shell.kill()
        self.shell.wait()
        os.close(self.ours)


@pytest.fixture(params=SHELLS)
def terminal(request, polhode, tmp_path):
    command, before, registered = SHELLS[request.param]
    (tmp_path / "apophis.toml").write_text("schema = 1\n")
    terminal = Terminal(command, tmp_path)
    terminal.said(f"{before}eval \"$({polhode} completion {request.param})\"\n"
                  f"{SAYS}{registered}echo ready-$((1 + 1))\n", "ready-2")
    yield terminal
    terminal.close()


def test_a_tab_completes_commands_options_words_and_files(terminal):
    terminal.said("polhode inf\tap\t\n", "<info apophis.toml>")
    terminal.said("polhode init gravity-gr\t\n", "<init gravity-gradient>")
    terminal.said("polhode nutation --pla\tve\t\n", "<nutation --planet venus>")
    terminal.said("polhode run ap\t--che\t5 --out x.csv --res\t\n",
                  "<run apophis.toml --checkpoint 5 --out x.csv --res")


def test_another_program_completes_under_its_own_name(polhode, tmp_path):
    (tmp_path / "spin-brake").symlink_to(polhode)
    for shell, line in {"bash": "complete -F _spin_brake spin-brake",
                        "zsh": "#compdef spin-brake"}.items():
        done = subprocess.run([tmp_path / "spin-brake", "completion", shell], text=True,
                              capture_output=True, check=True)
        assert line in done.stdout.splitlines()
        subprocess.run([shell, "-n", "/dev/stdin"], input=done.stdout, text=True, check=True)

"""What the lints share: the checkout's files, C++ without its comments and strings, and how a finding is said."""

import os
import re
import sys

ROOMS = ("config", "planner", "hal", "drivers", "firmware")
CPP = (".cpp", ".hpp", ".c", ".h")
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.M)

# A raw string, a string or character with its escapes, a block comment, a line comment, in the order they must be tried. A
# quote after a digit separates digits (1'000).
_TOKENS = re.compile(
    r'R"(?P<end>[^()\\\s]{0,16})\(.*?\)(?P=end)"|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])+\'|/\*.*?\*/|//[^\n]*', re.S
)


def root():
    """The checkout, or the tree named on the command line."""
    return sys.argv[1] if len(sys.argv) > 1 else os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")


def files(top, folders=ROOMS, endings=CPP):
    """Paths below `top`, relative, in order."""
    for folder in folders:
        for place, inner, names in os.walk(os.path.join(top, folder)):
            inner.sort()
            for name in sorted(names):
                if name.endswith(endings):
                    yield os.path.relpath(os.path.join(place, name), top)


def text(top, path):
    """The file's text, or none when it is not text."""
    try:
        with open(os.path.join(top, path), encoding="utf-8") as file:
            return file.read()
    except UnicodeDecodeError:
        return ""


def _blank(match):
    token = match.group(0)
    kept = token[0] + token[-1] if token[0] in "\"'" else " "
    return kept + "\n" * token.count("\n")


def code(source):
    """The source with comments and the insides of strings taken out; line numbers stay."""
    return _TOKENS.sub(_blank, source)


def includes(source):
    """(line, '<' or '"', path) of every include."""
    without_comments = _TOKENS.sub(lambda m: m.group(0) if m.group(0)[0] == '"' else _blank(m), source)
    for match in INCLUDE.finditer(without_comments):
        yield without_comments.count("\n", 0, match.start()) + 1, match.group(1), match.group(2)


def finish(lint, findings):
    """Prints the findings; the exit status says whether there were any."""
    for finding in findings:
        print(f"{lint}: {finding}")
    sys.exit(1 if findings else 0)

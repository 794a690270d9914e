"""The classes by name, in the order and colours of config/classes.toml."""

import pathlib
import tomllib

_TABLE = pathlib.Path(__file__).resolve().parents[2] / "config" / "classes.toml"
_CLASSES = tomllib.loads(_TABLE.read_text(encoding="utf-8"))["class"]

PALETTE = [bytes.fromhex(c["colour"].removeprefix("#")) for c in _CLASSES]
INDEX = {c["name"]: i for i, c in enumerate(_CLASSES)}

"""The part of JSON Schema that config/schemas/ uses, checked with the standard library alone. An unknown keyword is an error: no schema
says something that nobody checks."""

import json
import os

from mission_files import SOURCE_DIR

TYPES = {
    "object": lambda v: isinstance(v, dict),
    "array": lambda v: isinstance(v, list),
    "string": lambda v: isinstance(v, str),
    "boolean": lambda v: isinstance(v, bool),
    "null": lambda v: v is None,
    "number": lambda v: isinstance(v, (int, float)) and not isinstance(v, bool),
    "integer": lambda v: isinstance(v, int) and not isinstance(v, bool),
}
NUMBERS = {"minimum": lambda v, end: v >= end, "maximum": lambda v, end: v <= end, "exclusiveMinimum": lambda v, end: v > end}
SAID = {"$schema", "title", "description", "required", "additionalProperties", "properties", "items"}


def faults(value, schema, at="$"):
    """Yields a line for each place where `value` is not as `schema` says."""
    for keyword, said in schema.items():
        if keyword == "type":
            if not any(TYPES[name](value) for name in ([said] if isinstance(said, str) else said)):
                yield f"{at}: {value!r} is no {said}"
        elif keyword == "const":
            if value != said:
                yield f"{at}: {value!r} is not {said!r}"
        elif keyword == "enum":
            if value not in said:
                yield f"{at}: {value!r} is none of {said}"
        elif keyword in NUMBERS:
            if TYPES["number"](value) and not NUMBERS[keyword](value, said):
                yield f"{at}: {value!r} breaks {keyword} {said}"
        elif keyword in ("minItems", "maxItems"):
            if isinstance(value, list) and (len(value) < said if keyword == "minItems" else len(value) > said):
                yield f"{at}: {len(value)} elements break {keyword} {said}"
        elif keyword not in SAID:
            yield f"{at}: the schema's {keyword} is not checked here"
    if isinstance(value, dict):
        properties = schema.get("properties", {})
        yield from (f"{at}: {key} is missing" for key in schema.get("required", []) if key not in value)
        for key, member in value.items():
            if key in properties:
                yield from faults(member, properties[key], f"{at}.{key}")
            elif schema.get("additionalProperties", True) is False:
                yield f"{at}: {key} is unknown"
    if isinstance(value, list) and "items" in schema:
        for i, element in enumerate(value):
            yield from faults(element, schema["items"], f"{at}[{i}]")


def schema_faults(path, name):
    """Where the JSON file at `path` is not as config/schemas/NAME.schema.json says: a list, empty when it is."""
    with open(os.path.join(SOURCE_DIR, "config", "schemas", name + ".schema.json"), encoding="utf-8") as file:
        schema = json.load(file)
    with open(path, encoding="utf-8") as file:
        return list(faults(json.load(file), schema))

"""Validates models against the schema of `whirl schema`, with python3-jsonschema: those that come with
the program and those of the manual are right, small mistakes are found.

    schema_test.py WHIRL REPOSITORY

Exit status 77, skipped, without jsonschema.
"""

import copy
import json
import pathlib
import re
import subprocess
import sys
import tomllib

try:
    import jsonschema
except ImportError:
    print("there is no jsonschema (Debian: python3-jsonschema)")
    sys.exit(77)

whirl, repository = sys.argv[1], pathlib.Path(sys.argv[2])
schema = json.loads(subprocess.run([whirl, "schema"], check=True, capture_output=True, text=True).stdout)
jsonschema.Draft7Validator.check_schema(schema)
validator = jsonschema.Draft7Validator(schema)
failures = 0


def expect(is_true, what):
    global failures
    if not is_true:
        failures += 1
        print("FAILED:", what)


def problems(model):
    return [f"{'.'.join(map(str, e.absolute_path))}: {e.message[:150]}" for e in validator.iter_errors(model)]


# models that are right
texts = {str(path.relative_to(repository)): path.read_text() for path in (repository / "models").rglob("*.toml")}
manual = (repository / "docs/model-file.md").read_text()
for number, text in enumerate(re.findall(r"```toml\n(.*?)```", manual, re.S)):
    texts[f"docs/model-file.md, model {number + 1}"] = text
expect(len(texts) > 10, f"{len(texts)} models were found")
for name, text in texts.items():
    expect(problems(tomllib.loads(text)) == [], f"{name}: {problems(tomllib.loads(text))}")

# a mistake each
right = tomllib.loads(re.findall(r"```toml\n(.*?)```", manual, re.S)[0])


def wrong(what, change):
    model = copy.deepcopy(right)
    change(model)
    expect(problems(model) != [], f"not found: {what}")


def change(table, key, value):
    def apply(model):
        place = model[table]
        (place[0] if isinstance(place, list) else place)[key] = value

    return apply


def without(table, key):
    def apply(model):
        del model[table][0][key]

    return apply


wrong("a misspelled key", change("contact", "frictoin", 0.1))
wrong("a misspelled table", lambda m: m.__setitem__("contacts", []))
wrong("a wrong dimension", change("shaft", "length", "600 kg"))
wrong("no unit of its kind", change("operation", "speed", "3650 mm"))
wrong("below its range", change("shaft", "length", "-600 mm"))
wrong("a stiffness of a contact that is zero", change("contact", "stiffness", 0))
wrong("a number below its range", change("contact", "friction", -0.1))
wrong("a number instead of a text", change("disk", "name", 5))
wrong("a text instead of a truth", change("bearing", "rigid", "yes"))
wrong("an unknown choice", change("contact", "law", "hard"))
wrong("a key of another law", change("contact", "hertz_stiffness", 1e9))
wrong("a kind without its key", change("bearing", "kind", "table"))
wrong("a law without its key", change("contact", "law", "hertz"))
wrong("a bearing without coefficients", lambda m: [m["bearing"][0].pop(k) for k in ("stiffness", "damping")])
wrong("a missing key", without("contact", "clearance"))
wrong("no station", without("contact", "at"))
wrong("a disk by its shape without a width", without("disk", "width"))
wrong("neither material nor mass", without("disk", "material"))
wrong("half a matrix", change("bearing", "stiffness", {"xx": 1}))
wrong("three ends of a cone", change("shaft", "outer_diameter", [1, 2, 3]))
wrong("another format", lambda m: m.__setitem__("format", 2))
wrong("no format", lambda m: m.pop("format"))
wrong("a material without shear", lambda m: m["material"]["steel"].pop("shear_modulus"))
wrong("start from a file without one", lambda m: m.__setitem__("start", {"from": "file"}))
wrong("nothing that moves", lambda m: [m.pop(k) for k in ("shaft",)])
expect(problems(right) == [], "the changes were made to copies")

print(f"{len(texts)} models, {failures} failures")
sys.exit(1 if failures else 0)

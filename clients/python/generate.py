#!/usr/bin/env python3
"""Writes gnomon/spec.py, gnomon/keywords.py and gnomon/reports.py from a server's OpenAPI document.

    GNOMON_BINARY=build/release/bin/gnomon clients/python/generate.py [--into FOLDER]
"""

import argparse
import json
import keyword
import re
import sys
import textwrap
import urllib.request
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
ROOTS = {"spec.py": ["FrameSpec", "EvaluationRequest", "SequenceRequest"],
         "reports.py": ["FrameReport", "PlanReport", "SceneSummary", "Capabilities", "EvaluationReport", "BakeReport",
                        "SequenceReport", "Job", "NodeList"]}
SCENE, SPEC = "scene: SceneLike", "spec: Optional[Spec] = None"
PATCHES = ["frames", "keys", "count", "stable"]
# Of each call: what may be positional, and of which request it takes which fields beside those of a frame.
CALLS = {
    "frame": ([SCENE, SPEC], None, []),
    "render": ([SCENE, SPEC], None, []),
    "orbit": (["session: Session", SCENE, SPEC, "width: int = 640", "height: int = 360"], None, []),
    "picture": ([SCENE, SPEC, 'media_type: str = "image/png"'], None, []),
    "evaluate": ([SCENE, SPEC], "EvaluationRequest", ["variants", "sweep", "repeats", "referenceSamples", "path"]),
    "sequence": ([SCENE, SPEC], "SequenceRequest", PATCHES),
    "video": ([SCENE, "path: Union[str, Path]", SPEC], "SequenceRequest", [*PATCHES, "framesPerSecond", "videoQuality"]),
}
OWN = {"render": {"server": "str", "key": "str", "strict": "bool"}}
PRIMITIVES = {"string": "str", "integer": "int", "number": "float", "boolean": "bool"}
NOTE = "# Written by generate.py from /openapi.json; change the server's rows and run it again.\n"


def referred(schema):
    return schema["$ref"].rsplit("/", 1)[1] if "$ref" in schema else None


def reachable(schemas, roots):
    """Names of the objects that the roots hold, each after those it holds itself."""
    found = []

    def visit(name):
        if name in found or name not in schemas:
            return
        for field in schemas[name].get("properties", {}).values():
            below(field)
        found.append(name)

    def below(schema):
        if referred(schema):
            visit(referred(schema))
        if "items" in schema:
            below(schema["items"])
        if isinstance(schema.get("additionalProperties"), dict):
            below(schema["additionalProperties"])

    for root in roots:
        visit(root)
    return found


def request_type(schema):
    if referred(schema):
        return f'Union["{referred(schema)}", Json]'
    if "enum" in schema:
        return "Literal[" + ", ".join(json.dumps(value) for value in schema["enum"]) + "]"
    if "oneOf" in schema:
        return "Union[" + ", ".join(request_type(each) for each in schema["oneOf"]) + "]"
    if schema.get("type") == "array":
        items = schema["items"]
        if items.get("type") in ("number", "integer"):
            return "Vector"
        return "Matrix" if items.get("type") == "array" else f"Sequence[{request_type(items)}]"
    return PRIMITIVES.get(schema.get("type"), "Json")


def report_type(schema, known):
    name = referred(schema)
    if name:
        return f'"{name}"' if name in known else "Dict[str, Any]"
    if "enum" in schema:
        return "Literal[" + ", ".join(json.dumps(value) for value in schema["enum"]) + "]"
    if "oneOf" in schema:
        return "Union[" + ", ".join(report_type(each, known) for each in schema["oneOf"]) + "]"
    if schema.get("type") == "array":
        return f"List[{report_type(schema['items'], known)}]"
    if schema.get("type") == "object":
        more = schema.get("additionalProperties")
        return f"Dict[str, {report_type(more, known)}]" if isinstance(more, dict) else "Dict[str, Any]"
    return PRIMITIVES.get(schema.get("type"), "Any")


def wrapped(text, indent):
    return "\n".join(textwrap.wrap(text, 116, initial_indent=indent, subsequent_indent=indent)).replace("\\", "\\\\")


def docstring(schema):
    lines = [wrapped(schema.get("description", ""), "    ") + "\n"]
    for name, field in schema.get("properties", {}).items():
        default = f" Default: {json.dumps(field['default'])}." if field.get("default") not in (None, [], {}, "") else ""
        lines += [f"    {name}:", wrapped(field.get("description", "") + default, "        ")]
    return '    """' + "\n".join(lines).strip() + '\n    """\n'


def written_class(name, schema, head, field_line):
    for field in schema["properties"]:
        if keyword.iskeyword(field):
            raise SystemExit(f"{name}.{field} is a keyword of Python")
    fields = [field_line(field, each) for field, each in schema["properties"].items()]
    return f"\n\n{head}\n{docstring(schema)}\n" + "\n".join(fields) + "\n"


def functional_dict(name, schema, known):
    """A TypedDict with a field that no class can have."""
    fields = [f'        "{field}": {report_type(each, known)},' for field, each in schema["properties"].items()]
    return f'\n\n{name} = TypedDict(\n    "{name}",\n    {{\n' + "\n".join(fields) + "\n    },\n    total=False,\n)\n"


def spec_module(schemas):
    text = '"""What is asked of a server: every field may be left out, and `None` leaves it out.\n\n'
    text += "Names are those of the JSON; a plain dict with the same names does as well as any of these classes.\n"
    text += '"""\n\n' + NOTE
    text += "from __future__ import annotations\n\nfrom dataclasses import dataclass\n"
    text += "from typing import Any, Literal, Mapping, Optional, Sequence, Union\n\nimport numpy as np\n"
    text += "import numpy.typing as npt\n\n"
    text += "Json = Mapping[str, Any]\n"
    text += "Vector = Union[Sequence[float], npt.NDArray[np.generic]]\n"
    text += "Matrix = Union[Sequence[Sequence[float]], npt.NDArray[np.generic]]\n"
    for name in reachable(schemas, ROOTS["spec.py"]):
        text += written_class(name, schemas[name], f"@dataclass\nclass {name}:",
                              lambda field, each: f"    {field}: Optional[{request_type(each)}] = None")
    return text


def keyword_types(schema, aliases):
    """Field -> the type of its keyword, or where that is long its name in `aliases`."""
    types = {}
    for field, each in schema["properties"].items():
        types[field] = request_type(each).replace('Union["', "Union[").replace('", Json]', ", Json]")
        if len(types[field]) > 60:
            name = field[0].upper() + field[1:]
            aliases[name], types[field] = types[field], name
    return types


def keywords_module(schemas):
    aliases, functions = {}, ""
    of_frame = {"sun": "Vector", **keyword_types(schemas["FrameSpec"], aliases)}
    for name, (positional, request, fields) in CALLS.items():
        more = keyword_types(schemas[request], aliases) if request else {}
        taken = {**OWN.get(name, {}), **{field: more[field] for field in fields}, **of_frame}
        already = {each.split(":")[0] for each in positional}
        lines = [*positional, "*", *(f"{field}: Optional[{text}] = None" for field, text in taken.items() if field not in already)]
        functions += f"\n\ndef {name}(\n" + "".join(f"    {line},\n" for line in lines) + ") -> None: ...\n"
    aliased = "".join(f"{name} = {value}\n" for name, value in aliases.items())
    used = [name for name in reachable(schemas, ROOTS["spec.py"]) if re.search(rf"\b{name}\b", aliased + functions)]
    text = '"""What the calls of a session take, as type checkers and notebooks see it; `None` leaves a field out."""\n\n' + NOTE
    text += "from __future__ import annotations\n\nfrom pathlib import Path\n"
    text += "from typing import TYPE_CHECKING, Literal, Optional, Sequence, Union\n\nfrom .json_form import Spec\n"
    text += "from .scene_calls import SceneLike\n" + wrapped_import(["Json", "Vector", *used])
    return text + "\nif TYPE_CHECKING:\n    from .session import Session\n\n" + aliased + functions


def wrapped_import(names):
    return "\n".join(textwrap.wrap(f"from .spec import ({', '.join(names)})", 116, subsequent_indent=" " * 19)) + "\n"


def reports_module(schemas):
    requests = reachable(schemas, ROOTS["spec.py"])
    known = [name for name in reachable(schemas, ROOTS["reports.py"]) if name not in requests]
    text = '"""What a server answers, as type checkers see it; at run time these are plain dicts."""\n\n' + NOTE
    text += "from __future__ import annotations\n\nfrom typing import Any, Dict, List, Literal, TypedDict, Union\n"
    for name in known:
        if any(map(keyword.iskeyword, schemas[name]["properties"])):
            text += functional_dict(name, schemas[name], known)
            continue
        text += written_class(name, schemas[name], f"class {name}(TypedDict, total=False):",
                              lambda field, each: f"    {field}: {report_type(each, known)}")
    used = [word for word in ("Any", "Dict", "List", "Literal", "TypedDict", "Union") if f"{word}[" in text or
            word == "TypedDict" or f" {word}" in text.split("\n\n\n", 1)[1]]
    return text.replace("Any, Dict, List, Literal, TypedDict, Union", ", ".join(used))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--into", type=Path, default=FOLDER / "gnomon", help="folder of the written files")
    into = parser.parse_args().into
    sys.path.append(str(FOLDER / "gnomon"))  # not the package, which imports what is written here
    from local_server import LocalServer

    with LocalServer() as server:
        with urllib.request.urlopen(server.url + "/openapi.json") as reply:
            schemas = json.load(reply)["components"]["schemas"]
    (into / "spec.py").write_text(spec_module(schemas), encoding="utf-8")
    (into / "keywords.py").write_text(keywords_module(schemas), encoding="utf-8")
    (into / "reports.py").write_text(reports_module(schemas), encoding="utf-8")


if __name__ == "__main__":
    main()

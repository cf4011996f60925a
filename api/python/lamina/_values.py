"""Values of parameters: as Python has them, and in OpenSCAD's notation."""

from __future__ import annotations

import json
from typing import Any, Mapping

from ._records import Parameter, Value


def set_of(values: Mapping[str, Value]) -> list[tuple[str, str]]:
    """As a parameter set has them: texts without quotes."""
    return [
        (name, value if isinstance(value, str) else _notation(value))
        for name, value in values.items()
    ]


def parameter_of(
    name: str, value: str, choices: str, description: str, group: str
) -> Parameter:
    least, step, most = None, None, None
    chosen: tuple[Value, ...] = ()
    rule = _read(choices)
    if isinstance(rule, (int, float)) and not value.startswith('"'):
        step = float(rule)
    elif isinstance(rule, list) and len(rule) == 1 and not isinstance(rule[0], str):
        most = float(rule[0])
    elif isinstance(rule, list):
        # A choice with a label is a list of both.
        chosen = tuple(one[0] if isinstance(one, list) else one for one in rule)
    elif choices:  # [least : step : most]
        ends = [float(end) for end in choices.strip("[]").split(":")]
        least, most = ends[0], ends[-1]
        step = ends[1] if len(ends) == 3 else None
    return Parameter(
        name, _read(value, value), chosen, least, most, step, description, group
    )


def _read(text: str, otherwise: Any = None) -> Any:
    """The value of a literal, which JSON writes alike."""
    try:
        return json.loads(text, strict=False)
    except ValueError:
        return otherwise


def _notation(value: Value) -> str:
    return json.dumps(value, ensure_ascii=False, default=_plain)


def _plain(value: Any) -> Any:
    """What numpy has, as Python has it."""
    if not hasattr(value, "tolist"):
        raise TypeError(f"{value!r} cannot be the value of a parameter")
    return value.tolist()

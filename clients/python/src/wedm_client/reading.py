"""Answers of the server as typed values. Unknown keys of a newer server are passed over."""

from __future__ import annotations

from dataclasses import fields, is_dataclass
from functools import lru_cache
from typing import Any, Literal, TypeVar, get_origin

import cattrs
from cattrs.gen import make_dict_structure_fn, override

from .entities import Point
from .findings import Diagnostic, diagnostic_from_json

T = TypeVar("T")

# Where a key of the protocol is not the camelCase form of the field.
_KEYS = {("WirePath", "pass_number"): "pass", ("WorkCut", "pass_number"): "pass", ("Program", "text"): "program", ("PairProgram", "text"): "program"}


def _camel(name: str) -> str:
    first, *rest = name.split("_")
    return first + "".join(word.capitalize() for word in rest)


def _is_literal(cls: Any) -> bool:
    return get_origin(cls) is Literal


@lru_cache(maxsize=1)
def _converter() -> cattrs.Converter:
    converter = cattrs.Converter()

    def structure(cls: type[Any]) -> Any:
        keys = {f.name: override(rename=_KEYS.get((cls.__name__, f.name), _camel(f.name))) for f in fields(cls)}
        return make_dict_structure_fn(cls, converter, **keys)  # type: ignore[arg-type]

    converter.register_structure_hook_factory(is_dataclass, structure)
    converter.register_structure_hook(Point, lambda value, _: Point(float(value[0]), float(value[1])))
    # A word that only a newer server knows is passed on.
    converter.register_structure_hook_func(_is_literal, lambda value, _: value)
    converter.register_structure_hook(Diagnostic, lambda value, _: diagnostic_from_json(value, None))
    return converter


def from_json(value: Any, cls: type[T]) -> T:
    """The value of the protocol as one of the types above."""
    return _converter().structure(value, cls)

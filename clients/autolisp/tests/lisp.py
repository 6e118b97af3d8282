"""An interpreter of the AutoLISP that the client uses: reader, special forms, and functions on data alone.

Each function does what Autodesk's reference says of it and refuses what that does not allow, so that the client cannot lean on what one
program happens to do. What is not defined here or by the drawing fails the test. Variables are dynamic, as in AutoLISP.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from typing import Any


class Fault(Exception):
    """An error of AutoLISP: `vl-catch-all-apply` catches it, else `*error*` gets it."""


class Misuse(Exception):
    """What the reference does not allow: it fails the test, and nothing catches it."""


class Symbol:
    names: dict[str, Symbol] = {}

    def __new__(cls, name: str) -> Symbol:
        name = name.upper()
        if name not in cls.names:
            symbol = super().__new__(cls)
            symbol.name = name
            cls.names[name] = symbol
        return cls.names[name]

    name: str

    def __repr__(self) -> str:
        return self.name


class Cons:
    def __init__(self, car: Any, cdr: Any) -> None:
        self.car, self.cdr = car, cdr

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Cons) and self.car == other.car and self.cdr == other.cdr

    __hash__ = None  # type: ignore[assignment]

    def __iter__(self) -> Iterator[Any]:
        at: Any = self
        while isinstance(at, Cons):
            yield at.car
            at = at.cdr
        if at is not None:
            raise Fault("bad argument type: listp")

    def __repr__(self) -> str:
        parts, at = [], self
        while isinstance(at, Cons):
            parts.append(repr(at.car))
            at = at.cdr
        return "(" + " ".join(parts) + ("" if at is None else f" . {at!r}") + ")"


class Caught:
    """What `vl-catch-all-apply` returns of an error."""

    def __init__(self, message: str) -> None:
        self.message = message


class Defined:
    def __init__(self, parameters: list[Symbol], local: list[Symbol], body: list[Any], name: str) -> None:
        self.parameters, self.local, self.body, self.name = parameters, local, body, name


T, QUOTE, LAMBDA, SLASH = Symbol("T"), Symbol("QUOTE"), Symbol("LAMBDA"), Symbol("/")
TOKEN = re.compile(r"""\s+|;\|.*?\|;|;[^\n]*|(?P<open>\()|(?P<close>\))|(?P<quote>')|(?P<text>"(?:\\.|[^"\\])*")|(?P<atom>[^\s()'";]+)""", re.S)
ESCAPE = re.compile(r"\\([0-7]{3}|.)", re.S)
ESCAPES = {"\\": "\\", '"': '"', "e": "\x1b", "n": "\n", "r": "\r", "t": "\t"}


def linked(items: Iterable[Any], end: Any = None) -> Any:
    for item in reversed(list(items)):
        end = Cons(item, end)
    return end


def items(value: Any) -> list[Any]:
    if value is None:
        return []
    if not isinstance(value, Cons):
        raise Fault(f"bad argument type: listp {value!r}")
    return list(value)


def unescaped(text: str) -> str:
    def one(found: re.Match[str]) -> str:
        escape = found[1]
        if len(escape) == 3:
            return chr(int(escape, 8))
        if escape not in ESCAPES:
            raise Misuse(f"\\{escape} is no control character of AutoLISP's strings")
        return ESCAPES[escape]

    return ESCAPE.sub(one, text)


def atom(text: str) -> Any:
    if re.fullmatch(r"[-+]?\d+", text):
        number = int(text)
        if not -(2**31) <= number < 2**31:
            raise Misuse(f"{text} is no integer of 32 bits")
        return number
    if re.fullmatch(r"[-+]?\d+\.\d*", text):
        return float(text)
    if re.fullmatch(r"[-+]?[\d.]+(e[-+]?\d+)?", text, re.I):
        raise Misuse(f"{text}: a number that not every program reads")
    return None if text.upper() == "NIL" else Symbol(text)


def parse(text: str) -> Iterator[Any]:
    """The expressions of a text."""
    tokens: list[tuple[str, str]] = []
    at = 0
    while at < len(text):
        found = TOKEN.match(text, at)
        if not found:
            raise Fault("malformed string on input")
        at = found.end()
        if found.lastgroup:
            tokens.append((found.lastgroup, found[0]))
    position = 0

    def expression() -> Any:
        nonlocal position
        if position >= len(tokens):
            raise Fault("malformed list on input")
        kind, token = tokens[position]
        position += 1
        if kind == "quote":
            return linked([QUOTE, expression()])
        if kind == "text":
            return unescaped(token[1:-1])
        if kind == "atom":
            return atom(token)
        if kind == "close":
            raise Fault("extra right paren on input")
        inner: list[Any] = []
        while True:
            if position >= len(tokens):
                raise Fault("malformed list on input")
            kind, token = tokens[position]
            if kind == "close":
                position += 1
                return linked(inner)
            if token == ".":
                position += 1
                end = expression()
                if position >= len(tokens) or tokens[position][0] != "close":
                    raise Fault("misplaced dot on input")
                position += 1
                return linked(inner, end)
            inner.append(expression())

    while position < len(tokens):
        yield expression()


class Interpreter:
    def __init__(self) -> None:
        self.values: dict[Symbol, Any] = {T: T}
        self.printed = ""
        for name, function in functions(self).items():
            self.define(name, function)

    def define(self, name: str, function: Callable[..., Any]) -> None:
        self.values[Symbol(name)] = function

    def get(self, name: str) -> Any:
        return self.values.get(Symbol(name))

    def run(self, text: str) -> Any:
        result = None
        for expression in parse(text):
            result = self.evaluate(expression)
        return result

    def evaluate(self, form: Any) -> Any:
        if isinstance(form, Symbol):
            return self.values.get(form)
        if not isinstance(form, Cons):
            return form
        head, rest = form.car, items(form.cdr)
        special = getattr(self, "do_" + head.name.lower(), None) if isinstance(head, Symbol) else None
        if special:
            return special(rest)
        return self.call(head, [self.evaluate(one) for one in rest])

    def body(self, forms: Iterable[Any]) -> Any:
        result = None
        for form in forms:
            result = self.evaluate(form)
        return result

    def call(self, function: Any, arguments: list[Any]) -> Any:
        named = function
        if isinstance(function, Symbol):
            function = self.values.get(function)
        if isinstance(function, Cons) and function.car is LAMBDA:
            function = self.made(items(function.cdr), "lambda")
        if isinstance(function, Defined):
            return self.enter(function, arguments)
        if not callable(function):
            raise Fault(f"no function definition: {named!r}")
        try:
            return function(*arguments)
        except TypeError as error:
            if "positional argument" in str(error):
                raise Misuse(f"{named!r}: {error}") from error
            raise

    def made(self, rest: list[Any], name: str) -> Defined:
        names = items(rest[0])
        for shadowed in names:
            if callable(self.values.get(shadowed)) and shadowed is not SLASH:
                raise Misuse(f"{name} hides the function {shadowed!r} from all that it calls")
        cut = names.index(SLASH) if SLASH in names else len(names)
        return Defined(names[:cut], names[cut + 1 :], rest[1:], name)

    def enter(self, function: Defined, arguments: list[Any]) -> Any:
        if len(arguments) != len(function.parameters):
            raise Misuse(f"{function.name} takes {len(function.parameters)} arguments, not {len(arguments)}")
        own = dict(zip(function.parameters, arguments)) | {name: None for name in function.local}
        before = {name: self.values.get(name) for name in own}
        self.values.update(own)
        try:
            return self.body(function.body)
        except Fault as fault:
            self.failed(function, fault)
            raise
        finally:
            self.values.update(before)

    def failed(self, function: Defined, fault: Fault) -> None:
        """A fault leaves a function: where programs have an `*error*`, this is the place for it."""

    # Special forms

    def do_quote(self, rest: list[Any]) -> Any:
        return rest[0]

    def do_setq(self, rest: list[Any]) -> Any:
        if len(rest) % 2:
            raise Misuse("setq: a symbol without a value")
        value = None
        for name, form in zip(rest[::2], rest[1::2]):
            value = self.evaluate(form)
            if name is T or not isinstance(name, Symbol):
                raise Misuse(f"setq of {name!r}")
            self.values[name] = value
        return value

    def do_defun(self, rest: list[Any]) -> Any:
        self.values[rest[0]] = self.made(rest[1:], rest[0].name)
        return rest[0]

    def do_if(self, rest: list[Any]) -> Any:
        if not 2 <= len(rest) <= 3:
            raise Misuse(f"if with {len(rest)} parts")
        chosen = rest[1:2] if self.evaluate(rest[0]) is not None else rest[2:]
        return self.body(chosen)

    def do_progn(self, rest: list[Any]) -> Any:
        return self.body(rest)

    def do_cond(self, rest: list[Any]) -> Any:
        for clause in rest:
            test, *body = items(clause)
            value = self.evaluate(test)
            if value is not None:
                return self.body(body) if body else value
        return None

    def do_and(self, rest: list[Any]) -> Any:
        return truth(all(self.evaluate(one) is not None for one in rest))

    def do_or(self, rest: list[Any]) -> Any:
        return truth(any(self.evaluate(one) is not None for one in rest))

    def do_while(self, rest: list[Any]) -> Any:
        result = None
        while self.evaluate(rest[0]) is not None:
            result = self.body(rest[1:])
        return result

    def do_repeat(self, rest: list[Any]) -> Any:
        result = None
        for _ in range(whole(self.evaluate(rest[0]))):
            result = self.body(rest[1:])
        return result

    def do_foreach(self, rest: list[Any]) -> Any:
        name, before, result = rest[0], self.values.get(rest[0]), None
        for value in items(self.evaluate(rest[1])):
            self.values[name] = value
            result = self.body(rest[2:])
        self.values[name] = before
        return result


def truth(value: object) -> Symbol | None:
    return T if value else None


def text(value: Any) -> str:
    if not isinstance(value, str):
        raise Fault(f"bad argument type: stringp {value!r}")
    return value


def number(value: Any) -> float | int:
    if not isinstance(value, int | float):
        raise Fault(f"bad argument type: numberp: {value!r}")
    return value


def whole(value: Any) -> int:
    if not isinstance(value, int):
        raise Fault(f"bad argument type: fixnump: {value!r}")
    return value


def functions(lisp: Interpreter) -> dict[str, Callable[..., Any]]:
    def compared(of: Callable[[Any, Any], bool]) -> Callable[..., Any]:
        def compare(*values: Any) -> Any:
            for value in values:
                if value is not None and not isinstance(value, int | float | str | Symbol):
                    raise Misuse(f"{value!r} is compared as a number or a string")
            kinds = {float if isinstance(value, int | float) else type(value) for value in values}
            alike = len(kinds) == 1
            return truth(all((alike or of in (same, other)) and of(a, b) for a, b in zip(values, values[1:])))

        return compare

    def same(a: Any, b: Any) -> bool:
        return bool(a == b)

    def other(a: Any, b: Any) -> bool:
        return bool(a != b)

    def added(*values: Any) -> Any:
        return sum(number(value) for value in values)

    def taken(first: Any, *rest: Any) -> Any:
        return number(first) - added(*rest) if rest else -number(first)

    def product(*values: Any) -> Any:
        result: float | int = 1
        for value in values:
            result *= number(value)
        return result

    def divided(first: Any, second: Any) -> Any:
        if number(second) == 0:
            raise Fault("divide by zero")
        exact = number(first) / number(second)
        return int(exact) if isinstance(first, int) and isinstance(second, int) else exact

    def car(value: Any) -> Any:
        if value is not None and not isinstance(value, Cons):
            raise Fault(f"bad argument type: consp {value!r}")
        return value.car if value else None

    def cdr(value: Any) -> Any:
        if value is not None and not isinstance(value, Cons):
            raise Fault(f"bad argument type: consp {value!r}")
        return value.cdr if value else None

    def assoc(key: Any, pairs: Any) -> Any:
        for pair in items(pairs):
            if not isinstance(pair, Cons):
                raise Fault(f"bad association list: {pairs!r}")
            if pair.car == key:
                return pair
        return None

    def member(value: Any, all_of: Any) -> Any:
        while isinstance(all_of, Cons):
            if all_of.car == value:
                return all_of
            all_of = all_of.cdr
        return None

    def nth(index: Any, all_of: Any) -> Any:
        listed = items(all_of)
        return listed[whole(index)] if 0 <= index < len(listed) else None

    def last(all_of: Any) -> Any:
        return items(all_of)[-1] if all_of else None

    def kind(value: Any) -> Any:
        if value is None:
            return None
        kinds = {int: "INT", float: "REAL", str: "STR", Symbol: "SYM", Cons: "LIST", Defined: "USUBR"}
        return Symbol(kinds.get(type(value), "SUBR"))

    def substr(value: Any, start: Any, length: Any = None) -> str:
        if whole(start) < 1:
            raise Misuse(f"substr from {start}")
        begin = start - 1
        return text(value)[begin:] if length is None else text(value)[begin : begin + whole(length)]

    def search(pattern: Any, value: Any) -> Any:
        found = text(value).find(text(pattern))
        return found if found >= 0 else None

    def rtos(value: Any, mode: Any, precision: Any) -> str:
        if mode != 2:
            raise Misuse(f"rtos in mode {mode}")
        return f"{number(value):.{precision}f}"

    def read(value: Any) -> Any:
        return next(parse(text(value)), None)

    def princ(value: Any = "") -> Any:
        lisp.printed += value if isinstance(value, str) else "" if value is None else repr(value)
        return value

    def caught(function: Any, arguments: Any) -> Any:
        try:
            return lisp.call(function, items(arguments))
        except Fault as fault:
            return Caught(str(fault))

    def filtered(keeps: bool) -> Callable[[Any, Any], Any]:
        return lambda test, all_of: linked(one for one in items(all_of) if (lisp.call(test, [one]) is not None) == keeps)

    def some(test: Any, all_of: Any) -> Any:
        return next((found for one in items(all_of) if (found := lisp.call(test, [one])) is not None), None)

    def mapped(function: Any, *lists: Any) -> Any:
        return linked(lisp.call(function, list(one)) for one in zip(*(items(each) for each in lists)))

    def subst(new: Any, old: Any, all_of: Any) -> Any:
        if old is None:
            raise Misuse(f"{new!r} takes the place of nothing")
        return linked(new if one == old else one for one in items(all_of))

    def appended(*lists: Any) -> Any:
        return linked(one for each in lists for one in items(each))

    def logand(*values: Any) -> int:
        result = -1
        for value in values:
            result &= whole(value)
        return result

    return {
        "=": compared(same),
        "/=": compared(other),
        "<": compared(lambda a, b: bool(a < b)),
        ">": compared(lambda a, b: bool(a > b)),
        "<=": compared(lambda a, b: bool(a <= b)),
        ">=": compared(lambda a, b: bool(a >= b)),
        "+": added,
        "-": taken,
        "*": product,
        "/": divided,
        "1+": lambda value: number(value) + 1,
        "1-": lambda value: number(value) - 1,
        "max": lambda *values: max(float(number(value)) if any(isinstance(one, float) for one in values) else value for value in values),
        "logand": logand,
        "car": car,
        "cdr": cdr,
        "cadr": lambda value: car(cdr(value)),
        "cddr": lambda value: cdr(cdr(value)),
        "cons": Cons,
        "list": lambda *values: linked(values),
        "append": appended,
        "subst": subst,
        "reverse": lambda value: linked(reversed(items(value))),
        "last": last,
        "length": lambda value: len(items(value)),
        "nth": nth,
        "assoc": assoc,
        "member": member,
        "listp": lambda value: truth(value is None or isinstance(value, Cons)),
        "null": lambda value: truth(value is None),
        "not": lambda value: truth(value is None),
        "eq": lambda one, two: truth(one is two or (isinstance(one, int | float | str) and one == two)),
        "type": kind,
        "strcat": lambda *values: "".join(text(value) for value in values),
        "strlen": lambda value: len(text(value)),
        "substr": substr,
        "strcase": lambda value, lower=None: text(value).lower() if lower else text(value).upper(),
        "itoa": lambda value: str(whole(value)),
        "rtos": rtos,
        "read": read,
        "princ": princ,
        "apply": lambda function, arguments: lisp.call(function, items(arguments)),
        "mapcar": mapped,
        "vl-string-search": search,
        "vl-catch-all-apply": caught,
        "vl-catch-all-error-p": lambda value: truth(isinstance(value, Caught)),
        "vl-remove-if": filtered(False),
        "vl-remove-if-not": filtered(True),
        "vl-some": some,
    }

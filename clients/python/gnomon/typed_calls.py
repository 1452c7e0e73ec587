"""Calls that pass keywords on, with the keywords that they take spelled out for type checkers, notebooks and users."""

from __future__ import annotations

import difflib
import functools
import inspect
from typing import TYPE_CHECKING, Any, Callable, List, TypeVar, cast

if TYPE_CHECKING:
    from typing_extensions import Concatenate, ParamSpec  # which checkers bring with them; never imported

    P = ParamSpec("P")
T = TypeVar("T")


def function_of(keywords: Callable[P, None]) -> Callable[[Callable[..., T]], Callable[P, T]]:
    """A function that takes what `keywords` takes."""
    return lambda call: _checked(call, [*inspect.signature(keywords).parameters.values()])


def method_of(keywords: Callable[P, None]) -> Callable[[Callable[..., T]], Callable[Concatenate[Any, P], T]]:
    """A method that takes what `keywords` takes."""
    own = inspect.Parameter("self", inspect.Parameter.POSITIONAL_OR_KEYWORD)
    return lambda call: _checked(call, [own, *inspect.signature(keywords).parameters.values()])


def _checked(call: Callable[..., Any], parameters: List[inspect.Parameter]) -> Callable[..., Any]:
    """With that signature, and a TypeError for other keywords. What is awaited leaves that to what it awaits."""
    shown: Any = call
    if not inspect.iscoroutinefunction(call) and not inspect.isasyncgenfunction(call):
        names = [each.name for each in parameters if each.name != "self"]

        @functools.wraps(call)
        def shown(*arguments: Any, **keywords: Any) -> Any:
            for each in keywords:
                if each not in names:
                    raise TypeError(f"{call.__name__}() takes no {each!r}; {_suggestion(each, names)}")
            return call(*arguments, **keywords)

    shown.__signature__ = inspect.signature(call).replace(parameters=parameters)
    return cast(Callable[..., Any], shown)


def _suggestion(name: str, known: List[str]) -> str:
    near = difflib.get_close_matches(name, known, 1)
    return f"did you mean {near[0]!r}?" if near else f"it takes {', '.join(known)}"

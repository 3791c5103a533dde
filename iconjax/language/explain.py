"""Readings in plain words, and the message of a request that was not understood."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from iconjax.language.clauses import Clause

DIMS = {
    "vert": "height",
    "hori": "width",
    "length": "length",
    "short": "length",
    "thick": "thickness",
    "size": "size",
    "rotation": "pose",
}
SHOWN_NAMES = 30


def describe(clause: Clause) -> str:
    """One line about a clause."""
    things = " and ".join(clause.theme)
    return f"{things}: {TELLERS[clause.action](clause)}{_guess(clause)}"


def _guess(clause: Clause) -> str:
    vague = clause.amount is not None and clause.amount.vague
    return " (the request names no amount; this one was chosen)" if vague else ""


def _others(clause: Clause) -> str:
    return " and ".join(clause.reference)


def _scale(clause: Clause) -> str:
    amount, size = clause.amount, DIMS.get(clause.dimension, clause.dimension)
    other = DIMS.get(clause.side or "", size) + (f" of {_others(clause)}" if clause.reference else " it had")
    if amount is None:
        return f"{size} changes"
    match amount.unit:
        case "added":
            return f"{size} becomes the {other} {amount.value:+g} px"
        case "length":
            return f"{size} becomes {amount.value:g} px"
        case "more" | "less":
            return f"{size} becomes {amount.unit} than the {other}"
    return f"{size} becomes {amount.value:g} times the {other}"


def _rotate(clause: Clause) -> str:
    sense = {"cw": "clockwise", "ccw": "counter-clockwise"}.get(clause.direction, clause.direction)
    degrees = clause.amount.value if clause.amount is not None else 0.0
    return " ".join(f"turns by {degrees:g} degrees {sense} {_others(clause)}".split())


def _move(clause: Clause) -> str:
    amount = clause.amount
    if amount is None or amount.vague:
        return f"moves {clause.direction} some way"
    if amount.unit in ("px", "none"):
        return f"moves {clause.direction} by {amount.value:g} px"
    whole = (_others(clause) or "itself") if amount.of is not None else "the picture"
    return f"moves {clause.direction} by {amount.value:g} times the size of {whole}"


def _place(clause: Clause) -> str:
    side = f"the {clause.side} of " if clause.side else ""
    mine = f" with its {clause.theme_side}" if clause.theme_side else ""
    way = f", moving {clause.direction}" if clause.direction else ""
    return f"goes {clause.relation.replace('_', ' ')} {side}{_others(clause)}{mine}{way}"


def _keep(clause: Clause) -> str:
    if clause.relation:
        return f"stays {clause.relation.replace('_', ' ')} {_others(clause)}"
    return f"keeps its {DIMS.get(clause.dimension, clause.dimension)}"


def _gap(clause: Clause) -> str:
    amount = clause.amount
    if amount is None:
        return "the gap between them changes"
    if amount.unit == "length":
        return f"the gap between them becomes {amount.value:g} px"
    if amount.unit == "added":
        return f"the gap between them changes by {amount.value:+g} px"
    whose = f"the size of {_others(clause)}" if clause.reference else "what it was"
    return f"the gap between them becomes {amount.value:g} times {whose}"


def _hinge(clause: Clause) -> str:
    return f"turns about {f'the {clause.side} of ' if clause.side else ''}{_others(clause)}"


TELLERS: Mapping[str, Callable[[Clause], str]] = {
    "scale": _scale,
    "rotate": _rotate,
    "orient": lambda c: f"becomes {c.relation} {_others(c)}".rstrip(),
    "move": _move,
    "place": _place,
    "hinge": _hinge,
    "keep": _keep,
    "gap": _gap,
    "go": lambda _: "may move, as far as the next line says",
    "turn": lambda _: "may turn, as far as the next line says",
    "resize": lambda _: "may change its size, as far as the next line says",
    "topic": lambda _: "is what the next line is about",
    "side": lambda c: f"is on the {c.direction}",
    "stay": lambda _: "stays",
    "swap": lambda _: "change places",
    "space": lambda c: "are spaced evenly" + (f", {c.amount.value:g} px from one to the next" if c.amount else ""),
    "align": lambda c: f"their {c.side} sides are brought in line",
    "together": lambda _: "move as one",
}


def refusal(
    reason: str,
    understood: Sequence[str],
    unknown: Sequence[str],
    names: Sequence[str],
    objects: Sequence[str],
) -> str:
    """One line: why, which words were not understood, what was, and which names there are."""
    text = f"the request was not understood: {reason}"
    if unknown:
        text += f". Words not understood: {', '.join(unknown)}"
    text += f". Understood: {'; '.join(understood)}" if understood else ""
    listed = list(dict.fromkeys((*objects, *names)))
    more = len(listed) - SHOWN_NAMES
    shown = ", ".join(listed[:SHOWN_NAMES]) + (f" and {more} more" if more > 0 else "")
    return f"{text}. The picture knows: {shown}"

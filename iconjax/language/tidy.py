"""Clauses that belong together: "next to the oven, touching it, on its left" is one place."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from iconjax.errors import TranslationError
from iconjax.language.clauses import Clause

SIDES = {"left_of": "left", "right_of": "right"}


def tidy(clauses: Sequence[Clause]) -> list[Clause]:
    """Merge what later clauses add to a place beside something: the side, and that the two touch."""
    out: list[Clause] = []
    for clause in clauses:
        at = next((i for i in range(len(out) - 1, -1, -1) if _beside(out[i], clause)), None)
        said = _said(clause)
        if clause.action == "side" and at is None:
            raise TranslationError(f"the {clause.direction} of what is not clear")
        if at is not None and clause.relation == "beside" and "to" in out[at].manner:
            out[at] = replace(clause, manner=clause.manner - {"follow"})  # "go over to it and stand next to it"
        elif at is None or not said:
            out.append(clause)
        else:
            out[at] = replace(out[at], relation="beside", manner=out[at].manner | said | _said(out[at]))
    out = _with_senses(out)
    out = [c for i, c in enumerate(out) if not _said_better(c, i, out)]
    return [c for i, c in enumerate(out) if not (c.action == "go" and _only_turns(c, out[i + 1 :]))]


def _with_senses(clauses: list[Clause]) -> list[Clause]:
    """Turns with the sense that an appended bit gives: "tip it by ten degrees, clockwise"."""
    out: list[Clause] = []
    for clause in clauses:
        last = out[-1] if out else None
        guessed = clause.amount is not None and clause.amount.mode == "unsaid"
        open_ = (
            last is not None
            and last.action == "rotate"
            and last.direction in ("", "up", "down")
            and last.theme == clause.theme
        )
        if last is not None and open_ and clause.action == "rotate" and guessed and clause.direction in ("cw", "ccw"):
            out[-1] = replace(last, direction=clause.direction)
        else:
            out.append(clause)
    return out


def _said_better(clause: Clause, at: int, every: Sequence[Clause]) -> bool:
    """Whether a guessed amount is given by another clause: "a good deal larger, say double"."""
    if clause.amount is None or not clause.amount.vague:
        return False
    swapped = {n for c in every if c.action == "swap" for n in c.theme}
    if clause.action == "move" and set(clause.theme) <= swapped:
        return True  # "swap them: the left one goes right"
    if clause.action == "move" and _opposed(clause, every):
        raise TranslationError(f"{' and '.join(clause.theme)} cannot go two opposite ways at once")
    for other in every[at + 1 :]:
        same = other.action == clause.action and other.theme == clause.theme
        exact = other.amount is not None and not other.amount.vague
        dims = {clause.dimension, other.dimension}
        if same and exact and (len(dims) == 1 or "size" in dims) and other.direction in ("", clause.direction):
            return True
    return False


def _opposed(clause: Clause, every: Sequence[Clause]) -> bool:
    pairs = {"left": "right", "right": "left", "up": "down", "down": "up"}
    return any(
        c.action == "move" and c.theme == clause.theme and c.direction == pairs.get(clause.direction) for c in every
    )


def _only_turns(go: Clause, later: Sequence[Clause]) -> bool:
    """Whether "bring it ... so that it is level" goes on to say how the thing lies, and not where."""
    own = [c for c in later if c.theme == go.theme]
    turned = any(c.action == "orient" for c in own)
    return turned and not any(c.action in ("place", "move", "align", "keep") for c in later)


def _said(clause: Clause) -> frozenset[str]:
    """What a clause adds to a place."""
    if clause.relation == "touch":
        return frozenset({"touching"})
    if clause.relation in SIDES and clause.amount is None:
        return frozenset({f"at {SIDES[clause.relation]}"})
    if clause.action == "side":
        return frozenset({f"at {clause.direction}"})
    return frozenset()


def _beside(before: Clause, clause: Clause) -> bool:
    """Whether `before` is a place beside something that `clause` may say more of."""
    if before.action != "place" or clause.action not in ("place", "side") or before.theme != clause.theme:
        return False
    if before.side or before.theme_side or clause.side or clause.theme_side:
        return False
    sided = before.relation in SIDES and clause.relation == "touch" and before.amount is None
    meets = before.relation == "touch" and not before.direction and bool(_said(clause) - {"touching"})
    meets = meets or (clause.relation == "beside" and "to" in before.manner)
    same = clause.action == "side" or before.reference == clause.reference
    return same and (before.relation == "beside" or sided or meets)

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
    return [c for i, c in enumerate(out) if not (c.action == "go" and _only_turns(c, out[i + 1 :]))]


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
